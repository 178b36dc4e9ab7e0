#include "polder/stability/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "polder/stability/evolution.hpp"
#include "polder/stability/trial.hpp"

namespace polder::stability {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The circle through two points of the ground, `depth` times their distance deep at its middle.
Circle through(const Point& a, const Point& b, double depth) {
  const double dx = b[0] - a[0], dz = b[1] - a[1], chord = std::hypot(dx, dz);
  const double sagitta = depth * chord;
  const double radius = (chord * chord / 4 + sagitta * sagitta) / (2 * sagitta);
  const double rise = (radius - sagitta) / chord;
  return {{(a[0] + b[0]) / 2 - dz * rise, (a[1] + b[1]) / 2 + dx * rise}, radius};
}

// Ends and depth of a circle's surface: the coordinates in which circles are optimised.
std::vector<double> coordinates(const SlipSurface& surface) {
  const double z0 = base_level(surface, surface.left), z1 = base_level(surface, surface.right);
  const double chord = std::hypot(surface.right - surface.left, z1 - z0);
  const double half = std::min(chord / 2, surface.circle.radius);
  const double sagitta = surface.circle.radius - std::sqrt(surface.circle.radius * surface.circle.radius - half * half);
  return {surface.left, surface.right, sagitta / chord};
}

struct CircleSearch {
  Trials trials;
  struct Found {
    double factor;
    SlipSurface surface;
  };
  std::vector<Found> best;  // the least few, ascending

  double attempt(const Circle& circle) {
    const SlipSurface surface = circle_surface(trials.prepared, circle);
    const double factor = trials.factor(surface);
    if (std::isfinite(factor)) keep(factor, surface);
    return factor;
  }

  void keep(double factor, const SlipSurface& surface) {
    constexpr std::size_t most = 20;
    if (best.size() == most && factor >= best.back().factor) return;
    const auto place = std::upper_bound(best.begin(), best.end(), factor,
                                        [](double f, const Found& found) { return f < found.factor; });
    best.insert(place, {factor, surface});
    if (best.size() > most) best.pop_back();
  }
};

// All centres and tangents of the grid; grown by half its size, up to ten times, while the least lies on an edge.
void search_grid(CircleSearch& search, CircleGrid grid, std::vector<CentreFactor>& contours) {
  for (int growth = 0; growth <= 10; ++growth) {
    contours.clear();
    double least = infinity;
    int at_x = 0, at_z = 0, at_t = 0;
    for (int iz = 0; iz < grid.count_z; ++iz)
      for (int ix = 0; ix < grid.count_x; ++ix) {
        const Point centre{grid.corner[0] + ix * grid.spacing_x, grid.corner[1] + iz * grid.spacing_z};
        double here = infinity;
        for (int it = 0; it < grid.tangents; ++it) {
          const double radius = centre[1] - (grid.tangent + it * grid.tangent_spacing);
          if (radius <= 0) continue;
          const double factor = search.attempt({centre, radius});
          here = std::min(here, factor);
          if (factor < least) least = factor, at_x = ix, at_z = iz, at_t = it;
        }
        if (std::isfinite(here)) contours.push_back({centre, here});
      }
    if (!std::isfinite(least)) return;
    bool grown = false;
    const auto grow = [&](int at, int& count, double& start, double spacing) {
      if (count < 2 || (at > 0 && at < count - 1)) return;
      const int more = std::max(1, count / 2);
      if (at == 0) start -= more * spacing;
      count += more;
      grown = true;
    };
    grow(at_x, grid.count_x, grid.corner[0], grid.spacing_x);
    grow(at_z, grid.count_z, grid.corner[1], grid.spacing_z);
    grow(at_t, grid.tangents, grid.tangent, grid.tangent_spacing);
    if (!grown) return;
  }
}

}  // namespace

double Trials::factor(const SlipSurface& surface) {
  ++count;
  if (!surface) return refuse(surface.problem);
  const Slices slices = cut_slices(prepared, surface, options.slices);
  if (!slices) return refuse(slices.problem.substr(0, slices.problem.find(" at x")));
  const std::string limit = broken_limit(prepared, surface, slices);
  if (!limit.empty()) return refuse("limit: " + limit);
  const Equilibrium equilibrium = method(slices, surface);
  if (!equilibrium) return refuse(equilibrium.problem);
  if (equilibrium.thrust_inside < least_thrust) return refuse("the line of thrust leaves the soil");
  return equilibrium.factor;
}

double Trials::refuse(const std::string& reason) {
  ++refused[reason];
  return infinity;
}

SearchResult Trials::finish(const SlipSurface* surface) const {
  SearchResult result;
  result.trials = count;
  result.refused = refused;
  if (surface == nullptr) {
    result.problem = fmt::format("none of {} trial surfaces can be used", count);
    std::vector<std::pair<int, std::string>> reasons;
    for (const auto& [reason, times] : refused) reasons.emplace_back(times, reason);
    std::sort(reasons.rbegin(), reasons.rend());
    for (const auto& [times, reason] : reasons) result.problem += fmt::format("\n  {} times: {}", times, reason);
    result.problem +=
        "\nWiden the limits (entry, exit, minimum_depth, minimum_length and forbidden_line of [stability]), or draw a "
        "section with a slope";
    return result;
  }
  result.surface = *surface;
  for (const int number : {options.final_slices, options.slices}) {  // the trial's own slices are known to work
    result.slices = cut_slices(prepared, *surface, number);
    if (!result.slices) continue;
    result.equilibrium = method(result.slices, *surface);
    if (result.equilibrium) return result;
  }
  result.problem = result.slices ? result.equilibrium.problem : result.slices.problem;
  return result;
}

SearchResult evaluate(const PreparedSection& prepared, const SlipSurface& surface, const Method& method,
                      const SearchOptions& options) {
  SearchResult result;
  result.trials = 1;
  if (!surface) {
    result.problem = surface.problem;
    return result;
  }
  result.surface = surface;
  result.slices = cut_slices(prepared, surface, options.final_slices);
  if (!result.slices) {
    result.problem = result.slices.problem;
    return result;
  }
  result.equilibrium = method(result.slices, surface);
  result.problem = result.equilibrium.problem;
  return result;
}

SearchResult critical_circle(const PreparedSection& prepared, const Method& method,
                             const std::optional<CircleGrid>& grid, const SearchOptions& options) {
  CircleSearch search{{prepared, method, options}, {}};
  std::vector<CentreFactor> contours;
  const double left = prepared.left(), right = prepared.right();
  const auto on_ground = [&](double x) {
    const double inside = std::clamp(x, left + 1e-6, right - 1e-6);
    return Point{inside, ground_level(prepared, inside)};
  };
  if (grid) {
    search_grid(search, *grid, contours);
  } else {
    // Ends spread over their limits; which end is the entry depends on the direction of sliding.
    const SlipLimits& limits = prepared.section.limits;
    const Range whole{left, right};
    const auto lay_out = [&](const Range& lefts, const Range& rights) {
      const int n = options.entries;
      const auto spread = [&](const Range& range, int i) { return range[0] + (range[1] - range[0]) * i / n; };
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
          const Point a = on_ground(spread(lefts, i)), b = on_ground(spread(rights, j));
          if (b[0] - a[0] < 1e-3) continue;
          for (int k = 1; k <= options.depths; ++k)
            search.attempt(through(a, b, 0.5 * std::pow(static_cast<double>(k) / options.depths, 1.5)));
        }
    };
    const Range entry = limits.entry.value_or(whole), exit = limits.exit.value_or(whole);
    if (prepared.section.movement != Movement::left) lay_out(entry, exit);
    const bool limited = limits.entry || limits.exit;
    if (prepared.section.movement == Movement::left || (limited && prepared.section.movement == Movement::automatic))
      lay_out(exit, entry);
  }
  if (options.refine && !search.best.empty()) {
    std::vector<std::vector<double>> starts;
    for (const auto& found : search.best) starts.push_back(coordinates(found.surface));
    const double low[] = {left, left, 0.01}, high[] = {right, right, 0.6};
    EvolutionOptions evolution;
    evolution.seed = options.seed;
    const Minimum minimum = minimise(
        [&](std::span<const double> at) {
          if (at[1] - at[0] < 1e-3) return infinity;
          return search.attempt(through(on_ground(at[0]), on_ground(at[1]), at[2]));
        },
        low, high, starts, evolution);
    static_cast<void>(minimum);  // `attempt` keeps the best surfaces itself
  }
  SearchResult result = search.trials.finish(search.best.empty() ? nullptr : &search.best.front().surface);
  result.contours = std::move(contours);
  return result;
}

}  // namespace polder::stability
