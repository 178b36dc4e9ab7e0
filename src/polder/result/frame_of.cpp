#include "polder/result/frame_of.hpp"

#include <cmath>

#include "polder/boundary/standing_walls.hpp"
#include "polder/result/ground_stress.hpp"
#include "polder/result/measures.hpp"
#include "polder/result/state_hash.hpp"

namespace polder {

namespace {

/// Arrays of several components, side by side per point.
template <std::size_t N>
std::vector<double> interleaved(const std::array<Array, N>& arrays, std::size_t count) {
  std::vector<double> values(count * N);
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t c = 0; c < N; ++c) values[p * N + c] = arrays[c][p];
  return values;
}

std::vector<double> plain(const Array& a) { return {a.begin(), a.end()}; }

template <class Space, class Points>
void place(const Simulation<Space>& run, const Points& points, PointSet& set, std::vector<double>& pressure) {
  set.id.assign(points.id.begin(), points.id.end());
  set.position.resize(points.size());
  pressure.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    set.position[p] = position_of(points, p);
    pressure[p] = run.pressure_at(set.position[p]);
  }
}

/// Top of the wet cells, column by column, broken where a column is dry.
std::vector<Line2> surface_lines(const Simulation<PlaneStrain>& run) {
  const auto& lattice = run.state().setup.lattice;
  const auto& grid = run.state().grid;
  std::vector<Line2> lines;
  bool open = false;
  for (int i = 0; i < lattice.cells[0]; ++i) {
    int j = lattice.cells[1] - 1;
    while (j >= 0 && !grid.wet[lattice.index(i, j)]) --j;
    if (j < 0) {
      open = false;
      continue;
    }
    if (!open) lines.emplace_back();
    open = true;
    const std::ptrdiff_t cell = lattice.index(i, j);
    const double fill = std::min(1.0, grid.fill[cell]) + std::min(0.5, grid.fill[cell + lattice.stride[1]]);
    lines.back().push_back({lattice.axis[0].centre(i), lattice.axis[1].at_place(j + std::min(1.5, fill))});
  }
  return lines;
}

}  // namespace

template <class Space>
Frame frame_of(const Simulation<Space>& run) {
  const auto& state = run.state();
  const auto& soil = state.soil;
  Frame frame;
  frame.time = run.time();
  frame.step = state.step;
  frame.dimension = Space::axes;
  frame.size = run.model().size;
  frame.grid = state.setup.lattice.axis;
  frame.title = run.model().title;
  for (const auto& body : run.model().soils) {
    Line2 outline = body.region.polygon;
    if (!outline.empty()) outline.push_back(outline.front());
    frame.outlines.push_back(std::move(outline));
  }
  const auto stands = standing(run.model(), run.stage_number(), run.time());
  for (std::size_t w = 0; w < stands.size(); ++w)
    if (stands[w] && !run.model().walls[w].polygon.empty()) {
      Line2 outline = outline_at(run.model().walls[w], run.time());
      outline.push_back(outline.front());
      frame.walls.push_back(std::move(outline));
    } else if (stands[w])
      frame.walls.push_back(stepped_wall(run.model().walls[w].line, run.model()).corners);
  if constexpr (Space::axes == 2) frame.water_lines = surface_lines(run);

  std::vector<double> pressure;
  const std::size_t n = soil.size();
  place(run, soil, frame.soil, pressure);
  frame.soil.volume.resize(n);
  const bool has_rest = !run.model().water_table.empty();  // what pressures are in excess of
  const bool holds_air = state.setup.single_point || state.setup.unsaturated;
  std::vector<double> displacement(n * Space::axes), material(n), fluid(n), excess(has_rest ? n : 0),
      saturated(holds_air ? n : 0);
  for (std::size_t p = 0; p < n; ++p) {
    frame.soil.volume[p] =
        soil.mass[p] / state.setup.materials[soil.material[p]].grain_density / (1 - soil.porosity[p]);
    for (int a = 0; a < Space::axes; ++a)
      displacement[p * Space::axes + a] = soil.position[a][p] - soil.reference[a][p];
    material[p] = soil.material[p];
    fluid[p] = soil.fluid[p];
    if (has_rest) excess[p] = excess_pressure(run, frame.soil.position[p]);
    if (holds_air) saturated[p] = point_saturation(run, p);
  }
  if (n > 0) {
    auto& fields = frame.soil.fields;
    fields.push_back(make_field("porosity", plain(soil.porosity)));
    fields.push_back(make_field("pore_pressure", std::move(pressure)));
    if (has_rest) fields.push_back(make_field("excess_pressure", std::move(excess)));
    if (holds_air) fields.push_back(make_field("saturation", std::move(saturated)));
    fields.push_back(make_field("deviatoric_strain", plain(soil.deviatoric_strain)));
    fields.push_back(make_field("displacement", std::move(displacement), Space::axes));
    fields.push_back(make_field("velocity", interleaved(soil.velocity, n), Space::axes));
    fields.push_back(make_field("effective_stress", interleaved(soil.stress, n), Space::stress));
    fields.push_back(make_field("plastic_strain", plain(soil.state[0])));
    fields.push_back(make_field("liquefied", std::move(fluid)));
    fields.push_back(make_field("material", std::move(material)));
  }
  const auto& water = state.water;
  place(run, water, frame.water, pressure);
  frame.water.volume = plain(water.volume);
  if (water.size() > 0) {
    frame.water.fields.push_back(make_field("pressure", std::move(pressure)));
    frame.water.fields.push_back(make_field("velocity", interleaved(water.velocity, water.size()), Space::axes));
  }
  return frame;
}

template <class Space>
std::uint64_t hash_of(const Simulation<Space>& run) {
  const auto& soil = run.state().soil;
  const auto& water = run.state().water;
  std::vector<HashedArray> of_soil, of_water;
  const auto add = [](auto& list, auto& arrays) {
    for (const auto& a : arrays) list.push_back({{a.data(), a.size()}, 1});
  };
  add(of_soil, soil.position);
  add(of_soil, soil.velocity);
  add(of_soil, soil.affine);
  add(of_soil, soil.stress);
  add(of_soil, soil.state);
  for (const Array* a : {&soil.mass, &soil.porosity, &soil.deviatoric_strain})
    of_soil.push_back({{a->data(), a->size()}, 1});
  add(of_water, water.position);
  add(of_water, water.velocity);
  add(of_water, water.affine);
  of_water.push_back({{water.volume.data(), water.size()}, 1});
  const std::uint64_t first = state_hash({soil.id.data(), soil.size()}, of_soil);
  return state_hash({water.id.data(), water.size()}, of_water, first);
}

template Frame frame_of(const Simulation<PlaneStrain>&);
template Frame frame_of(const Simulation<Solid>&);
template std::uint64_t hash_of(const Simulation<PlaneStrain>&);
template std::uint64_t hash_of(const Simulation<Solid>&);

}  // namespace polder
