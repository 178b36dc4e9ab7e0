// Dam break on a dry bed (Ritter 1892) and on a wet one (Stoker 1957), solutions of the shallow-water equations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "polder/case/geometry.hpp"
#include "polder/verify/engine.hpp"
#include "polder/verify/problem.hpp"

namespace polder::verify {

namespace {

/// Depth of the water in each column, m, as the cells' fill has it (at most full); in 3d the mean across y.
template <class Space>
std::vector<double> depths(const Stepper<Space>& state) {
  const auto& lattice = state.setup.lattice;
  std::vector<double> depth(static_cast<std::size_t>(lattice.cells[0]), 0.0);
  const double share = lattice.spacing[Space::up] / (Space::axes == 3 ? lattice.cells[1] : 1);
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>& place) {
    depth[static_cast<std::size_t>(place[0])] += std::min(1.0, state.grid.fill[cell]) * share;
  });
  return depth;
}

double interpolate(const std::vector<double>& column, double x, double dx) {
  const double place = std::clamp(x / dx - 0.5, 0.0, static_cast<double>(column.size()) - 1.001);
  const auto low = static_cast<std::size_t>(place);
  const double share = place - static_cast<double>(low);
  return (1 - share) * column[low] + share * column[low + 1];
}

/// Mean horizontal velocity over the depth in a column.
template <class Space>
double column_velocity(const Stepper<Space>& state, double x) {
  const auto& lattice = state.setup.lattice;
  const int i = static_cast<int>(x / lattice.spacing[0]);
  double momentum = 0, water = 0;
  for (std::ptrdiff_t row = 0; row < lattice.row_count(); ++row) {
    const std::ptrdiff_t cell =
        lattice.index(i, static_cast<int>(row % lattice.cells[1]), static_cast<int>(row / lattice.cells[1]));
    const double fill = std::min(1.0, state.grid.fill[cell]);
    momentum += fill * 0.5 * (state.grid.water_velocity[0][cell] + state.grid.water_velocity[0][cell + 1]);
    water += fill;
  }
  return water > 0 ? momentum / water : 0;
}

Curve profile(const std::string& name, const std::vector<double>& depth, double dx) {
  Curve curve{name, {}, depth, false};
  for (std::size_t i = 0; i < depth.size(); ++i) curve.x.push_back((static_cast<double>(i) + 0.5) * dx);
  return curve;
}

template <class Space>
void add_volume(const Simulation<Space>& run, double start, Findings& findings) {
  const std::vector<double> depth = depths(run.state());
  const double volume = std::accumulate(depth.begin(), depth.end(), 0.0) * run.state().setup.lattice.spacing[0];
  findings.comparisons.push_back({"volume by cell fill", "end", start, volume});
  findings.comparisons.push_back({"overfilled cells", "most of all steps, share", 0, run.audit().overfilled_most, 1});
}

struct Dam {
  double place, high, low;  // m: where it stands, depths on either side
};

Dam dam_of(const Model& model) {
  const Bounds high = bounds(model.free_water.at(0).region.polygon);
  Dam dam{high.high[0], high.high[1], 0};
  if (model.free_water.size() > 1) dam.low = bounds(model.free_water[1].region.polygon).high[1];
  return dam;
}

double volume_of(const Model& model) {
  double volume = 0;
  for (const FreeWaterBody& body : model.free_water) volume += area(body.region.polygon);
  return volume;
}

template <class Space>
Findings ritter_in(const Study& study) {
  const Dam dam = dam_of(study.shipped);
  const double celerity = std::sqrt(study.shipped.gravity * dam.high);
  Simulation<Space> run(study.run, 1);
  run_case(run, [](const auto&) {});
  const double dx = run.state().setup.lattice.spacing[0], t = run.time();
  const std::vector<double> depth = depths(run.state());
  Findings findings;
  const auto exact = [&](double xi) { return dam.high * (xi < -1 ? 1 : xi > 2 ? 0 : (2 - xi) * (2 - xi) / 9); };
  for (const double xi : {-0.5, 0.0, 0.5, 1.0})
    findings.comparisons.push_back({"depth", fmt::format("x/(c₀t) = {:g}", xi), exact(xi),
                                    interpolate(depth, dam.place + xi * celerity * t, dx), dam.high});
  add_volume(run, volume_of(study.shipped), findings);
  Chart chart{fmt::format("Dam break on a dry bed, t = {:g} s", t), "x", "depth", "m", "m", {}, {}};
  Curve curve = profile("Ritter", depth, dx);
  for (std::size_t i = 0; i < curve.x.size(); ++i) curve.y[i] = exact((curve.x[i] - dam.place) / (celerity * t));
  chart.curves = {curve, profile("computed", depth, dx)};
  findings.figure = chart;
  return findings;
}

/// The state between the rarefaction and the bore.
struct Middle {
  double depth, velocity, bore;
};

/// Stoker's: rarefaction u = 2(c_L − c), bore u = (h − h_R) √(g (1/h + 1/h_R)/2); bisection on the depth.
Middle stoker_middle(const Dam& dam, double g) {
  const auto behind_rarefaction = [&](double h) { return 2 * (std::sqrt(g * dam.high) - std::sqrt(g * h)); };
  const auto behind_bore = [&](double h) { return (h - dam.low) * std::sqrt(0.5 * g * (1 / h + 1 / dam.low)); };
  double low = dam.low, high = dam.high;
  for (int i = 0; i < 200; ++i) {
    const double h = 0.5 * (low + high);
    (behind_rarefaction(h) > behind_bore(h) ? low : high) = h;
  }
  const double h = 0.5 * (low + high), u = behind_bore(h);
  return {h, u, u * h / (h - dam.low)};
}

template <class Space>
Findings stoker_in(const Study& study) {
  const Dam dam = dam_of(study.shipped);
  const double g = study.shipped.gravity, celerity = std::sqrt(g * dam.high);
  const Middle middle = stoker_middle(dam, g);
  Simulation<Space> run(study.run, 1);
  const double dx = run.state().setup.lattice.spacing[0], half = 0.5 * run.end_time();
  const auto front = [&](const std::vector<double>& depth) {  // where the depth falls below the mean of both states
    const double level = 0.5 * (middle.depth + dam.low);
    std::size_t i = depth.size() - 1;
    while (i > 0 && depth[i - 1] < level) --i;
    const double share = (depth[i - 1] - level) / (depth[i - 1] - depth[i]);
    return (static_cast<double>(i) - 0.5 + share) * dx;
  };
  double front_at_half = 0, time_at_half = 0;
  run_case(run, [&](const auto& r) {
    if (time_at_half > 0 || r.time() < half) return;
    time_at_half = r.time();
    front_at_half = front(depths(r.state()));
  });
  const std::vector<double> depth = depths(run.state());
  const double t = run.time();
  // the middle state reaches from the tail of the rarefaction to the bore; its middle third is compared
  const double tail = dam.place + (middle.velocity - std::sqrt(g * middle.depth)) * t;
  const double head = dam.place + middle.bore * t;
  double mean_depth = 0, mean_velocity = 0;
  int number = 0;
  const double begin = tail + (head - tail) / 3;
  for (; begin + number * dx < tail + 2 * (head - tail) / 3; ++number) {
    const double x = begin + number * dx;
    mean_depth += interpolate(depth, x, dx);
    mean_velocity += column_velocity(run.state(), x);
  }
  Findings findings;
  findings.comparisons.push_back({"depth", "middle state", middle.depth, mean_depth / number});
  findings.comparisons.push_back({"velocity", "middle state", middle.velocity, mean_velocity / number});
  findings.comparisons.push_back(
      {"bore speed", "second half", middle.bore, (front(depth) - front_at_half) / (t - time_at_half)});
  add_volume(run, volume_of(study.shipped), findings);
  Chart chart{fmt::format("Dam break on a wet bed, t = {:g} s", t), "x", "depth", "m", "m", {}, {}};
  Curve curve = profile("Stoker", depth, dx);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = curve.x[i], xi = (x - dam.place) / (celerity * t);
    curve.y[i] = xi < -1 ? dam.high : x < tail ? dam.high * (2 - xi) * (2 - xi) / 9 : x < head ? middle.depth : dam.low;
  }
  chart.curves = {curve, profile("computed", depth, dx)};
  findings.figure = chart;
  return findings;
}

Findings ritter(const Source& source) {
  const Study study = source.study();
  return study.run.space == SpaceKind::solid ? ritter_in<Solid>(study) : ritter_in<PlaneStrain>(study);
}

Findings stoker(const Source& source) {
  const Study study = source.study();
  return study.run.space == SpaceKind::solid ? stoker_in<Solid>(study) : stoker_in<PlaneStrain>(study);
}

}  // namespace

std::vector<Problem> dam_break_problems() {
  return {{"ritter", "Dam break on a dry bed", "Ritter (1892), shallow water", false, ritter},
          {"stoker", "Dam break on a wet bed", "Stoker (1957), shallow water", false, stoker},
          {"ritter-3d", "Dam break on a dry bed, 3d", "Ritter (1892), shallow water", false, ritter},
          {"stoker-3d", "Dam break on a wet bed, 3d", "Stoker (1957), shallow water", false, stoker}};
}

}  // namespace polder::verify
