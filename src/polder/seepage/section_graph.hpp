#pragma once
// The outlines of a case as a planar graph: vertices, and segments that meet only at vertices.
#include <array>
#include <vector>

#include "polder/seepage/mesher.hpp"

namespace polder {

struct SectionGraph {
  struct Segment {
    int a, b;
    bool cut;  ///< part of a thin wall
  };
  std::vector<Point2> vertices;
  std::vector<Segment> segments;
};

/// Merges vertices closer than 1e-6 of the section's size, and splits edges where others meet or cross them.
SectionGraph section_graph(const MeshRequest& request);

}  // namespace polder
