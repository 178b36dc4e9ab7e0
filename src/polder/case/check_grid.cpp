// The grid: sizes that are whole cells, or cells finer in some ranges ([[refine]]).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/case/sections.hpp"

namespace polder::case_file {
namespace {

constexpr double round_off = 1e-9;  // of the model's size, below which lengths count as equal
constexpr double most_cells = 1e9, most_along_an_axis = 1e6;
constexpr double room = 3;  // cells, between a fine range and the next one or an end of the axis

const char* name_of(const Model& model, std::size_t axis) {
  static constexpr const char* names[2][3] = {{"width", "height", ""}, {"width", "depth", "height"}};
  return names[model.space == SpaceKind::solid][axis];
}

/// The size is a multiple of the cell, to within round-off; then the cell is made to fit to the last digit.
void check_whole_cells(const Fields& f, Model& model, std::size_t k, Diagnostics& diagnostics) {
  const double size = model.size[k], count = std::round(size / model.cell[k]);
  double& cell = model.cell[k];
  if (std::abs(count * cell - size) <= round_off * size)
    cell = size / count;
  else
    report(
        diagnostics, f.place_of("size"), f.path_of("size"),
        fmt::format("the {} {:.10g} m is not a multiple of the cell {:.10g} m", name_of(model, k), size, cell),
        fmt::format("the nearest that fit: {:.10g} m and {:.10g} m, or a cell of {:.10g} m",
                    std::max(1.0, std::floor(size / cell)) * cell, (std::floor(size / cell) + 1) * cell, size / count));
}

/// What a range can be told to be wrong in without the others. Reports it and returns false.
bool is_sound(const FineRange& range, const Fields& f, const Model& model, std::size_t axis, Diagnostics& diagnostics) {
  const double size = model.size[axis], cell = model.cell[axis];
  const auto refuse = [&](std::string_view key, const std::string& what, const std::string& remedy) {
    report(diagnostics, f.place_of(key), f.path_of(key), what, remedy);
    return false;
  };
  if (range.cell > cell)
    return refuse("cell", fmt::format("{:.6g} m is not finer than the grid's {:.6g} m", range.cell, cell),
                  "make it smaller, or model.cell larger");
  if (range.from < -round_off * size || range.to > size * (1 + round_off))
    return refuse("span", fmt::format("{:.6g} m to {:.6g} m is outside the model", range.from, range.to),
                  fmt::format("the {} reaches from 0 to {:.6g} m", name_of(model, axis), size));
  if (range.to - range.from < range.cell * (1 - 1e-6))
    return refuse("span", fmt::format("{:.6g} m is less than a cell of {:.6g} m", range.to - range.from, range.cell),
                  "make the span wider or the cell smaller");
  if (size / range.cell > most_along_an_axis)
    return refuse("cell",
                  fmt::format("{:.6g} m is too fine for {:.6g} m of {}", range.cell, size, name_of(model, axis)),
                  "a millionth of the axis is the least");
  return true;
}

/// Ranges ascend and leave room for the cells to grow between them. The later one of two that do not is dropped.
void check_room(const std::vector<const Fields*>& fields, Model& model, std::size_t axis, Diagnostics& diagnostics) {
  std::vector<FineRange>& ranges = model.finer[axis];
  std::vector<std::pair<FineRange, const Fields*>> order;
  for (std::size_t i = 0; i < ranges.size(); ++i) order.emplace_back(ranges[i], fields[i]);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first.from < b.first.from; });
  ranges.clear();
  const double size = model.size[axis];
  for (const auto& entry : order) {
    const FineRange& range = entry.first;
    const auto tight = [&](double left, double needed, const char* what) {
      const Fields& f = *entry.second;
      report(diagnostics, f.place_of("span"), f.path_of("span"),
             fmt::format("leaves {:.6g} m to {}, where its cells cannot grow", left, what),
             fmt::format("leave at least {:.6g} m, or let it reach there", needed));
    };
    const double needed = room * range.cell, before = range.from - (ranges.empty() ? 0 : ranges.back().to);
    const double between = ranges.empty() ? 0 : room * std::max(range.cell, ranges.back().cell);
    if (before < between)
      tight(before, between, "the range before it");
    else if (ranges.empty() && before > round_off * size && before < needed)
      tight(before, needed, "the end of the model");
    else if (size - range.to > round_off * size && size - range.to < needed)
      tight(size - range.to, needed, "the end of the model");
    else
      ranges.push_back(range);
  }
}

}  // namespace

void check_grid(const Sections& sections, Model& model, Diagnostics& diagnostics) {
  const std::size_t axes = model.space == SpaceKind::solid ? 3 : 2;
  const Fields& f = sections.model;
  std::array<std::vector<const Fields*>, 3> of_axis;
  std::array<bool, 3> refined{};
  for (const Fields& refine : sections.refinements) {
    const std::string along = refine.text("along");
    const Entry *span = refine.find("span"), *cell = refine.find("cell");
    if (along == "y" && axes == 2) {
      report(diagnostics, refine.place_of("along"), refine.path_of("along"), "plane strain has no y",
             "its axes are \"x\" and \"height\"");
      continue;
    }
    const std::size_t axis = along == "x" ? 0 : along == "y" ? 1 : axes - 1;
    refined[axis] = true;
    if (span == nullptr || cell == nullptr) continue;  // reported when it was read
    if (span->numbers.size() != 2) {
      report(diagnostics, span->place, refine.path_of("span"), "is not [from, to]", "give the two ends of the range");
      continue;
    }
    FineRange range{span->numbers[0], span->numbers[1], cell->number, 1.15};
    range.growth = refine.number("growth", range.growth);
    if (!is_sound(range, refine, model, axis, diagnostics)) continue;
    range.from = std::max(0.0, range.from);
    range.to = std::min(model.size[axis], range.to);
    model.finer[axis].push_back(range);
    of_axis[axis].push_back(&refine);
  }
  double cells = 1;
  for (std::size_t k = 0; k < axes; ++k) {
    const double count = std::round(model.size[k] / model.cell[k]);
    if (count < 1) {
      report(diagnostics, f.place_of("cell"), f.path_of("cell"),
             fmt::format("there is no cell along the {}: {:g} m are less than half of {:g} m", name_of(model, k),
                         model.size[k], model.cell[k]),
             "make the cell smaller");
      model.finer[k].clear();
      continue;
    }
    if (!refined[k]) check_whole_cells(f, model, k, diagnostics);
    check_room(of_axis[k], model, k, diagnostics);
    cells *= model.finer[k].empty() ? count : grid_axis(model, k).cells();
  }
  if (cells > most_cells)
    report(diagnostics, f.place_of("cell"), f.path_of("cell"), fmt::format("the grid has {:.3g} cells", cells),
           "no machine of ours holds more than 1e9");
  if (model.periodic && refined[0])
    for (const Fields& refine : sections.refinements)
      if (refine.text("along") == "x")
        report(diagnostics, refine.place_of("along"), refine.path_of("along"),
               "the cells of a periodic model are alike along x", "refine along the height, or leave periodic out");
}

}  // namespace polder::case_file
