#pragma once
// Sections as drawings: soil layers and water with a slip surface and its slices, factors over a grid of centres, and
// fields on triangles.
#include <optional>
#include <span>
#include <string>

#include "polder/result/drawing.hpp"
#include "polder/result/ticks.hpp"
#include "polder/seepage/mesh.hpp"
#include "polder/stability/search.hpp"

namespace polder {

/// The section with the slip surface and slices of `found`; without a surface where `found` has none.
Drawing draw_slip(const stability::PreparedSection& prepared, const stability::SearchResult* found,
                  const std::string& title);

/// The least factor with each centre as coloured squares over the section, the critical surface below them.
Drawing draw_centres(const stability::PreparedSection& prepared, const stability::SearchResult& found);

/// A quantity on triangles.
struct TriangleField {
  std::string title, unit;
  std::vector<double> per_corner;  ///< three values per plain triangle of `pieces`
  std::vector<std::array<int, 3>> pieces;
  ColourMap map = ColourMap::field;
  int lines = 0;                               ///< about so many contour lines; 0: none
  bool from_zero = false;                      ///< the scale begins at zero and leaves out the highest per cent
  std::vector<std::array<Point2, 2>> overlay;  ///< m, such as the water table
  std::vector<std::array<Point2, 2>> arrows;   ///< m, from foot to head
};

/// The four plain triangles of each 6-node triangle with nodal values.
TriangleField nodal_field(const Mesh& mesh, std::span<const double> nodal);
/// Each 6-node triangle with the mean of its three Gauss points.
TriangleField gauss_field(const Mesh& mesh, std::span<const double> gauss);

Drawing draw_field(const Mesh& mesh, const TriangleField& field);

}  // namespace polder
