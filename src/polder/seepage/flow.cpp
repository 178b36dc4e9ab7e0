#include "polder/seepage/flow.hpp"

#include <fmt/format.h>

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <map>
#include <stdexcept>

namespace polder {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

double relative(const FlowMaterial& m, double unit_weight, double psi) {
  return std::max(relative_conductivity(m.curve, m.retention, -psi * unit_weight), m.least_relative);
}

/// dk_r/dψ, 1/m, by a difference towards the drier side (k_r may have a corner at saturation).
double relative_slope(const FlowMaterial& m, double unit_weight, double psi) {
  if (psi >= 0) return 0;
  const double d = 1e-6 * (1e-2 + std::abs(psi));
  return (relative(m, unit_weight, psi) - relative(m, unit_weight, psi - d)) / d;
}

}  // namespace

struct FlowSolver::NodeCondition {
  enum Kind { interior, head, face } kind = interior;
  double head_value = 0;
  double rain = 0;  ///< m²/s offered at the node
};

FlowSolver::FlowSolver(FlowProblem problem) : problem_(std::move(problem)) {
  const Mesh& mesh = *problem_.mesh;
  for (int e = 0; e < static_cast<int>(mesh.triangles.size()); ++e) {
    const int region = mesh.region[e];
    if (region < 0 || region >= static_cast<int>(problem_.materials.size()))
      throw std::invalid_argument(fmt::format("seepage: no material for region {} of the mesh", region));
    const auto& k = problem_.materials[region].conductivity;
    for (const auto& sub : sub_triangles) {
      Piece piece{{}, region, static_cast<std::size_t>(e), 0, {}};
      for (int i = 0; i < 3; ++i) piece.node[i] = mesh.triangles[e][sub[i]];
      std::array<double, 3> gx{}, gy{};
      for (int i = 0; i < 3; ++i) {
        const Point2 &q = mesh.nodes[piece.node[(i + 1) % 3]], &r = mesh.nodes[piece.node[(i + 2) % 3]];
        gx[i] = q[1] - r[1];
        gy[i] = r[0] - q[0];
      }
      const double twice = gx[0] * gy[1] - gx[1] * gy[0];
      piece.area = twice / 2;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          piece.conductance[i][j] = (k[0] * gx[i] * gx[j] + k[1] * gy[i] * gy[j]) / (2 * twice);
      pieces_.push_back(piece);
    }
  }
  conductance_.assign(mesh.nodes.size(), 0);
  for (const Piece& piece : pieces_)
    for (int i = 0; i < 3; ++i) conductance_[piece.node[i]] += piece.conductance[i][i];

  double size = 0;
  for (const auto& p : mesh.nodes) size = std::max({size, std::abs(p[0]), std::abs(p[1])});
  const auto sides = outline(mesh);
  for (const auto& boundary : problem_.boundaries) {
    BoundaryNodes found;
    std::map<int, int> place;
    double total = 0;
    for (std::size_t i = 0; i + 1 < boundary.line.size(); ++i)
      total += std::hypot(boundary.line[i + 1][0] - boundary.line[i][0], boundary.line[i + 1][1] - boundary.line[i][1]);
    const auto position = [&](int n) {
      const auto [it, fresh] = place.try_emplace(n, static_cast<int>(found.node.size()));
      if (fresh) {
        const Point2& p = mesh.nodes[n];
        double best = forever, along = 0, before = 0;
        for (std::size_t i = 0; i + 1 < boundary.line.size(); ++i) {
          const Point2 &a = boundary.line[i], &b = boundary.line[i + 1];
          const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
          if (const double d = distance_to_segment(p, a, b); d < best) {
            best = d;
            along = before + ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / length;
          }
          before += length;
        }
        found.node.push_back(n);
        found.length.push_back(0);
        found.along.push_back(std::clamp(along / total, 0.0, 1.0));
      }
      return it->second;
    };
    for (const auto& side : sides) {
      if (!side_lies_on(mesh, side, boundary.line, 1e-5 * size)) continue;
      const double half =
          std::hypot(mesh.nodes[side.a][0] - mesh.nodes[side.b][0], mesh.nodes[side.a][1] - mesh.nodes[side.b][1]) / 2;
      for (const auto& [a, b] : {std::pair{side.a, side.middle}, {side.middle, side.b}}) {
        const int i = position(a), j = position(b);
        found.length[i] += half / 2;
        found.length[j] += half / 2;
        found.side.push_back({i, j});
      }
    }
    if (found.node.empty())
      throw std::invalid_argument(
          fmt::format("seepage: boundary '{}' lies on no side of the soil's outline; its line must follow the outline",
                      boundary.name));
    boundaries_.push_back(std::move(found));
  }
}

std::vector<FlowSolver::NodeCondition> FlowSolver::conditions(double time) const {
  const Mesh& mesh = *problem_.mesh;
  std::vector<NodeCondition> all(mesh.nodes.size());
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    const FlowBoundary& boundary = problem_.boundaries[b];
    const double start = boundary.head(time);
    const double end = boundary.head_at_end ? (*boundary.head_at_end)(time) : start;
    for (std::size_t i = 0; i < boundaries_[b].node.size(); ++i) {
      const int n = boundaries_[b].node[i];
      NodeCondition& c = all[n];
      const double head = start + boundaries_[b].along[i] * (end - start);
      if (boundary.condition == FlowCondition::head && mesh.nodes[n][1] <= head + 1e-9) {
        c.kind = NodeCondition::head;
        c.head_value = head;
      } else if (c.kind != NodeCondition::head &&
                 (boundary.condition != FlowCondition::head || boundary.seepage_above)) {
        c.kind = NodeCondition::face;
        if (boundary.condition == FlowCondition::rain) c.rain += boundary.rate(time) * boundaries_[b].length[i];
      }
    }
  }
  return all;
}

void FlowSolver::scale_conductivity(std::vector<double> factor) {
  if (factor.size() != problem_.mesh->triangles.size())
    throw std::invalid_argument("seepage: a factor on the conductivity is needed for every triangle");
  scale_ = std::move(factor);
}

double FlowSolver::stored(const FlowState& state) const {
  double sum = 0;
  for (const Piece& piece : pieces_) {
    const FlowMaterial& m = problem_.materials[piece.material];
    for (const int n : piece.node) {
      const double psi = state.head[n] - problem_.mesh->nodes[n][1];
      const double s = saturation(m.retention, -psi * problem_.unit_weight);
      sum += piece.area / 3 * (m.porosity * s + m.specific_storage * s * psi);
    }
  }
  return sum;
}

FlowState FlowSolver::hydrostatic(double head) const {
  const std::size_t n = problem_.mesh->nodes.size();
  return {0, std::vector<double>(n, head), std::vector<bool>(n, false), std::vector<double>(n, 0)};
}

/// One backward Euler step of `dt` (infinite: steady). On success `state` holds the end of the step.
bool FlowSolver::step(FlowState& state, double dt, const FlowOptions& options, int& iterations) const {
  const Mesh& mesh = *problem_.mesh;
  const double gamma = problem_.unit_weight;
  const int count = static_cast<int>(mesh.nodes.size());
  const auto condition = conditions(state.time + (dt == forever ? 0 : dt));
  std::vector<double> h = state.head;
  std::vector<bool> exit = state.exit;
  for (int n = 0; n < count; ++n) {
    if (condition[n].kind == NodeCondition::head) h[n] = condition[n].head_value;
    if (condition[n].kind != NodeCondition::face)
      exit[n] = false;
    else if (exit[n])
      h[n] = mesh.nodes[n][1];
  }

  // Water that flows out of each node into its triangles and its store: minus what leaves the section there.
  const auto balance = [&](const std::vector<double>& head, Eigen::VectorXd& r,
                           std::vector<Eigen::Triplet<double>>* jacobian, bool newton) {
    r.setZero(count);
    for (const Piece& piece : pieces_) {
      const FlowMaterial& m = problem_.materials[piece.material];
      double kr = 0;
      std::array<double, 3> slope{};
      for (int i = 0; i < 3; ++i) {
        const double psi = head[piece.node[i]] - mesh.nodes[piece.node[i]][1];
        kr += relative(m, gamma, psi) / 3;
        if (newton) slope[i] = relative_slope(m, gamma, psi) / 3;
      }
      const double scale = conductivity_scale(piece.triangle);
      kr *= scale;
      for (double& s : slope) s *= scale;
      for (int i = 0; i < 3; ++i) {
        double flow = 0;
        for (int j = 0; j < 3; ++j) flow += piece.conductance[i][j] * head[piece.node[j]];
        r[piece.node[i]] += kr * flow;
        if (jacobian)
          for (int j = 0; j < 3; ++j)
            jacobian->emplace_back(piece.node[i], piece.node[j], kr * piece.conductance[i][j] + slope[j] * flow);
        if (dt == forever) continue;
        const int n = piece.node[i];
        const double y = mesh.nodes[n][1], psi = head[n] - y, old = state.head[n] - y;
        const double s = saturation(m.retention, -psi * gamma), s_old = saturation(m.retention, -old * gamma);
        const double c = capacity(m.retention, -psi * gamma) * gamma;
        const double volume = piece.area / (3 * dt);
        r[n] += volume * (m.porosity * (s - s_old) + m.specific_storage * (s * psi - s_old * old));
        if (jacobian) jacobian->emplace_back(n, n, volume * (m.porosity * c + m.specific_storage * (s + c * psi)));
      }
    }
  };
  const auto norm = [&](const Eigen::VectorXd& r) {
    double sum = 0;
    for (int n = 0; n < count; ++n)
      if (condition[n].kind != NodeCondition::head && !exit[n]) sum += std::pow(r[n] - condition[n].rain, 2);
    return std::sqrt(sum);
  };

  Eigen::VectorXd r;
  Eigen::SparseMatrix<double> matrix(count, count);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver;
  std::vector<int> switches(count, 0);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    ++iterations;
    triplets.clear();
    balance(h, r, &triplets, iteration >= 2);
    // Active set: a dry node that would come under pressure is opened, an open one that draws water in is closed.
    bool changed = false;
    for (int n = 0; n < count; ++n) {
      if (condition[n].kind != NodeCondition::face) continue;
      const bool opens = !exit[n] && h[n] > mesh.nodes[n][1] + options.tolerance;
      // Inflow below what the tolerance in head can cause is round-off, and would set off a cycle.
      const bool closes = exit[n] && r[n] - condition[n].rain > options.tolerance * conductance_[n];
      if (!opens && !closes) continue;
      changed = true;
      if (++switches[n] > 8) continue;  // in a cycle: leave it, and let the step fail unless the others free it
      exit[n] = opens;
    }
    Eigen::VectorXd rhs(count);
    for (int n = 0; n < count; ++n)
      rhs[n] = condition[n].kind == NodeCondition::head ? 0
               : exit[n]                                ? mesh.nodes[n][1] - h[n]
                                                        : condition[n].rain - r[n];
    for (auto& t : triplets)
      if (condition[t.row()].kind == NodeCondition::head || exit[t.row()]) t = {t.row(), t.col(), 0.0};
    for (int n = 0; n < count; ++n)
      if (condition[n].kind == NodeCondition::head || exit[n]) triplets.emplace_back(n, n, 1.0);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    if (iteration == 0) solver.analyzePattern(matrix);
    solver.factorize(matrix);
    if (solver.info() != Eigen::Success) return false;
    const Eigen::VectorXd change = solver.solve(rhs);
    if (!change.allFinite()) return false;

    const double before = norm(r);
    double share = 1;
    std::vector<double> trial(count);
    for (int cut = 0;; ++cut, share /= 2) {
      for (int n = 0; n < count; ++n) trial[n] = h[n] + (exit[n] || cut == 0 ? 1.0 : share) * change[n];
      if (changed || iteration < 2 || cut == 4) break;
      Eigen::VectorXd tried;
      balance(trial, tried, nullptr, false);
      if (norm(tried) <= before) break;
    }
    h = trial;
    if (!changed && share == 1 && change.lpNorm<Eigen::Infinity>() < options.tolerance) {
      balance(h, r, nullptr, false);
      for (int n = 0; n < count; ++n)
        r[n] = condition[n].kind == NodeCondition::head || exit[n] ? -r[n] : -condition[n].rain;
      state.outflow.assign(r.data(), r.data() + count);
      state.head = std::move(h);
      state.exit = std::move(exit);
      if (dt != forever) state.time += dt;
      return true;
    }
  }
  return false;
}

FlowState FlowSolver::steady(double time, const FlowOptions& options) const {
  double highest = -forever;
  for (const auto& b : problem_.boundaries)
    if (b.condition == FlowCondition::head) highest = std::max(highest, b.head(time));
  if (highest == -forever) {
    for (const auto& p : problem_.mesh->nodes) highest = std::max(highest, p[1]);
  }
  FlowState state = hydrostatic(highest);
  state.time = time;
  int iterations = 0;
  if (step(state, forever, options, iterations)) return state;

  // March in false time with ever longer steps, which never stalls, until the steady equations can be solved.
  FlowProblem frozen = problem_;
  for (auto& b : frozen.boundaries) {
    b.head = Table::constant(b.head(time));
    if (b.head_at_end) b.head_at_end = Table::constant((*b.head_at_end)(time));
    b.rate = Table::constant(b.rate(time));
  }
  const FlowSolver marching(std::move(frozen));
  double fastest = 0, extent = 0;
  for (const auto& m : problem_.materials) fastest = std::max({fastest, m.conductivity[0], m.conductivity[1]});
  for (const auto& p : problem_.mesh->nodes) extent = std::max(extent, std::abs(p[1]) + std::abs(p[0]));
  double dt = 1e-3 * extent / fastest;
  for (int k = 0; k < 400; ++k) {
    FlowState next = state;
    if (!marching.step(next, dt, options, iterations)) {
      dt /= 4;
      continue;
    }
    state = next;
    dt *= 1.7;
    if (k % 5 == 4 && marching.step(next, forever, options, iterations)) {
      next.time = time;
      return next;
    }
  }
  throw std::runtime_error("seepage: no steady state found; check that a head is given somewhere and refine the mesh");
}

FlowTally FlowSolver::advance(FlowState& state, double until, const FlowOptions& options) const {
  FlowTally tally;
  const double span = until - state.time;
  const double longest = options.longest_step > 0 ? options.longest_step : span / 100;
  double dt = std::min(options.first_step > 0 ? options.first_step : span / 1000, longest);
  const double before = stored(state);
  while (state.time < until - 1e-9 * span) {
    const double now = std::min(dt, until - state.time);
    int iterations = 0;
    if (!step(state, now, options, iterations)) {
      ++tally.rejected;
      dt = now / 3;
      if (dt < 1e-9 * span)
        throw std::runtime_error(fmt::format("seepage: no convergence at t = {} s with steps of {} s", state.time, dt));
      continue;
    }
    ++tally.steps;
    tally.iterations += iterations;
    for (const double q : state.outflow) tally.inflow -= q * now;
    if (iterations <= 6) dt = std::min(1.4 * std::max(dt, now), longest);
    if (iterations > 12) dt = now * 0.7;
  }
  tally.storage = stored(state) - before;
  return tally;
}

}  // namespace polder
