#pragma once
// The published slopes that several tests use (Donald & Giam 1989: ACADS; Griffiths & Lane 1999).
#include <numbers>

#include "polder/stability/section.hpp"

namespace polder::stability::testing {

inline Soil drained(double cohesion_kpa, double friction_deg, double unit_weight_kn) {
  Soil soil;
  soil.unit_weight = soil.saturated_unit_weight = unit_weight_kn * 1e3;
  soil.above.cohesion = soil.below.cohesion = cohesion_kpa * 1e3;
  soil.above.friction_angle = soil.below.friction_angle = friction_deg * std::numbers::pi / 180;
  return soil;
}

inline Layer layer(std::vector<Point> polygon, int soil = 0) { return {"", std::move(polygon), soil, {}}; }

inline Section acads_1a() {
  Section section;
  section.soils = {drained(3, 19.6, 20)};
  section.layers = {layer({{20, 20}, {70, 20}, {70, 35}, {50, 35}, {30, 25}, {20, 25}})};
  return section;
}

inline Section acads_1c() {
  Section section;
  section.soils = {drained(0, 38, 19.5), drained(5.3, 23, 19.5), drained(7.2, 20, 19.5)};
  section.layers = {layer({{30, 25}, {50, 29}, {54, 31}, {70, 31}, {70, 35}, {50, 35}}, 0),
                    layer({{30, 25}, {40, 27}, {52, 24}, {70, 24}, {70, 31}, {54, 31}, {50, 29}}, 1),
                    layer({{20, 20}, {70, 20}, {70, 24}, {52, 24}, {40, 27}, {30, 25}, {20, 25}}, 2)};
  return section;
}

inline Section griffiths_lane_1() {
  Section section;
  section.soils = {drained(10, 20, 20)};
  section.layers = {layer({{0, 0}, {50, 0}, {50, 10}, {32, 10}, {12, 0}})};
  return section;
}

}  // namespace polder::stability::testing
