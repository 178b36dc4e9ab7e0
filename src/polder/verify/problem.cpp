#include "polder/verify/problem.hpp"

#include <stdexcept>

#include "polder/case/reader.hpp"

namespace polder::verify {

namespace {

Model read(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  ReadResult result = read_case(file.string(), overrides);
  if (!result.ok()) throw std::runtime_error(format(result.diagnostics));
  return std::move(result.model);
}

}  // namespace

Study Source::study() const { return {read(file, {}), read(file, overrides)}; }

double Refinement::error_of(const Findings& findings) const {
  double squares = 0;
  int number = 0;
  for (const Comparison& c : findings.comparisons) {
    if (c.quantity != quantity) continue;
    squares += c.error() * c.error();
    ++number;
  }
  if (number == 0) throw std::logic_error("no comparison is called " + std::string(quantity));
  return std::sqrt(squares / number);
}

std::span<const Problem> problems() {
  static const std::vector<Problem> all = [] {
    std::vector<Problem> list;
    for (auto* family :
         {rest_problems, dam_break_problems, channel_problems, consolidation_problems, mandel_problems, wave_problems,
          far_field_problems, seepage_problems, sheet_pile_problems, fluidisation_problems, suspension_problems,
          bar_problems, vortex_problems, element_problems, cylinder_problems, footing_problems, infiltration_problems})
      for (Problem& problem : family()) list.push_back(std::move(problem));
    return list;
  }();
  return all;
}

}  // namespace polder::verify
