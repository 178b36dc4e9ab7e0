#include <algorithm>
#include <cmath>
#include <limits>

#include "polder/stability/evolution.hpp"
#include "polder/stability/lines.hpp"
#include "polder/stability/trial.hpp"

namespace polder::stability {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Keeps the best surface of a minimisation.
struct Best {
  double factor = infinity;
  SlipSurface surface;
  double offer(double candidate, const SlipSurface& from) {
    if (candidate < factor) factor = candidate, surface = from;
    return candidate;
  }
  const SlipSurface* get() const { return std::isfinite(factor) ? &surface : nullptr; }
};

// Height above the plane of the centre of the circle that touches the plane at `foot` and passes through `end`.
double centre_height(const Point& end, double foot, double tangent) {
  const double rise = end[1] - tangent, run = end[0] - foot;
  return (run * run + rise * rise) / (2 * rise);
}

// Segments meet at more than 120°, and the surface is hollow upwards but for a little.
bool smooth(const Line& points) {
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double before = std::atan2(points[i][1] - points[i - 1][1], points[i][0] - points[i - 1][0]);
    const double after = std::atan2(points[i + 1][1] - points[i][1], points[i + 1][0] - points[i][0]);
    if (std::abs(after - before) > 1.0471975511965976 || after - before < -0.09) return false;
  }
  return true;
}

}  // namespace

SearchResult critical_uplift_van(const PreparedSection& prepared, const std::optional<UpliftVanArea>& area,
                                 const SearchOptions& options) {
  const Method method = [](const Slices& slices, const SlipSurface& surface) {
    return uplift_van(slices, surface.plane);
  };
  Trials trials{prepared, method, options};
  Best best;
  const auto attempt = [&](const UpliftVanPlane& plane) {
    const SlipSurface surface = uplift_van_surface(prepared, plane);
    return best.offer(trials.factor(surface), surface);
  };
  EvolutionOptions evolution;
  evolution.population = 60;
  evolution.generations = 150;
  evolution.seed = options.seed;
  if (area) {
    const double low[] = {area->active.low[0], area->active.low[1], area->passive.low[0], area->passive.low[1],
                          area->tangent[0]};
    const double high[] = {area->active.high[0], area->active.high[1], area->passive.high[0], area->passive.high[1],
                           area->tangent[1]};
    minimise(
        [&](std::span<const double> at) {
          return attempt({{at[0], at[1]}, {at[2], at[3]}, at[4]});
        },
        low, high, {}, evolution);
    return trials.finish(best.get());
  }
  // Anywhere: both ends on the ground, both feet of the circles and the level of the plane.
  const double left = prepared.left(), right = prepared.right();
  double bottom = infinity, top = -infinity;
  for (const Column& column : prepared.columns) {
    bottom = std::min({bottom, column.pieces.back().base[0], column.pieces.back().base[1]});
    top = std::max({top, column.pieces.front().top[0], column.pieces.front().top[1]});
  }
  const std::vector<double> low{left, 0, 0, 0, bottom}, high{right, 1, 1, 1, top};
  const auto objective = [&](double way) {
    return [&, way](std::span<const double> at) {
      // at: entry, then the rest of the way to the far side cut in shares: active foot, passive foot, exit.
      const double far = way > 0 ? right : left;
      const double active = at[0] + at[1] * (far - at[0]), passive = active + at[2] * (far - active);
      const double exit = passive + at[3] * (far - passive);
      const Point start{at[0], ground_level(prepared, at[0])}, end{exit, ground_level(prepared, exit)};
      if (start[1] - at[4] < 1e-3 || end[1] - at[4] < 1e-3)
        return trials.refuse("the horizontal plane lies above the ground");
      const double up_a = centre_height(start, active, at[4]), up_p = centre_height(end, passive, at[4]);
      if (up_a < start[1] - at[4] || up_p < end[1] - at[4]) return trials.refuse("an arc overhangs");
      return attempt({{active, at[4] + up_a}, {passive, at[4] + up_p}, at[4]});
    };
  };
  // Long planes and short ones are valleys of their own: several populations, for one may settle in the wrong valley.
  constexpr std::uint64_t populations = 4;
  const Movement movement = prepared.section.movement;
  for (std::uint64_t k = 0; k < populations; ++k, ++evolution.seed) {
    if (movement != Movement::left) minimise(objective(1), low, high, {}, evolution);
    if (movement != Movement::right) minimise(objective(-1), low, high, {}, evolution);
  }
  return trials.finish(best.get());
}

SearchResult critical_free_surface(const PreparedSection& prepared, const Method& method,
                                   const std::optional<FreeSurfaceBand>& band, const SearchOptions& options) {
  Trials trials{prepared, method, options, 0.8};
  Best best;
  EvolutionOptions evolution;
  evolution.population = 60;
  evolution.generations = 200;
  evolution.seed = options.seed;
  const auto attempt = [&](const Line& points) {
    if (!smooth(points)) return trials.refuse("a kink is too sharp");
    const SlipSurface surface = free_surface(prepared, points);
    return best.offer(trials.factor(surface), surface);
  };
  if (band) {
    const std::size_t n = band->upper.size();
    const std::vector<double> low(n, 0), high(n, 1);
    minimise(
        [&](std::span<const double> at) {
          Line points(n);
          for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < 2; ++k)
              points[i][k] = band->upper[i][k] + at[i] * (band->lower[i][k] - band->upper[i][k]);
          return attempt(points);
        },
        low, high, {}, evolution);
    return trials.finish(best.get());
  }
  SearchResult circle = critical_circle(
      prepared, [](const Slices& slices, const SlipSurface& surface) { return bishop(slices, surface.circle); }, {},
      options);
  if (!circle) return circle;
  // Vertices of the circle, free to move: the ends along the ground, the others across and a little along.
  constexpr std::size_t inner = 7;
  const SlipSurface& start = circle.surface;
  const double span = start.right - start.left;
  double deepest = 0;
  for (const Slice& slice : circle.slices.list) deepest = std::max(deepest, slice.top() - slice.base());
  const auto vertices = [&](std::span<const double> at) {
    const double left = std::clamp(start.left + at[0] * span, prepared.left() + 1e-6, prepared.right() - 1e-6);
    const double right = std::clamp(start.right + at[1] * span, prepared.left() + 1e-6, prepared.right() - 1e-6);
    Line points{{left, ground_level(prepared, left)}};
    for (std::size_t i = 0; i < inner; ++i) {
      const double share = (static_cast<double>(i + 1) + at[2 + i]) / (inner + 1);
      const double on_circle = start.left + share * span;
      points.push_back({left + share * (right - left), base_level(start, on_circle) + at[2 + inner + i] * deepest});
    }
    points.push_back({right, ground_level(prepared, right)});
    return points;
  };
  std::vector<double> low, high;
  const auto allow = [&](double from, double to) { low.push_back(from), high.push_back(to); };
  allow(-0.4, 0.4), allow(-0.4, 0.4);
  for (std::size_t i = 0; i < inner; ++i) allow(-0.45, 0.45);
  for (std::size_t i = 0; i < inner; ++i) allow(-0.8, 0.8);
  minimise([&](std::span<const double> at) { return attempt(vertices(at)); }, low, high,
           {std::vector<double>(2 + 2 * inner, 0.0)}, evolution);
  return trials.finish(best.get());
}

}  // namespace polder::stability
