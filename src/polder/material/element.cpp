#include "polder/material/element.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace polder {
namespace {

constexpr std::array<std::string_view, 5> names{"oedometer", "triaxial-drained", "triaxial-undrained", "simple-shear",
                                                "simple-shear-undrained"};

using Strain = std::array<double, 6>;

/// The sample: one point of a batch, with its strain since the start.
struct Sample {
  StressBatch<6> point;
  Strain strain{};
};

Sample strained(const SoilLaw& law, const Sample& before, const Strain& increment) {
  Sample after = before;
  for (std::size_t k = 0; k < 6; ++k) {
    after.point.strain[k][0] = increment[k];
    after.strain[k] += increment[k];
  }
  const double volume = increment[0] + increment[1] + increment[2];
  after.point.porosity[0] = 1 - (1 - before.point.porosity[0]) * std::exp(-volume);
  law.update(after.point);
  return after;
}

Strain combined(const Strain& imposed, double x, const Strain& free) {
  Strain sum = imposed;
  for (std::size_t k = 0; k < 6; ++k) sum[k] += x * free[k];
  return sum;
}

double mean_pressure(const Sample& sample) {
  return -(sample.point.stress[0][0] + sample.point.stress[1][0] + sample.point.stress[2][0]) / 3;
}

/// A step in which the strain `imposed` is given and as much of `free` is added as brings stress component `component`
/// to `target`: that stress rises with the free strain, so a bracket is widened and closed (Illinois).
std::optional<Sample> controlled(const SoilLaw& law, const Sample& before, const Strain& imposed, const Strain& free,
                                 std::size_t component, double target) {
  const auto miss = [&](const Sample& s) { return s.point.stress[component][0] - target; };
  const double modulus = law.constrained_modulus(mean_pressure(before));
  const double tolerance = 1e-12 * (std::abs(target) + 1e-9 * modulus);
  double low = 0, high = 0;
  Sample at_low = strained(law, before, imposed), at_high = at_low;
  double f_low = miss(at_low), f_high = f_low;
  if (std::abs(f_low) <= tolerance) return at_low;
  double reach = 1.1 * std::abs(f_low) / modulus + 1e-14;
  for (int widen = 0; f_low > 0 || f_high < 0; ++widen) {
    if (widen == 60) return std::nullopt;
    if (f_low > 0) {
      high = low, at_high = at_low, f_high = f_low;
      low -= reach, at_low = strained(law, before, combined(imposed, low, free)), f_low = miss(at_low);
    } else {
      low = high, at_low = at_high, f_low = f_high;
      high += reach, at_high = strained(law, before, combined(imposed, high, free)), f_high = miss(at_high);
    }
    reach *= 2;
  }
  double weight_low = f_low, weight_high = f_high;
  for (int iteration = 0; iteration < 200; ++iteration) {
    if (std::abs(f_low) <= tolerance) return at_low;
    if (std::abs(f_high) <= tolerance) return at_high;
    double x = (low * weight_high - high * weight_low) / (weight_high - weight_low);
    if (!(x > low && x < high)) x = 0.5 * (low + high);
    if (x <= low || x >= high) break;  // the bracket is down to two neighbouring numbers
    Sample at_x = strained(law, before, combined(imposed, x, free));
    const double f = miss(at_x);
    if (f < 0) {
      low = x, at_low = at_x, f_low = weight_low = f;
      weight_high *= 0.5;
    } else {
      high = x, at_high = at_x, f_high = weight_high = f;
      weight_low *= 0.5;
    }
  }
  return -f_low < f_high ? at_low : at_high;
}

/// From tension to compression, and no negative zero in a table.
double flipped(double tension_positive) { return 0.0 - tension_positive; }

ElementRow row_of(const Sample& sample, double pore_pressure) {
  const auto& s = sample.point.stress;
  ElementRow row;
  row.axial_strain = flipped(sample.strain[1]);
  row.lateral_strain = flipped(sample.strain[0]);
  row.volumetric_strain = flipped(sample.strain[0] + sample.strain[1] + sample.strain[2]);
  row.shear_strain = 2 * sample.strain[3];
  row.axial = flipped(s[1][0]);
  row.lateral = flipped(s[0][0]);
  row.out_of_plane = flipped(s[2][0]);
  row.shear = s[3][0];
  row.mean = mean_pressure(sample);
  const double a = row.axial - row.lateral, b = row.lateral - row.out_of_plane, c = row.out_of_plane - row.axial;
  row.deviator = std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * row.shear * row.shear);
  row.pore_pressure = pore_pressure;
  row.porosity = sample.point.porosity[0];
  row.plastic_shear_strain = sample.point.state[0][0];
  return row;
}

Sample prepared(const SoilLaw& law, const ElementPath& path, double porosity) {
  Sample sample{};
  sample.point.count = 1;
  sample.point.stress[1][0] = -path.vertical_stress;
  sample.point.stress[0][0] = sample.point.stress[2][0] = -path.vertical_stress * path.stress_ratio;
  sample.point.porosity[0] = porosity;
  std::array<double, StressBatch<6>::max_state - 1> state{};
  const std::size_t used = law.state_names().size();
  law.initial_state(mean_pressure(sample), porosity, std::span(state).first(used));
  for (std::size_t k = 0; k < used; ++k) sample.point.state[k + 1][0] = state[k];
  return sample;
}

/// One step of the path; the lateral total stress of an undrained test is held by the cell pressure.
std::optional<Sample> step_of(const SoilLaw& law, const ElementPath& path, const Sample& now, double target) {
  const double part = path.strain / path.steps;
  switch (path.test) {
    case ElementTest::oedometer:
      return controlled(law, now, {}, {0, 1, 0, 0, 0, 0}, 1, target);
    case ElementTest::triaxial_drained:
      return controlled(law, now, {0, -part, 0, 0, 0, 0}, {1, 0, 1, 0, 0, 0}, 0, target);
    case ElementTest::triaxial_undrained:
      return strained(law, now, {0.5 * part, -part, 0.5 * part, 0, 0, 0});
    case ElementTest::simple_shear:
      return controlled(law, now, {0, 0, 0, 0.5 * part, 0, 0}, {0, 1, 0, 0, 0, 0}, 1, target);
    case ElementTest::simple_shear_undrained:
      return strained(law, now, {0, 0, 0, 0.5 * part, 0, 0});
  }
  return std::nullopt;
}

/// Excess pore pressure of a sample whose total lateral (triaxial) or vertical (shear) stress is kept.
double pore_pressure(const ElementPath& path, const Sample& start, const Sample& now) {
  if (path.test == ElementTest::triaxial_undrained) return now.point.stress[0][0] - start.point.stress[0][0];
  if (path.test == ElementTest::simple_shear_undrained) return now.point.stress[1][0] - start.point.stress[1][0];
  return 0;
}

}  // namespace

std::string_view element_test_name(ElementTest test) { return names[static_cast<std::size_t>(test)]; }

ElementTest element_test_from_name(std::string_view name) {
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<ElementTest>(i);
    known += (i ? ", " : "") + std::string(names[i]);
  }
  throw std::invalid_argument("unknown element test '" + std::string(name) + "'; known are " + known);
}

ElementResult run_element_test(const SoilLaw& law, const ElementPath& path, double porosity, double max_porosity) {
  ElementResult result;
  const Sample start = prepared(law, path, porosity);
  Sample now = start;
  result.rows.push_back(row_of(now, 0));

  // The stress that a stress-controlled step must reach: kept in a strain-controlled test, a ramp in the oedometer.
  const bool oedometer = path.test == ElementTest::oedometer;
  std::vector<double> targets;
  if (oedometer) {
    double from = path.vertical_stress;
    for (const double load : path.loads) {
      for (int i = 1; i <= path.steps; ++i) targets.push_back(-(from + (load - from) * i / path.steps));
      from = load;
    }
  } else {
    const std::size_t held = path.test == ElementTest::simple_shear ? 1 : 0;
    targets.assign(static_cast<std::size_t>(path.steps), start.point.stress[held][0]);
  }

  for (std::size_t i = 0; i < targets.size(); ++i) {
    const std::optional<Sample> next = step_of(law, path, now, targets[i]);
    const std::string where = " at step " + std::to_string(i + 1) + " of " + std::to_string(targets.size());
    if (!next) {
      result.stopped = "no strain brings the stress to its prescribed value" + where +
                       ": the sample has failed under it; end the path earlier or lower the load";
      break;
    }
    if (next->point.porosity[0] > max_porosity) {
      result.stopped = "porosity passes max_porosity" + where + ": the grains lose contact; end the path earlier";
      break;
    }
    now = *next;
    result.rows.push_back(row_of(now, pore_pressure(path, start, now)));
  }
  return result;
}

}  // namespace polder
