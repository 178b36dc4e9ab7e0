#include "polder/stability/lines.hpp"

#include <algorithm>
#include <cmath>

namespace polder::stability {

double level(const Line& line, double x) {
  if (x <= line.front()[0]) return line.front()[1];
  if (x >= line.back()[0]) return line.back()[1];
  const auto right = std::upper_bound(line.begin(), line.end(), x, [](double v, const Point& p) { return v < p[0]; });
  const Point& b = *right;
  const Point& a = *(right - 1);
  return b[0] > a[0] ? a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) : b[1];
}

Line simplified(const Line& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> keep(line.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::array<std::size_t, 2>> spans{{0, line.size() - 1}};
  while (!spans.empty()) {
    const auto [from, to] = spans.back();
    spans.pop_back();
    double most = tolerance;
    std::size_t at = 0;
    for (std::size_t i = from + 1; i < to; ++i)
      if (const double d = distance(line[i], line[from], line[to]); d > most) most = d, at = i;
    if (at == 0) continue;
    keep[at] = true;
    spans.push_back({from, at});
    spans.push_back({at, to});
  }
  Line kept;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (keep[i]) kept.push_back(line[i]);
  return kept;
}

bool covers(const Line& line, double x) { return !line.empty() && x >= line.front()[0] && x <= line.back()[0]; }

namespace {
double turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
}  // namespace

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  const bool apart = std::max(a[0], b[0]) < std::min(c[0], d[0]) || std::max(c[0], d[0]) < std::min(a[0], b[0]) ||
                     std::max(a[1], b[1]) < std::min(c[1], d[1]) || std::max(c[1], d[1]) < std::min(a[1], b[1]);
  if (apart) return false;
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

bool inside(std::span<const Point> polygon, const Point& at) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point& a = polygon[i];
    const Point& b = polygon[j];
    if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) in = !in;
  }
  return in;
}

double distance(const Point& p, const Point& a, const Point& b) {
  const double dx = b[0] - a[0], dz = b[1] - a[1], squared = dx * dx + dz * dz;
  const double t = squared > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dz) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dz);
}

double signed_area(std::span<const Point> polygon) {
  double twice = 0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    twice += polygon[j][0] * polygon[i][1] - polygon[i][0] * polygon[j][1];
  return twice / 2;
}

}  // namespace polder::stability
