#pragma once
// Plane geometry of a section: polygons given by their corners in either sense, polylines from left to right.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "polder/case/model.hpp"

namespace polder {

/// Whether `p` lies in the polygon. Half-open: a point on an edge belongs to the polygon on the edge's right, on a
/// level edge to the one above it, so that of polygons that share edges exactly one contains it.
bool contains(std::span<const Point2> polygon, Point2 p);

/// Whether (x, y, height) lies in the region; in plane strain call it with y = 0. `across` is half-open too.
bool contains(const Region& region, double x, double y, double height);

/// m², positive where the corners run counter-clockwise.
double signed_area(std::span<const Point2> polygon);
double area(std::span<const Point2> polygon);

/// A point where two edges that are not neighbours meet, or neighbours fold back on each other; absent where the
/// polygon is simple.
std::optional<Point2> self_intersection(std::span<const Point2> polygon);

/// Lower left and upper right corner.
struct Bounds {
  Point2 low, high;
};
Bounds bounds(std::span<const Point2> points);

struct Overlap {
  double area = 0;  ///< m²
  Point2 inside{};  ///< a point in the widest part of it
};
/// Common area of two simple polygons, by slabs between the abscissas of corners and crossings (exact but for
/// round-off).
Overlap overlap(std::span<const Point2> a, std::span<const Point2> b);

/// Height of a polyline with increasing x, level beyond its ends. Not defined for an empty one.
double height_at(std::span<const Point2> polyline, double x);

/// The part of a polygon where nx·x + ny·y ≤ d (Sutherland–Hodgman; the part of a concave polygon may have edges that
/// touch).
std::vector<Point2> clip(std::span<const Point2> polygon, Point2 normal, double d);
/// The part of a polygon in a box.
std::vector<Point2> clip(std::span<const Point2> polygon, const Bounds& box);

}  // namespace polder
