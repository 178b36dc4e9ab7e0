// The text of a case file: read to a model, or to messages that say what is wrong.
#include <nlohmann/json.hpp>

#include "polder/case/estimate.hpp"
#include "polder/case/model_json.hpp"
#include "polder/case/reader.hpp"
#include "scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polder;
  const std::string path = fuzz::scratch().write("case.toml", fuzz::text_of(data, size));
  const ReadResult result = read_case(path);
  for (const Diagnostic& d : result.diagnostics) fuzz::require(!d.message.empty());
  fuzz::require(result.ok() || !format(result.diagnostics).empty());
  if (!result.ok()) {
    fuzz::refusals().add();
  } else {
    fuzz::require(estimated_step(result.model) > 0 && cell_count(result.model) > 0);
    fuzz::require(!case_json(result.model).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).empty());
  }
  return 0;
}
