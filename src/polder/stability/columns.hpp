#pragma once
// A section cut into vertical columns in which every boundary is a straight line: what lies where, how much it weighs,
// and the water pressure. Made once per section, then asked many times by the slices of trial surfaces.
#include <vector>

#include "polder/stability/section.hpp"

namespace polder::stability {

/// One layer within a column; heights at the column's left and right edge.
struct Piece {
  double top[2], base[2];
  int layer;
};

struct Column {
  double left = 0, right = 0;
  std::vector<Piece> pieces;  ///< from the ground down
};

struct PreparedSection {
  Section section;
  std::vector<Column> columns;           ///< from left to right, adjoining
  std::vector<double> breaks;            ///< every x at which ground, a layer, a water line or a load has a kink
  std::vector<std::vector<int>> states;  ///< per layer, indices of its state points, by x
  std::vector<PreparedSection> before;   ///< at most one
  double left() const { return columns.front().left; }
  double right() const { return columns.back().right; }
};

/// Throws std::invalid_argument that lists everything that is wrong (no soil, gaps, overlaps, unknown soils …).
PreparedSection prepare(Section section);

/// Height of the ground at x (inside the section).
double ground_level(const PreparedSection& prepared, double x);

/// Height of the lowest boundary at x.
double bottom_level(const PreparedSection& prepared, double x);

/// Index of the layer at (x, z); −1 above the ground or below the section. On a boundary: the layer above it.
int layer_at(const PreparedSection& prepared, double x, double z);

/// Weight per area of the soil between the ground and z, Pa.
double soil_weight(const PreparedSection& prepared, double x, double z);

/// Pressure of free water standing on the ground at x, Pa.
double free_water_pressure(const PreparedSection& prepared, double x);

/// Pore pressure of the water net at (x, z), Pa; negative where suction counts.
double pore_pressure(const PreparedSection& prepared, double x, double z);

/// Vertical effective stress at (x, z) from soil, free water, loads and pore pressure, Pa, compression positive.
double vertical_effective_stress(const PreparedSection& prepared, double x, double z);

/// Whether the line load acts inside the soil: a slip surface above it does not feel it.
bool buried(const PreparedSection& prepared, const LineLoad& load);

/// Stress under the strip and line loads at (x, z), averaged over `width` around x.
struct LoadStress {
  double vertical = 0;         ///< Pa, compression positive
  double excess_pressure = 0;  ///< Pa, its share that the pore water still carries
};
LoadStress load_stress(const PreparedSection& prepared, double x, double z, double width, int layer);

/// Boundaries between pieces that the straight line from a to b crosses, as x, unordered. Both in one column.
void append_crossings(const PreparedSection& prepared, const Point& a, const Point& b, std::vector<double>& crossings);

/// Index of the column that holds x.
std::size_t column_at(const PreparedSection& prepared, double x);

}  // namespace polder::stability
