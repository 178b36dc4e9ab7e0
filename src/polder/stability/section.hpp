#pragma once
// A cross-section on which factors of safety are computed, as plain data: what a case file, an imported model or a test
// hands to the methods. Types of its parts are those of the case file (case/stability_input.hpp), SI units throughout.
#include <string>
#include <vector>

#include "polder/case/stability_input.hpp"

namespace polder::stability {

/// Pore pressures sampled on an even grid (from a seepage computation), Pa; interpolated bilinearly, its edge values
/// beyond its edges.
struct PressureGrid {
  Point corner{0, 0};                   ///< m, lower left sample
  double spacing_x = 1, spacing_z = 1;  ///< m
  int count_x = 0, count_z = 0;
  std::vector<double> pressure;  ///< row by row from below
  bool empty() const { return pressure.empty(); }
};

struct Section {
  std::string name;
  std::vector<Soil> soils;
  std::vector<Layer> layers;
  std::vector<Line> excavations;  ///< lines over which the soil is taken away, between their ends
  WaterNet water;
  PressureGrid pressures;  ///< where given, replaces the pressures of the water net (its phreatic line still counts)
  std::vector<StatePoint> state_points;
  std::vector<StateLine> state_lines;
  std::vector<StripLoad> strip_loads;
  std::vector<LineLoad> line_loads;
  Earthquake earthquake;
  TensionCrack crack;
  SlipLimits limits;
  Movement movement = Movement::automatic;
  /// The section under whose stresses preconsolidation was measured (daily conditions); empty: this one.
  std::vector<Section> before;
};

}  // namespace polder::stability
