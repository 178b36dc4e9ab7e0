#include "polder/grid/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polder {

namespace {

constexpr double covered_below = 0.1;    // open share of a cell below which it counts as covered
constexpr double merged_below = 0.5;     // likewise, where slivers belong to the cells beside them
constexpr double least_distance = 1e-6;  // cells: how close to a body a point may come
constexpr double on_surface = 1e-9;      // cells: a face's centre as near as this to a surface is on it

struct Nearest {
  double distance;
  Point2 point, normal;
};

/// The nearest point of a polygon's outline. The normal points out of the polygon.
Nearest nearest_on(std::span<const Point2> polygon, Point2 x) {
  Nearest best{std::numeric_limits<double>::infinity(), {}, {0, 1}};
  const double turn = signed_area(polygon) > 0 ? 1 : -1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double ex = b[0] - a[0], ey = b[1] - a[1], square = ex * ex + ey * ey;
    if (square == 0) continue;
    const double t = std::clamp(((x[0] - a[0]) * ex + (x[1] - a[1]) * ey) / square, 0.0, 1.0);
    const Point2 p{a[0] + t * ex, a[1] + t * ey};
    const double distance = std::hypot(x[0] - p[0], x[1] - p[1]);
    if (distance >= best.distance) continue;
    const double length = std::sqrt(square);
    best = {distance, p, {turn * ey / length, -turn * ex / length}};
  }
  return best;
}

/// Middle of the face of a component on the low side of cell (i, level) of the section; the last face of an axis, too.
template <class Space>
Point2 face_centre(const Lattice<Space>& lattice, int c, int i, int level) {
  const auto& x = lattice.axis[0];
  const auto& y = lattice.axis[Space::up];
  return {c == 0 ? x.edge(i) : x.centre(std::min(i, lattice.cells[0] - 1)),
          c == 0 ? y.centre(std::min(level, lattice.cells[Space::up] - 1)) : y.edge(level)};
}

}  // namespace

template <class Space>
Bodies<Space>::Bodies(const Lattice<Space>& lattice, std::vector<BodySection> sections, bool merges)
    : lattice_(lattice), sections_(std::move(sections)), face_(make_face_field(lattice)), cell_(lattice.make_array()) {
  constexpr int up = Space::up;
  const std::ptrdiff_t rise = lattice.stride[up];
  near_.assign(cell_.size(), 0);
  toward_open_.assign(cell_.size(), 0);
  std::fill(cell_.begin(), cell_.end(), 1.0);
  for (auto& f : face_) std::fill(f.begin(), f.end(), 1.0);
  std::vector<Bounds> extents;
  for (const BodySection& section : sections_) {
    extents.push_back(bounds(section.polygon));
    moves_ = moves_ || section.velocity[0] != 0 || section.velocity[1] != 0;
  }
  const auto touched = [&](Point2 low, Point2 high) {  // by any of them, on the cell or its faces
    return std::any_of(extents.begin(), extents.end(), [&](const Bounds& b) {
      return b.low[0] <= high[0] && b.high[0] >= low[0] && b.low[1] <= high[1] && b.high[1] >= low[1];
    });
  };
  Array slivers = lattice.make_array();

  const auto share = [](double open) { return open < 1e-6 ? 0 : open > 1 - 1e-12 ? 1 : open; };
  const int depth = Space::axes == 3 ? lattice.cells[1] : 1;
  const auto index = [&](int i, int across, int level) {
    return Space::axes == 3 ? lattice.index(i, across, level) : lattice.index(i, level);
  };
  for (int level = 0; level < lattice.cells[up]; ++level)
    for (int i = 0; i < lattice.cells[0]; ++i) {
      const Point2 low{lattice.axis[0].edge(i), lattice.axis[up].edge(level)};
      const Point2 high{low[0] + lattice.axis[0].width(i), low[1] + lattice.axis[up].width(level)};
      if (!touched(low, high)) continue;
      const double part = open_part(sections_, low, high).first;
      const double open = part < (merges ? merged_below : covered_below) ? 0 : share(part);
      const double left = share(open_share(low, {low[0], high[1]})), base = share(open_share(low, {high[0], low[1]}));
      for (int k = 0; k < depth; ++k) {
        const std::ptrdiff_t at = index(i, k, level);
        cell_[at] = open;
        slivers[at] = open == 0 && merges ? share(part) : 0;
        face_[0][at] = left;
        face_[up][at] = base;
        if constexpr (Space::axes == 3) face_[1][at] = open;
      }
    }
  // a covered cell has no open face
  for (int k = 0; k < depth; ++k)
    for (int level = 0; level < lattice.cells[up]; ++level)
      for (int i = 0; i < lattice.cells[0]; ++i) {
        const std::ptrdiff_t at = index(i, k, level);
        if (cell_[at] > 0) continue;
        for (int a = 0; a < Space::axes; ++a) face_[a][at] = face_[a][at + lattice.stride[a]] = 0;
      }
  for (int k = 0; k < depth; ++k)
    for (int level = 0; level < lattice.cells[up]; ++level)
      for (int i = 0; i < lattice.cells[0]; ++i) {
        const std::ptrdiff_t at = index(i, k, level);
        double most = cell_[at];
        for (int b = -1; b <= 1; ++b)
          for (int a = -1; a <= 1; ++a) {
            if (i + a < 0 || i + a >= lattice.cells[0] || level + b < 0 || level + b >= lattice.cells[up]) continue;
            const std::ptrdiff_t step = a + b * rise;
            if (cell_[at + step] < 1) near_[at] = 1;
            if (cell_[at] == 0 && cell_[at + step] > most)
              most = cell_[at + step], toward_open_[at] = static_cast<std::int32_t>(step);
          }
      }
  own_ = cell_;
  merges_ = merges;
  for (std::size_t n = 0; n < slivers.size(); ++n) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(n), to = at + toward_open_[n];
    if (slivers[n] > 0 && to != at) cell_[to] += slivers[n] * lattice.cell_volume(at) / lattice.cell_volume(to);
  }
  for (auto& flags : inside_) flags.assign(cell_.size(), 0);
  for (int k = 0; k < depth; ++k)
    for (int level = 0; level <= lattice.cells[up]; ++level)
      for (int i = 0; i <= lattice.cells[0]; ++i) {
        const std::ptrdiff_t at = index(i, k, level);
        for (const int c : {0, up}) {
          const Point2 x = face_centre(lattice, c, i, level);
          const bool beside = near_[at] || (i > 0 && near_[at - 1]) || (level > 0 && near_[at - rise]);
          const bool shut = merges && face_[c][at] == 0;
          inside_[c][at] = beside && (shut || contact(x).distance <= on_surface * lattice.smallest_spacing());
        }
      }
  if (!moves_) return;
  flux_ = make_face_field(lattice);
  for (int k = 0; k < depth; ++k)
    for (int level = 0; level <= lattice.cells[up]; ++level)
      for (int i = 0; i <= lattice.cells[0]; ++i) {
        const std::ptrdiff_t at = index(i, k, level);
        for (const int c : {0, up}) {
          if (face_[c][at] == 1) continue;
          const Point2 x = face_centre(lattice, c, i, level);
          flux_[c][at] = (1 - face_[c][at]) * contact(x).velocity[c != 0];
        }
      }
}

std::pair<double, Point2> open_part(std::span<const BodySection> bodies, Point2 low, Point2 high) {
  const double box = (high[0] - low[0]) * (high[1] - low[1]);
  double open = box;
  Point2 moment{box * 0.5 * (low[0] + high[0]), box * 0.5 * (low[1] + high[1])};
  for (const BodySection& section : bodies) {
    const auto part = clip(section.polygon, Bounds{low, high});
    for (std::size_t i = 0; i + 2 < part.size(); ++i) {  // a fan of triangles
      const Point2 &a = part[0], &b = part[i + 1], &c = part[i + 2];
      const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      const double covered = 0.5 * twice * (signed_area(section.polygon) > 0 ? 1 : -1);
      open -= covered;
      for (std::size_t k = 0; k < 2; ++k) moment[k] -= covered * (a[k] + b[k] + c[k]) / 3;
    }
  }
  if (open <= 1e-12 * box) return {0, low};
  return {std::min(1.0, open / box), {moment[0] / open, moment[1] / open}};
}

/// Of a straight line between two points: cut where it crosses outlines, and each piece asked at its middle.
template <class Space>
double Bodies<Space>::open_share(Point2 from, Point2 to) const {
  const Point2 d{to[0] - from[0], to[1] - from[1]};
  std::vector<double> cuts{0, 1};
  for (const BodySection& section : sections_)
    for (std::size_t i = 0; i < section.polygon.size(); ++i) {
      const Point2 a = section.polygon[i], b = section.polygon[(i + 1) % section.polygon.size()];
      const double ex = b[0] - a[0], ey = b[1] - a[1], cross = d[0] * ey - d[1] * ex;
      if (cross == 0) continue;
      const double t = ((a[0] - from[0]) * ey - (a[1] - from[1]) * ex) / cross;
      if (t > 0 && t < 1) cuts.push_back(t);
    }
  std::sort(cuts.begin(), cuts.end());
  double open = 0;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    const double middle = 0.5 * (cuts[c] + cuts[c + 1]);
    const Point2 x{from[0] + middle * d[0], from[1] + middle * d[1]};
    if (std::none_of(sections_.begin(), sections_.end(), [&](const auto& s) { return contains(s.polygon, x); }))
      open += cuts[c + 1] - cuts[c];
  }
  return open;
}

template <class Space>
BodyContact Bodies<Space>::contact(Point2 place, double ahead) const {
  BodyContact best{std::numeric_limits<double>::infinity(), {0, 1}, 0, {}, 0};
  for (const BodySection& section : sections_) {
    const Point2 x{place[0] - ahead * section.velocity[0], place[1] - ahead * section.velocity[1]};
    const Nearest near = nearest_on(section.polygon, x);
    const bool inside = contains(section.polygon, x);
    const double distance = inside ? -near.distance : near.distance;
    if (distance >= best.distance) continue;
    Point2 normal = near.normal;
    if (near.distance > 1e-9 * lattice_.smallest_spacing())  // at a corner: away from it
      normal = {(x[0] - near.point[0]) / distance, (x[1] - near.point[1]) / distance};
    best = {distance, normal, section.friction, section.velocity,
            static_cast<std::size_t>(&section - sections_.data())};
  }
  return best;
}

template <class Space>
void Bodies<Space>::push_out(std::array<double, 3>& x, double ahead) const {
  const double gap = least_distance * lattice_.smallest_spacing();
  for (int pass = 0; pass < 3; ++pass) {  // out of one body may be into its neighbour
    const BodyContact at = contact({x[0], x[Space::up]}, ahead);
    if (at.distance >= gap) return;
    x[0] += (2 * gap - at.distance) * at.normal[0];
    x[Space::up] += (2 * gap - at.distance) * at.normal[1];
  }
}

template class Bodies<PlaneStrain>;
template class Bodies<Solid>;

}  // namespace polder
