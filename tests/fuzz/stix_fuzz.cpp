// A D-Stability model: an archive as it is, or (where the input does not begin as one) its files one after the other,
// each under a line "%% name", so that the fuzzer reaches what stands in them.
#include <map>
#include <sstream>
#include <stdexcept>

#include "polder/stability/columns.hpp"
#include "polder/stability/stix.hpp"
#include "polder/stability/stix_case.hpp"
#include "scratch.hpp"

namespace {

std::map<std::string, std::string> members_of(const std::string& text) {
  std::map<std::string, std::string> members;
  std::string* current = nullptr;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("%% "))
      current = &members[line.substr(3)];
    else if (current)
      *current += line + "\n";
  }
  return members;
}

void use(const polder::stability::StixModel& model) {
  for (const auto& calculation : model.calculations) {
    std::vector<std::string> notes;
    try {
      polder::stability::case_text(calculation, "fuzz.stix", notes);
    } catch (const std::invalid_argument&) {
      // a message, as promised
    }
    try {
      prepare(calculation.section);
    } catch (const std::invalid_argument&) {
      // likewise
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polder;
  const std::string text = fuzz::text_of(data, size);
  try {
    use(text.starts_with("PK") ? stability::read_stix(fuzz::scratch().write("model.stix", text))
                               : stability::read_stix_files(members_of(text), "fuzz"));
  } catch (const std::invalid_argument&) {
    fuzz::refusals().add();  // with a message, as promised
  }
  return 0;
}
