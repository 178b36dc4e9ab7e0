#pragma once
// Polylines and polygons in a section: levels as functions of x, crossings, points inside.
#include <span>
#include <vector>

#include "polder/case/stability_input.hpp"

namespace polder::stability {

/// Level of the polyline at x, its end values beyond its ends; x must not decrease along it, and it has ≥ 1 point.
double level(const Line& line, double x);

/// The polyline with as few of its points as keep it within `tolerance` (m) of all of them (Ramer 1972, Douglas &
/// Peucker 1973).
Line simplified(const Line& line, double tolerance);

/// Whether x lies between the ends of the polyline.
bool covers(const Line& line, double x);

/// Whether two segments cross (touching counts).
bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d);

/// Whether the point is inside the polygon (even-odd rule).
bool inside(std::span<const Point> polygon, const Point& at);

/// Distance of p from the segment a–b, m.
double distance(const Point& p, const Point& a, const Point& b);

/// Area of the polygon, m², positive anticlockwise.
double signed_area(std::span<const Point> polygon);

}  // namespace polder::stability
