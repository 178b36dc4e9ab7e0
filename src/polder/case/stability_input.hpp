#pragma once
// What the factor of safety needs beyond the model that `polder run` simulates, as plain data: strengths, water nets,
// loads, limits of the slip surfaces, where to search. The case file's [stability] section fills it.
// SI units (Pa, N/m³, m, rad); (x, height); water pressure positive in compression; cohesion and pressures positive.
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace polder::stability {

using Point = std::array<double, 2>;  ///< m; (x, height)
using Line = std::vector<Point>;      ///< m; x not decreasing where it is a level as a function of x

enum class StrengthModel { drained, undrained, shansep, table };

/// Shear strength on a plane. Drained: c' + σ'n tan φ'. The others are undrained strengths s_u.
struct Strength {
  StrengthModel model = StrengthModel::drained;
  double cohesion = 0;        ///< Pa
  double friction_angle = 0;  ///< rad
  /// rad; absent: associated. Else c and tan φ are lowered as for a shear band with that dilatancy (Davis 1968):
  /// tan φ* = sin φ cos ψ / (1 − sin φ sin ψ), c* = c cos φ cos ψ / (1 − sin φ sin ψ).
  std::optional<double> dilatancy_angle;
  double undrained_strength = 0;                    ///< Pa, at `reference_level` where that is given
  double strength_gradient = 0;                     ///< Pa/m, increase with depth below `reference_level`
  std::optional<double> reference_level;            ///< m; absent: the ground above the point
  double ratio = 0;                                 ///< SHANSEP S in s_u = S σ'v OCR^m
  double exponent = 0.9;                            ///< SHANSEP m
  std::vector<std::array<double, 2>> stress_table;  ///< (σ'v, s_u) Pa, for StrengthModel::table
};

struct Soil {
  std::string name;
  double unit_weight = 18e3;            ///< N/m³ above the phreatic line
  double saturated_unit_weight = 18e3;  ///< N/m³ below it
  Strength above, below;                ///< above and below the phreatic line
};

/// How heavily a soil was loaded before: overburden POP = σ'y − σ'v, or OCR = σ'y/σ'v, in the reference state.
enum class PreconsolidationKind { pop, ocr, yield_stress };
struct Preconsolidation {
  PreconsolidationKind kind = PreconsolidationKind::pop;
  double value = 0;  ///< Pa, or dimensionless for `ocr`
};

struct Layer {
  std::string name;
  std::vector<Point> polygon;
  int soil = 0;                       ///< index into the section's soils
  Preconsolidation preconsolidation;  ///< where no state point or line says otherwise
};

/// Preconsolidation known at a point of a layer; several in one layer are interpolated along x.
struct StatePoint {
  Point at{0, 0};
  int layer = 0;
  Preconsolidation value;
};

/// Preconsolidation known along a line, just above and just below it, at abscissae between which it is interpolated.
struct StateLine {
  struct Value {
    double x = 0;
    Preconsolidation above, below;
  };
  Line line;
  std::vector<Value> values;
};

/// A line on which heads are prescribed: `head_above` holds for the soil just above it, `head_below` just below.
struct ReferenceLine {
  Line line;
  Line head_above, head_below;  ///< m, head as a function of x; empty: the phreatic line
};

/// The water net: pressure is linear in height between the phreatic line (or the ground under free water), where it is
/// zero (or the free water's), and the first reference line, between reference lines, and hydrostatic with the last
/// `head_below` under the last; without reference lines it is hydrostatic. Heads keep their end values beyond their
/// ends; a reference line acts only where it is drawn.
struct WaterNet {
  double unit_weight = 9810;  ///< N/m³
  Line phreatic;              ///< empty: no water
  std::vector<ReferenceLine> references;
  double max_suction = 0;  ///< Pa; hydrostatic suction above the phreatic line counts up to this value
};

/// A strip load on the ground; at depth d it acts over a width larger by 2 d tan(spread).
struct StripLoad {
  std::string name;
  double from = 0, to = 0;  ///< m
  double pressure = 0;      ///< Pa
  double spread = 0;        ///< rad from the vertical
  /// Degree of consolidation (0 to 1) per layer under this load; empty: fully consolidated everywhere. The share that
  /// is not yet consolidated is carried by the pore water of that layer.
  std::vector<double> consolidation;
};

struct LineLoad {
  std::string name;
  Point at{0, 0};
  double force = 0;   ///< N/m
  double angle = 0;   ///< rad from the vertical, positive towards +x
  double spread = 0;  ///< rad
  std::vector<double> consolidation;
};

struct Earthquake {
  double horizontal = 0;  ///< k_h, share of the weight, acting in the direction of sliding
  double vertical = 0;    ///< k_v, positive upwards
};

struct TensionCrack {
  double depth = 0;  ///< m below the ground where the surface enters
  double water = 0;  ///< share of the crack's depth filled with water
};

using Range = std::array<double, 2>;

struct SlipLimits {
  std::optional<Range> entry;                       ///< m, x where the surface may begin (the high end)
  std::optional<Range> exit;                        ///< m, x where it may end (the low end)
  double minimum_depth = 0;                         ///< m, greatest depth below the ground must exceed this
  double minimum_length = 0;                        ///< m, horizontal distance between the ends
  std::vector<Line> forbidden_lines;                ///< segments that the surface may not cross
  std::vector<std::vector<Point>> forbidden_zones;  ///< polygons that it may not enter
};

/// Where pore pressures come from: the lines of the case, or a seepage computation.
enum class PressureSource { water_net, seepage, both };

enum class Movement { automatic, left, right };

struct CircleGrid {
  Point corner{0, 0};                   ///< m, lower left centre
  double spacing_x = 1, spacing_z = 1;  ///< m
  int count_x = 0, count_z = 0;
  double tangent = 0, tangent_spacing = 1;  ///< m, lowest tangent line
  int tangents = 0;
};

struct Box {
  Point low{0, 0}, high{0, 0};
};

/// Two boxes of centres and a range of levels of the horizontal plane.
struct UpliftVanArea {
  Box active, passive;
  Range tangent{0, 0};
};

/// Two slip surfaces between which the vertices of a free surface are sought.
struct FreeSurfaceBand {
  Line upper, lower;
};

struct Circle {
  Point centre{0, 0};
  double radius = 0;
};

struct UpliftVanPlane {
  Point active, passive;  ///< centres
  double tangent = 0;     ///< m, level of the horizontal plane
};

/// Partial factors by which strengths are divided and loads multiplied for design values.
struct PartialFactors {
  double cohesion = 1, tan_friction = 1, undrained = 1, load = 1, model = 1;
};

/// What a case says about the strength of one of its materials beyond its law. NaN: not said.
struct MaterialStrength {
  std::string material;
  bool above = true, below = true;  ///< the phreatic line
  Strength strength;
  double unit_weight = std::numeric_limits<double>::quiet_NaN();            ///< N/m³
  double saturated_unit_weight = std::numeric_limits<double>::quiet_NaN();  ///< N/m³
  std::optional<Preconsolidation> preconsolidation;
  double variation = 0;  ///< coefficient of variation of c', tan φ' or s_u, for the probabilistic run
};

/// Where water would break out of the ground behind a dike: uplift, heave and piping are checked there.
struct DikeCheckInput {
  std::string name;
  double at = 0;                 ///< m, x of the exit
  std::string aquifer;           ///< material of the sand under the blanket
  double critical_gradient = 0;  ///< of heave
  double d70 = 0;                ///< m; 0: piping is not checked
  double seepage_length = 0;     ///< m, entry to exit
  double outside_head = 0;       ///< m, of the water that drives the pipe
  double thickness = 0;          ///< m, of the aquifer; 0: that of the section at the exit
};

struct Input {
  std::vector<MaterialStrength> strengths;
  Line phreatic;  ///< empty: the model's water table
  std::vector<ReferenceLine> heads;
  PressureSource pressures = PressureSource::water_net;
  double max_suction = 0;     ///< Pa
  Line daily_phreatic;        ///< of the state to which preconsolidation refers; empty: the same water
  double head_deviation = 0;  ///< m, standard deviation of all heads, for the probabilistic run
  std::vector<StripLoad> loads;
  std::vector<LineLoad> line_loads;
  Earthquake earthquake;
  TensionCrack crack;
  SlipLimits limits;                    ///< its minimum depth only where `minimum_depth` says so
  std::optional<double> minimum_depth;  ///< m; absent: a tenth of the relief of the ground
  Movement movement = Movement::automatic;
  std::optional<Circle> circle;         ///< one circle to compute instead of a search
  std::optional<UpliftVanPlane> plane;  ///< one Uplift-Van surface to compute
  Line surface;                         ///< one free surface to compute; empty: search
  PartialFactors partial_factors;
  Line fixed_line;           ///< strength reduction holds the outline along it
  std::string mesh_file;     ///< of Gmsh, for strength reduction; empty: our own mesh
  double fem_triangles = 0;  ///< of strength reduction; 0: its own number
  std::vector<DikeCheckInput> dike_checks;
};

}  // namespace polder::stability
