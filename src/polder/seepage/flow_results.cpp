#include "polder/seepage/flow_results.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace polder {
namespace {

struct SubTriangle {
  std::array<int, 3> node;
  int material;
  std::size_t triangle;
};

template <class F>
void for_each_piece(const Mesh& mesh, F f) {
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e)
    for (const auto& sub : sub_triangles)
      f(SubTriangle{
          {mesh.triangles[e][sub[0]], mesh.triangles[e][sub[1]], mesh.triangles[e][sub[2]]}, mesh.region[e], e});
}

/// Specific discharge in a linear triangle, and twice its area.
Point2 darcy(const FlowSolver& solver, const FlowState& state, const SubTriangle& t, double& twice) {
  const FlowProblem& problem = solver.problem();
  const Mesh& mesh = *problem.mesh;
  const FlowMaterial& m = problem.materials[t.material];
  const Point2 &a = mesh.nodes[t.node[0]], &b = mesh.nodes[t.node[1]], &c = mesh.nodes[t.node[2]];
  twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const double h0 = state.head[t.node[0]], h1 = state.head[t.node[1]], h2 = state.head[t.node[2]];
  const Point2 gradient{(h0 * (b[1] - c[1]) + h1 * (c[1] - a[1]) + h2 * (a[1] - b[1])) / twice,
                        (h0 * (c[0] - b[0]) + h1 * (a[0] - c[0]) + h2 * (b[0] - a[0])) / twice};
  double kr = 0;
  for (const int n : t.node)
    kr +=
        std::max(relative_conductivity(m.curve, m.retention, (mesh.nodes[n][1] - state.head[n]) * problem.unit_weight),
                 m.least_relative) /
        3;
  kr *= solver.conductivity_scale(t.triangle);
  return {-m.conductivity[0] * kr * gradient[0], -m.conductivity[1] * kr * gradient[1]};
}

}  // namespace

std::vector<double> pore_pressure(const FlowSolver& solver, const FlowState& state) {
  std::vector<double> p(state.head.size());
  for (std::size_t n = 0; n < p.size(); ++n)
    p[n] = (state.head[n] - solver.problem().mesh->nodes[n][1]) * solver.problem().unit_weight;
  return p;
}

double discharge(const FlowSolver& solver, const FlowState& state, int boundary) {
  double sum = 0;
  for (const int n : solver.boundary_nodes(boundary).node) sum += state.outflow[n];
  return sum;
}

double discharge_through(const FlowSolver& solver, const FlowState& state, std::span<const Point2> section) {
  const Mesh& mesh = *solver.problem().mesh;
  double sum = 0;
  for (std::size_t i = 0; i + 1 < section.size(); ++i) {
    const Point2 &a = section[i], &b = section[i + 1];
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    for_each_piece(mesh, [&](const SubTriangle& t) {
      // The share of the piece of section inside the triangle, by clipping against its three sides.
      double from = 0, to = 1;
      for (int k = 0; k < 3; ++k) {
        const Point2 &p = mesh.nodes[t.node[k]], &q = mesh.nodes[t.node[(k + 1) % 3]];
        const double ex = q[0] - p[0], ey = q[1] - p[1];
        const double at = ex * (a[1] - p[1]) - ey * (a[0] - p[0]), rate = ex * dy - ey * dx;
        if (std::abs(rate) < 1e-14 * (std::abs(ex) + std::abs(ey)) * (std::abs(dx) + std::abs(dy))) {
          if (at < 0) to = from;
        } else if (rate > 0) {
          from = std::max(from, -at / rate);
        } else {
          to = std::min(to, -at / rate);
        }
      }
      if (to <= from) return;
      double twice = 0;
      const Point2 q = darcy(solver, state, t, twice);
      sum += (to - from) * (q[0] * dy - q[1] * dx);
    });
  }
  return sum;
}

ExitFlow exit_flow(const FlowSolver& solver, const FlowState& state, int boundary) {
  const auto& nodes = solver.boundary_nodes(boundary);
  const Mesh& mesh = *solver.problem().mesh;
  const int count = static_cast<int>(nodes.node.size());
  // Flow per length q from the nodal outflows: ∫ N_i N_j ds q_j = outflow_i.
  Eigen::SparseMatrix<double> mass(count, count);
  std::vector<Eigen::Triplet<double>> entries;
  ExitFlow result;
  std::vector<double> conductivity(count, 0);
  for (const auto& [i, j] : nodes.side) {
    const Point2 &a = mesh.nodes[nodes.node[i]], &b = mesh.nodes[nodes.node[j]];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    for (const auto& [p, q, share] : {std::tuple{i, i, 3.0}, {j, j, 3.0}, {i, j, 6.0}, {j, i, 6.0}})
      entries.emplace_back(p, q, length / share);
  }
  mass.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd outflow(count);
  for (int i = 0; i < count; ++i) outflow[i] = state.outflow[nodes.node[i]];
  const Eigen::VectorXd q = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(mass).solve(outflow);

  // Conductivity along the normal, from the triangles on the boundary.
  std::vector<int> place(mesh.nodes.size(), -1);
  for (int i = 0; i < count; ++i) place[nodes.node[i]] = i;
  for (const auto& side : outline(mesh)) {
    if (place[side.a] < 0 || place[side.b] < 0) continue;
    const double dx = mesh.nodes[side.b][0] - mesh.nodes[side.a][0], dy = mesh.nodes[side.b][1] - mesh.nodes[side.a][1];
    const auto& k = solver.problem().materials[mesh.region[side.triangle]].conductivity;
    const double normal = solver.conductivity_scale(static_cast<std::size_t>(side.triangle)) *
                          (k[0] * dy * dy + k[1] * dx * dx) / (dx * dx + dy * dy);
    for (const int n : {side.a, side.middle, side.b}) conductivity[place[n]] = std::max(conductivity[place[n]], normal);
  }
  for (int i = 0; i < count; ++i) {
    result.at.push_back(mesh.nodes[nodes.node[i]]);
    result.specific_flow.push_back(q[i]);
    result.gradient.push_back(conductivity[i] > 0 ? q[i] / conductivity[i] : 0);
  }
  return result;
}

std::vector<std::array<Point2, 2>> phreatic_line(const FlowSolver& solver, const FlowState& state) {
  const Mesh& mesh = *solver.problem().mesh;
  std::vector<std::array<Point2, 2>> pieces;
  for_each_piece(mesh, [&](const SubTriangle& t) {
    std::vector<Point2> ends;
    for (int k = 0; k < 3; ++k) {
      const int i = t.node[k], j = t.node[(k + 1) % 3];
      const double a = state.head[i] - mesh.nodes[i][1], b = state.head[j] - mesh.nodes[j][1];
      if ((a >= 0) == (b >= 0)) continue;
      const double s = a / (a - b);
      ends.push_back({mesh.nodes[i][0] + s * (mesh.nodes[j][0] - mesh.nodes[i][0]),
                      mesh.nodes[i][1] + s * (mesh.nodes[j][1] - mesh.nodes[i][1])});
    }
    if (ends.size() == 2) pieces.push_back({ends[0], ends[1]});
  });
  return pieces;
}

std::vector<std::optional<double>> phreatic_heights(const FlowSolver& solver, const FlowState& state,
                                                    std::span<const double> xs) {
  const Mesh& mesh = *solver.problem().mesh;
  const auto line = phreatic_line(solver, state);
  const auto sides = outline(mesh);
  // Water stands on the ground where it has a head; under what is closed there is only pressure.
  std::vector<bool> under_water(mesh.nodes.size(), false);
  const auto& boundaries = solver.problem().boundaries;
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    if (boundaries[b].condition == FlowCondition::head)
      for (const int n : solver.boundary_nodes(static_cast<int>(b)).node) under_water[n] = true;
  std::vector<std::optional<double>> heights;
  for (const double x : xs) {
    std::optional<double> highest;
    for (const auto& [a, b] : line) {
      if (std::min(a[0], b[0]) > x || std::max(a[0], b[0]) < x) continue;
      const double s = b[0] != a[0] ? (x - a[0]) / (b[0] - a[0]) : 1.0;
      const double y = a[1] + s * (b[1] - a[1]);
      highest = std::max(highest.value_or(y), y);
    }
    // Where water stands in the ground up to its face, or on it: the level that it has there.
    double ground = -std::numeric_limits<double>::infinity(), pressure_head = -1;
    for (const MeshEdge& side : sides)
      for (const auto& [p, q] : {std::pair{side.a, side.middle}, {side.middle, side.b}}) {
        const Point2 &a = mesh.nodes[p], &b = mesh.nodes[q];
        if (a[0] == b[0] || std::min(a[0], b[0]) > x || std::max(a[0], b[0]) < x) continue;
        const double s = (x - a[0]) / (b[0] - a[0]), y = a[1] + s * (b[1] - a[1]);
        if (y <= ground) continue;
        ground = y;
        pressure_head = state.head[p] + s * (state.head[q] - state.head[p]) - y;
        if (!under_water[p] || !under_water[q]) pressure_head = std::min(pressure_head, 0.0);
      }
    constexpr double dry = -1e-6;  // m
    if (pressure_head > dry) highest = ground + std::max(pressure_head, 0.0);
    heights.push_back(highest);
  }
  return heights;
}

std::optional<double> phreatic_height(const FlowSolver& solver, const FlowState& state, double x) {
  return phreatic_heights(solver, state, {&x, 1}).front();
}

std::vector<Point2> specific_discharge(const FlowSolver& solver, const FlowState& state) {
  const Mesh& mesh = *solver.problem().mesh;
  std::vector<Point2> sum(mesh.nodes.size(), {0, 0});
  std::vector<double> weight(mesh.nodes.size(), 0);
  for_each_piece(mesh, [&](const SubTriangle& t) {
    double twice = 0;
    const Point2 q = darcy(solver, state, t, twice);
    for (const int n : t.node) {
      weight[n] += twice;
      for (int k = 0; k < 2; ++k) sum[n][k] += twice * q[k];
    }
  });
  for (std::size_t n = 0; n < sum.size(); ++n)
    for (int k = 0; k < 2; ++k) sum[n][k] /= weight[n];
  return sum;
}

}  // namespace polder
