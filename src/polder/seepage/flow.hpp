#pragma once
// Saturated–unsaturated seepage in a section: Richards' equation
//     ∂(n S)/∂t + S S_s ∂ψ/∂t = ∇·(k k_r ∇h),   h = ψ + y,   p = γw ψ
// on linear triangles (four inside each 6-node triangle) with the storage lumped at the nodes, which keeps fronts free
// of overshoots; time by backward Euler in the mass-conserving form (Celia et al. 1990), each step by Newton.
// Seepage faces and rain are complementarity conditions, p ≤ 0, outflow + rain ≥ 0, one of them zero, solved in the
// same Newton iteration as an active set.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "polder/material/retention.hpp"
#include "polder/math/table.hpp"
#include "polder/seepage/mesh.hpp"

namespace polder {

struct FlowMaterial {
  std::array<double, 2> conductivity{1e-5, 1e-5};  ///< m/s, horizontal and vertical, saturated
  double porosity = 0.4;
  double specific_storage = 0;  ///< S_s, 1/m: γw (1/M + n/K_w)
  Retention retention = VanGenuchtenRetention{};
  ConductivityCurve curve = MualemConductivity{};
  double least_relative = 1e-8;  ///< k_r never falls below this
};

enum class FlowCondition {
  head,     ///< total head given where the line is under it; a potential seepage face above
  seepage,  ///< water may leave at p = 0, none enters
  rain,     ///< water enters at `rate` until it ponds (p = 0)
};

/// Along the sides of the outline that lie on `line`. Sides without a condition are closed.
struct FlowBoundary {
  std::string name;
  FlowCondition condition = FlowCondition::seepage;
  std::vector<Point2> line;
  Table head = Table::constant(0);  ///< m above y = 0, by time (s)
  /// Head at the line's last point where it is not the same along the line (then linear in between).
  std::optional<Table> head_at_end;
  Table rate = Table::constant(0);  ///< m/s normal to the side, by time (s); negative: evaporation
  /// Sides above the water are a potential seepage face (true) or closed (false).
  bool seepage_above = true;
};

struct FlowProblem {
  const Mesh* mesh = nullptr;
  std::vector<FlowMaterial> materials;  ///< one per region of the mesh
  std::vector<FlowBoundary> boundaries;
  double unit_weight = 9810;  ///< of water, N/m³
};

struct FlowState {
  double time = 0;           ///< s
  std::vector<double> head;  ///< m, per node
  std::vector<bool> exit;    ///< per node: held at p = 0 (an active seepage face or pond)
  /// Water leaving the section at each node, m²/s (m³/s per metre); negative where it enters.
  std::vector<double> outflow;
};

struct FlowOptions {
  double tolerance = 1e-9;  ///< m, change of head in the last Newton iteration
  int iterations = 40;      ///< per step
  double first_step = 0;    ///< s; 0: a thousandth of the span
  double longest_step = 0;  ///< s; 0: a hundredth of the span
};

struct FlowTally {
  int steps = 0, iterations = 0, rejected = 0;
  double inflow = 0;   ///< m², water that entered through the outline, net
  double storage = 0;  ///< m², change of the water held
};

class FlowSolver {
 public:
  /// Throws std::invalid_argument where a boundary's line lies on no side of the mesh or a material is missing.
  explicit FlowSolver(FlowProblem problem);

  /// The state that lasts under the conditions at `time`. Throws std::runtime_error where none is found.
  FlowState steady(double time, const FlowOptions& options = {}) const;
  /// Hydrostatic under the given head.
  FlowState hydrostatic(double head) const;
  /// Moves `state` to time `until`.
  FlowTally advance(FlowState& state, double until, const FlowOptions& options = {}) const;

  /// Conductivity of every triangle of the mesh over that of its material, from now on (soil whose pores have changed).
  void scale_conductivity(std::vector<double> factor);
  /// That of triangle `e`.
  double conductivity_scale(std::size_t e) const { return scale_.empty() ? 1.0 : scale_[e]; }
  /// Water held by the pores, m².
  double stored(const FlowState& state) const;
  const FlowProblem& problem() const { return problem_; }
  /// Nodes of boundary `b`, and for each the length of side that it stands for (m).
  struct BoundaryNodes {
    std::vector<int> node;
    std::vector<double> length;
    std::vector<double> along;             ///< 0 at the line's start, 1 at its end
    std::vector<std::array<int, 2>> side;  ///< pieces of side, positions in `node`
  };
  const BoundaryNodes& boundary_nodes(int b) const { return boundaries_[b]; }

 private:
  struct Piece {  ///< a linear triangle
    std::array<int, 3> node;
    int material;
    std::size_t triangle;
    double area;
    std::array<std::array<double, 3>, 3> conductance;  ///< ∫∇N·k∇N, saturated
  };
  struct NodeCondition;
  std::vector<NodeCondition> conditions(double time) const;
  bool step(FlowState& state, double dt, const FlowOptions& options, int& iterations) const;

  FlowProblem problem_;
  std::vector<Piece> pieces_;
  std::vector<BoundaryNodes> boundaries_;
  std::vector<double> scale_;        ///< per triangle; empty: 1
  std::vector<double> conductance_;  ///< per node, m/s: outflow per metre of its head, saturated
};

}  // namespace polder
