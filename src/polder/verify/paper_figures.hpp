#pragma once
// Which case answers which figure of the five studies.
#include <span>
#include <string_view>

namespace polder::validate {

struct PaperFigure {
  std::string_view study, figure, shows, here;
};

std::span<const PaperFigure> paper_figures();

}  // namespace polder::validate
