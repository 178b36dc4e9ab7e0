// Seepage around a wall thinner than a cell: the engine's own pressure operator, on rigid soil between two levels of
// free water.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

/// What the case says.
struct Section {
  double wall, toe, ground, depth, head, inside, conductivity;  // m, m/s
  double embedment() const { return ground - toe; }
};

Section section_of(const Model& model) {
  const auto& line = model.walls.at(0).line;
  Section s{};
  s.wall = line.front()[0];
  s.toe = std::min(line.front()[1], line.back()[1]);
  s.ground = bounds(model.soils.at(0).region.polygon).high[1];
  s.depth = s.ground - bounds(model.soils.at(0).region.polygon).low[1];
  s.inside = bounds(model.free_water.at(1).region.polygon).high[1];
  s.head = bounds(model.free_water.at(0).region.polygon).high[1] - s.inside;
  s.conductivity = (*model.materials.at(0).permeability)[0];
  return s;
}

/// Of kH; at the wall, of H/s; mean at the toe's level over s/2 beside the wall, of H.
struct Seepage {
  double discharge = 0, exit_gradient = 0, excess_head = 0;
};

Seepage computed(const Model& model, const Section& section) {
  Simulation<PlaneStrain> run(model, 1);
  run_case(run, [](const auto&) {});
  const auto& lattice = run.state().setup.lattice;
  const auto& grid = run.state().grid;
  const auto place = [&](int axis, double x) { return static_cast<int>(std::lround(x / lattice.spacing[axis])); };
  const int wall = place(0, section.wall), toe = place(1, section.toe), ground = place(1, section.ground);
  const int width = std::max(1, place(0, 0.5 * section.embedment()));
  const auto flux = [&](int axis, int i, int j) {
    const std::ptrdiff_t f = lattice.index(i, j);
    return grid.porosity[axis][f] * grid.water_velocity[axis][f];
  };
  Seepage seepage;
  for (int j = 0; j < toe; ++j)
    seepage.discharge += flux(0, wall, j) * lattice.spacing[1] / (section.conductivity * section.head);
  seepage.exit_gradient = flux(1, wall, ground) / section.conductivity * section.embedment() / section.head;
  const double gamma = model.water.density * model.gravity;
  for (int i = wall; i < wall + width; ++i)
    for (const int j : {toe - 1, toe}) {
      const double head = grid.pressure[lattice.index(i, j)] / gamma + (j + 0.5) * lattice.spacing[1];
      seepage.excess_head += (head - section.inside) / section.head / (2 * width);
    }
  return seepage;
}

Findings compared(const Source& source, Seepage (*exact)(const Section& section)) {
  const Study study = source.study();
  const Section section = section_of(study.shipped);
  const Seepage reference = exact(section), found = computed(study.run, section);
  Findings findings;
  findings.comparisons = {
      {"discharge", "q/kH", reference.discharge, found.discharge},
      {"exit gradient", "at the wall, times s/H", reference.exit_gradient, found.exit_gradient},
      {"excess head", "mean at the toe's level over s/2, of H", reference.excess_head, found.excess_head}};
  return findings;
}

/// With m = sin(πs/2T): q/kH = K'(m)/2K(m), I_E = πH/(4KmT); the mean head from the same mapping, integrated for s/T ½.
Seepage sheet_pile(const Section& section) {
  const double m = std::sin(0.5 * std::numbers::pi * section.embedment() / section.depth);
  const double K = std::comp_ellint_1(m), K1 = std::comp_ellint_1(std::sqrt(1 - m * m));
  return {K1 / (2 * K), std::numbers::pi / (4 * K * m) * section.embedment() / section.depth, 0.34136};
}

/// s/T ½ and b/T ½.
Seepage cofferdam(const Section&) { return {0.4041, 0.4228, 0.4442}; }

}  // namespace

std::vector<Problem> sheet_pile_problems() {
  const Refinement by_two{"discharge", {"model.cell=0.25 m"}, 2};
  return {{"sheet-pile", "Seepage around a sheet pile in level ground",
           "conformal mapping (Polubarinova-Kochina 1962, Harr 1962)", true,
           [](const Source& source) { return compared(source, sheet_pile); }, by_two},
          {"cofferdam", "Seepage into a cofferdam in level ground", "conformal mapping, computed by a second method",
           true, [](const Source& source) { return compared(source, cofferdam); }, by_two}};
}

}  // namespace polder::verify
