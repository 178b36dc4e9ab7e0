#pragma once
// A small dike with a reservoir beside it: soil and water points on a lattice, with fields of known values.
#include "polder/result/frame.hpp"

inline polder::Frame sample_frame(double time = 2.5) {
  using namespace polder;
  Frame frame;
  frame.time = time;
  frame.size = {4, 1.5, 0};
  frame.title = "A dike & its <reservoir>";
  frame.outlines = {{{1, 0}, {1, 1}, {2, 1}, {4, 0}, {1, 0}}};
  frame.water_lines = {{{0, 0.8}, {1, 0.8}}};
  std::vector<double> porosity, velocity, stress, soil_pressure, water_pressure;
  constexpr double d = 0.05;
  for (double y = d / 2; y < 1; y += d)
    for (double x = d / 2; x < 4; x += d) {
      const bool soil = x > 1 && y < (4 - x) / 2;
      if (!soil && (x > 1 || y > 0.8)) continue;
      PointSet& points = soil ? frame.soil : frame.water;
      points.id.push_back(7 + 3 * (frame.soil.size() + frame.water.size()));
      points.position.push_back({x, y, 0});
      points.volume.push_back(d * d);
      (soil ? soil_pressure : water_pressure).push_back(9810 * (0.8 - y));
      if (!soil) continue;
      porosity.push_back(0.4 + 0.01 * time * x);
      velocity.insert(velocity.end(), {3e-3 * x, -4e-3 * x});
      stress.insert(stress.end(), {-1e3 * x, -2e3 * y, -3e3, 4e2});
    }
  frame.soil.fields = {make_field("porosity", porosity), make_field("velocity", velocity, 2),
                       make_field("effective_stress", stress, 4), make_field("pore_pressure", soil_pressure)};
  frame.water.fields = {make_field("pressure", water_pressure)};
  return frame;
}
