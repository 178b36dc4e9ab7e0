#include "polder/stage/initial.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "polder/case/geometry.hpp"
#include "polder/case/grid_sites.hpp"
#include "polder/math/units.hpp"

namespace polder {

namespace {

constexpr double no_water = -1e6;  // m, a head below everything

struct SideOf {
  int axis, end;  // end 0: low, 1: high
};

template <class Space>
SideOf side_of(Side side) {
  switch (side) {
    case Side::left:
      return {0, 0};
    case Side::right:
      return {0, 1};
    case Side::front:
      return {1, 0};
    case Side::back:
      return {1, 1};
    case Side::base:
      return {Space::up, 0};
    case Side::top:
      break;
  }
  return {Space::up, 1};
}

/// A line inside the model keeps the soil on the side where there is more of it.
template <class Space>
void place_soil_wall(const Model& model, const Boundary& boundary, Setup<Space>& setup) {
  const auto& lattice = setup.lattice;
  const bool upright = std::abs(boundary.line[0][0] - boundary.line[1][0]) < 1e-9 * lattice.length(0);
  const int axis = upright ? 0 : Space::up;
  const double at = boundary.line[0][upright ? 0 : 1];
  const int face = lattice.axis[axis].nearest_edge(at);
  double below = 0, above = 0;
  for (const auto& body : model.soils) {
    const Bounds extent = bounds(body.region.polygon);
    const int part = upright ? 0 : 1;
    below += std::max(0.0, at - extent.low[part]);
    above += std::max(0.0, extent.high[part] - at);
  }
  const int end = above >= below ? 0 : 1;
  (end == 0 ? setup.soil_box.low : setup.soil_box.high)[axis] = face;
  setup.soil_box.wall[axis][end] = boundary.soil == SoilCondition::rough ? WallKind::rough : WallKind::smooth;
}

/// Pressure (Pa) that the deepest soil of the model may carry: for laws whose stiffness grows with it.
double deepest_pressure(const Model& model) {
  const double height = model.size[model.space == SpaceKind::solid ? 2 : 1];
  double density = 0;
  for (const auto& m : model.materials) density = std::max(density, (1 - m.porosity) * m.grain_density);
  return density * model.gravity * height;
}

}  // namespace

namespace {

/// The law's parameter of this name, or `otherwise` where the law has none.
double parameter(const MaterialInput& material, std::string_view key, double otherwise) {
  const LawDescription* law = find_soil_law(material.law);
  for (std::size_t k = 0; k < law->parameters.size(); ++k)
    if (law->parameters[k].key == key) return material.law_parameters[k];
  return otherwise;
}

double poisson_ratio(const MaterialInput& material) { return parameter(material, "poisson_ratio", 0.3); }

}  // namespace

double earth_pressure_at_rest(const MaterialInput& material) {
  const double nu = poisson_ratio(material), phi = parameter(material, "friction_angle", 0);
  return phi > 0 ? 1 - std::sin(phi) : nu / (1 - nu);
}

namespace {

PoreSpace pore_space(const Model& model, const MaterialInput& material, const SoilLaw& law, double deepest) {
  PoreSpace pores;
  pores.modulus = law.constrained_modulus(deepest);
  for (const MaterialRetention& given : model.retentions)
    if (given.material == material.name) pores.retention = given.retention, pores.curve = given.curve;
  return pores;
}

}  // namespace

template <class Space>
Setup<Space> make_setup(const Model& model) {
  Setup<Space> setup;
  std::array<GridAxis, 3> axes;
  for (int a = 0; a < Space::axes; ++a) axes[a] = grid_axis(model, a);
  setup.lattice = Lattice<Space>(axes);
  setup.water = model.water;
  setup.numerics = model.numerics;
  setup.gravity = model.gravity;
  setup.tilt = model.tilt;
  setup.periodic = model.periodic;
  setup.points_per_axis = model.points_per_axis;
  setup.single_point = model.single_point;
  setup.unsaturated = model.unsaturated;
  setup.pore_water = model.pore_water;
  setup.water_table = model.water_table;
  setup.start_pressure = model.start_pressure;
  setup.suction_limit = model.suction_limit;
  setup.reservoirs = make_reservoirs(model, setup.lattice);

  for (PhaseBox* box : {&setup.soil_box, &setup.water_box})
    for (int a = 0; a < Space::axes; ++a) box->high[a] = setup.lattice.cells[a];
  if (model.periodic)
    for (PhaseBox* box : {&setup.soil_box, &setup.water_box}) box->wall[0] = {WallKind::periodic, WallKind::periodic};
  setup.loads = model.loads;
  setup.rains = model.rains;
  for (const Boundary& boundary : model.boundaries) {
    const bool falls =
        boundary.water == WaterCondition::open;  // out at no pressure: under a head that no water reaches
    if (boundary.side &&
        (falls || boundary.water == WaterCondition::head || boundary.water == WaterCondition::inflow)) {
      const auto [axis, end] = side_of<Space>(*boundary.side);
      const bool head = falls || boundary.water == WaterCondition::head;
      const int along = along_side<Space>(axis);
      PhaseBox::Opening part;
      if (boundary.span)
        part = {setup.lattice.axis[along].nearest_edge((*boundary.span)[0]),
                setup.lattice.axis[along].nearest_edge((*boundary.span)[1])};
      setup.open_sides.push_back({axis, end, head,
                                  falls  ? Table::constant(no_water)
                                  : head ? boundary.head
                                         : boundary.inflow,
                                  part, falls});
      setup.water_box.opening[axis][end] = part;
      setup.water_box.wall[axis][end] = WallKind::open;
    }
    if (boundary.side && (!boundary.slide.y.empty() || !boundary.push.y.empty())) {
      const auto [axis, end] = side_of<Space>(*boundary.side);
      setup.moving_sides.push_back({axis, end, boundary.slide, boundary.push});
    }
    if (boundary.side && boundary.water == WaterCondition::no_slip) {
      const auto [axis, end] = side_of<Space>(*boundary.side);
      if (model.water.viscous)
        setup.water_box.wall[axis][end] = WallKind::rough;
      else
        setup.sticky_sides.push_back({static_cast<int>(axis), static_cast<int>(end)});
    }
    if (boundary.soil == SoilCondition::none) continue;
    if (boundary.side) {
      const auto [axis, end] = side_of<Space>(*boundary.side);
      if (boundary.soil == SoilCondition::rough) setup.soil_box.wall[axis][end] = WallKind::rough;
      if (boundary.soil == SoilCondition::absorbing)
        setup.soil_box.wall[axis][end] = setup.water_box.wall[axis][end] = WallKind::absorbing;
    } else {
      place_soil_wall(model, boundary, setup);
    }
  }

  const double h = setup.lattice.smallest_spacing(), pressure = deepest_pressure(model);
  for (const MaterialInput& input : model.materials) {
    const LawDescription* law = find_soil_law(input.law);
    if (law == nullptr) throw std::invalid_argument("no soil law is called '" + input.law + "'");
    SoilMaterial material;
    material.law = law->make(input.law_parameters, {h, input.porosity, input.max_porosity});
    material.grain_density = input.grain_density;
    material.initial_porosity = input.porosity;
    material.max_porosity = input.max_porosity;
    material.fixed = input.fixed;
    const double nu = poisson_ratio(input);
    material.shear_share = (1 - 2 * nu) / (2 * (1 - nu));
    for (int d = 0; d < 2; ++d) {
      DragInput drag{input.drag,
                     input.ergun_a,
                     input.ergun_b,
                     input.grain_diameter,
                     std::nullopt,
                     input.porosity,
                     model.water.density,
                     model.water.viscosity,
                     model.gravity > 0 ? model.gravity : standard_gravity,
                     input.permeability_exponent,
                     input.permeability_change};
      if (input.permeability) drag.conductivity = (*input.permeability)[d];
      material.drag[d] = make_drag(drag);
    }
    if (input.permeability && (*input.permeability)[0] != (*input.permeability)[1]) setup.anisotropic = true;
    const std::string& sets_step = model.numerics.step_material;
    if (!input.fixed && (sets_step.empty() || sets_step == input.name)) {
      const double speed =
          std::sqrt(material.law->constrained_modulus(pressure) / ((1 - input.porosity) * input.grain_density));
      setup.soil_step = std::min(setup.soil_step, model.numerics.cfl * h / speed);
    }
    if (model.unsaturated) setup.pores.push_back(pore_space(model, input, *material.law, pressure));
    setup.materials.push_back(std::move(material));
  }
  return setup;
}

template <class Space>
void set_k0_stress(const Model& model, const Setup<Space>& setup, SoilPoints<Space>& soil) {
  constexpr int up = Space::up;
  const auto sites = [&](int a) { return SiteAxis(setup.lattice.axis[a], model.points_per_axis); };
  const SiteAxis along = sites(0), across = sites(1), upwards = sites(up);
  std::vector<double> k0_of;
  for (const auto& material : model.materials) k0_of.push_back(earth_pressure_at_rest(material));
  std::map<std::pair<long, long>, std::vector<std::size_t>> columns;
  for (std::size_t p = 0; p < soil.size(); ++p)
    columns[{along.site_at(soil.position[0][p]), Space::axes == 3 ? across.site_at(soil.position[1][p]) : 0}].push_back(
        p);
  for (auto& [place, points] : columns) {
    std::sort(points.begin(), points.end(),
              [&](std::size_t a, std::size_t b) { return soil.position[up][a] > soil.position[up][b]; });
    double weight = 0;  // of whole layers above, Pa
    for (const std::size_t p : points) {
      const MaterialInput& material = model.materials[soil.material[p]];
      const bool submerged =
          !model.water_table.empty() && soil.position[up][p] < height_at(model.water_table, soil.position[0][p]);
      const double density = (1 - material.porosity) * (material.grain_density - (submerged ? model.water.density : 0));
      const long level = upwards.site_at(soil.position[up][p]);
      const double layer = density * model.gravity * upwards.width(level);
      const double vertical = -(weight + density * model.gravity * (upwards.low(level + 1) - soil.position[up][p]));
      weight += layer;
      const double k0 = model.k0.value_or(k0_of[soil.material[p]]);
      for (int a = 0; a < 3; ++a) soil.stress[a][p] = a == up ? vertical : k0 * vertical;
    }
  }
}

template Setup<PlaneStrain> make_setup(const Model&);
template Setup<Solid> make_setup(const Model&);
template void set_k0_stress(const Model&, const Setup<PlaneStrain>&, SoilPoints<PlaneStrain>&);
template void set_k0_stress(const Model&, const Setup<Solid>&, SoilPoints<Solid>&);

}  // namespace polder
