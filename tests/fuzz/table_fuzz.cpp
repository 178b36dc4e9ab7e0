// Tables: the hydrograph beside a case, and the history that a run wrote and a report reads. Refused: by both.
#include "polder/case/reader.hpp"
#include "polder/result/history.hpp"
#include "scratch.hpp"

namespace {

constexpr char case_text[] = R"(
[model]
size = ["1 m", "1 m"]
cell = "0.1 m"
[[free_water]]
box = [["0 m", "0 m"], ["1 m", "0.6 m"]]
[[boundary]]
name = "river"
water = "reservoir"
region = [["0 m", "0 m"], ["0.3 m", "0 m"], ["0.3 m", "1 m"], ["0 m", "1 m"]]
head = "levels.csv"
[[stage]]
name = "event"
duration = "1 s"
)";

bool read_levels(const std::string& text) {
  using namespace polder;
  static const std::string path = fuzz::scratch().write("case.toml", case_text);
  fuzz::scratch().write("levels.csv", text);
  const ReadResult result = read_case(path);
  if (!result.ok()) return false;
  const Table& head = result.model.boundaries.at(0).head;
  fuzz::require(!head.x.empty() && head.x.size() == head.y.size());
  for (std::size_t i = 1; i < head.x.size(); ++i) fuzz::require(head.x[i] > head.x[i - 1]);
  for (std::size_t i = 0; i < head.x.size(); ++i) {
    fuzz::require(head.y[i] >= -1e5 && head.y[i] <= 1e5);
    fuzz::require(head(head.x[i]) >= -1e5 && head(head.x[i]) <= 1e5);
  }
  return true;
}

bool read_run(const std::string& text) {
  using namespace polder;
  const std::string path = fuzz::scratch().write("history.csv", text);
  try {
    const History history = read_history(path);
    fuzz::require(history.values.size() == history.columns.size());
    for (const auto& column : history.values) fuzz::require(column.size() == history.rows());
  } catch (const std::runtime_error&) {
    return false;  // with a message, as promised
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = polder::fuzz::text_of(data, size);
  const bool levels = read_levels(text), run = read_run(text);
  if (!levels && !run) polder::fuzz::refusals().add();
  return 0;
}
