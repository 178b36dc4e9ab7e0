#pragma once
// One instant of a run as plain data: what the engine fills in and every writer of results takes. Positions, vectors
// and tensors are in SI units; stress is positive in tension, water pressure positive in compression.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "polder/case/model.hpp"

namespace polder {

using Line2 = std::vector<Point2>;  ///< a polyline in the section (x, height), m

/// What a quantity is called, in files (`name`) and to readers (`label`, `symbol`, `unit`).
struct FieldInfo {
  std::string name;    ///< "pore_pressure": key in files
  std::string label;   ///< "Pore water pressure"
  std::string symbol;  ///< "p"
  std::string unit;    ///< "Pa"; empty: a pure number
};

/// The description of a field that Polder knows; of an unknown name, its own words and no unit.
FieldInfo field_info(std::string_view name);

/// Values of one quantity at all points of a set, `components` per point, side by side:
/// 1 scalar; 2 or 3 vector; 4 plane-strain tensor (xx, yy, zz, xy); 6 tensor (xx, yy, zz, xy, yz, zx).
struct PointField {
  FieldInfo info;
  int components = 1;
  std::vector<double> values;
};

PointField make_field(std::string_view name, std::vector<double> values, int components = 1);

struct PointSet {
  std::vector<std::uint64_t> id;
  std::vector<Point3> position;  ///< m; in plane strain the third is 0
  std::vector<double> volume;    ///< m³ (m² per metre in plane strain): of the mixture for soil, of water for water
  std::vector<PointField> fields;

  std::size_t size() const { return position.size(); }
  /// Null where there is no field of this name.
  const PointField* find(std::string_view name) const;
};

struct Frame {
  double time = 0;  ///< s
  std::uint64_t step = 0;
  int dimension = 2;                    ///< 2: plane strain, up is y; 3: up is z
  std::array<double, 3> size{0, 0, 0};  ///< m, of the model's box, as Model::size
  std::array<GridAxis, 3> grid;         ///< of a run that is going on; points are drawn in the proportions of its cells
  std::string title;                    ///< of the case
  PointSet soil, water;
  std::vector<Line2> outlines;     ///< of the soil bodies at the start; closed
  std::vector<Line2> walls;        ///< rigid obstacles; closed if first and last points coincide
  std::vector<Line2> water_lines;  ///< the free surface
};

/// Magnitude of each point's value: |v| of a vector, the value itself of a scalar. Throws std::invalid_argument for
/// tensors, which have no single magnitude.
std::vector<double> magnitudes(const PointField& field);

/// Throws std::logic_error naming the field whose length does not fit the number of points.
void check_frame(const Frame& frame);

}  // namespace polder
