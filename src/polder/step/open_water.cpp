#include "polder/step/open_water.hpp"

#include <algorithm>
#include <cmath>

#include "polder/math/random.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/interior.hpp"
#include "polder/step/rain.hpp"
#include "polder/step/stepper.hpp"
#include "polder/step/wells.hpp"

namespace polder {

namespace {

constexpr double parcel = 0.125;      // × a nominal point: what dry ground gives at once
constexpr double follows_by = 0.01;   // cells that the ground may move until the body follows
constexpr int evening_passes = 20;    // of the levels of neighbouring columns
constexpr double over_ground = 0.05;  // cells: where a new point begins

/// The setup of the water alone: no soil, no wells, and rain falls through the accounts.
template <class Space>
Setup<Space> of_water(Setup<Space> setup) {
  setup.unsaturated = setup.single_point = setup.weighs_bodies = false;
  setup.materials.clear();
  setup.pores.clear();
  setup.loads.clear();
  setup.friction.clear();
  setup.wells.clear();
  setup.rains.clear();
  setup.soil_step = 1e300;
  for (PhaseBox* box : {&setup.soil_box, &setup.water_box})
    for (auto& axis : box->wall)
      for (WallKind& kind : axis)
        if (kind == WallKind::absorbing) kind = WallKind::smooth;
  return setup;
}

/// How upright the ground's outline is where it rises from one column to the next: 0, a line between their middles, up
/// to a rise of one cell; 1, a step at the face between them, from two cells on.
template <class Space>
double uprightness(const Lattice<Space>& lattice, double rise) {
  return std::clamp(std::abs(rise) / lattice.spacing[Space::up] - 1, 0.0, 1.0);
}

/// Height of the ground's outline at x, m; that of the model's base where there is no soil.
template <class Space>
double ground_at(const Lattice<Space>& lattice, const Array& ground, double x) {
  const auto& axis = lattice.axis[0];
  const int last = lattice.cells[0] - 1, own = std::clamp(static_cast<int>(axis.place(x)), 0, last);
  const int other = std::clamp(x < axis.centre(own) ? own - 1 : own + 1, 0, last);
  const double own_height = std::max(ground[own], 0.0), rise = std::max(ground[other], 0.0) - own_height;
  const double level = uprightness(lattice, rise) * 0.5;  // of the columns' widths, beside their middles
  const double way = std::abs(x - axis.centre(own)) - level * axis.width(own);
  const double all = std::abs(axis.centre(other) - axis.centre(own)) - level * (axis.width(own) + axis.width(other));
  return other == own || way <= 0 || all <= 0 ? own_height : own_height + std::min(1.0, way / all) * rise;
}

}  // namespace

template <class Space>
std::vector<Point2> ground_outline(const Setup<Space>& setup, const Array& ground) {
  const auto& lattice = setup.lattice;
  const auto& x = lattice.axis[0];
  const auto& y = lattice.axis[Space::up];
  const double far = lattice.length(0) + lattice.length(Space::up);  // so that the way out is always up
  if (std::none_of(ground.begin(), ground.end(), [](double h) { return h > 0; })) return {};
  const auto height = [&](int i) { return std::max(ground[i], 0.0); };
  std::vector<Point2> outline{{-far, -far}, {-far, height(0)}};
  for (int i = 0; i < lattice.cells[0]; ++i) {
    if (i > 0) {
      const double lower = std::min(height(i - 1), height(i));
      const int level = std::clamp(static_cast<int>(y.place(lower)), 0, lattice.cells[Space::up] - 1);
      if (setup.walls.blocked(0, lattice.index(i, level))) {
        outline.push_back({x.edge(i), height(i - 1)});
        outline.push_back({x.edge(i), height(i)});
      } else if (const double upright = uprightness(lattice, height(i) - height(i - 1)); upright > 0) {
        outline.push_back({x.centre(i - 1) + upright * 0.5 * x.width(i - 1), height(i - 1)});
        outline.push_back({x.centre(i) - upright * 0.5 * x.width(i), height(i)});
      }
    }
    outline.push_back({x.centre(i), height(i)});
  }
  const int last = lattice.cells[0] - 1;
  outline.push_back({lattice.length(0) + far, height(last)});
  outline.push_back({lattice.length(0) + far, -far});
  return outline;
}

template <class Space>
bool OpenWater<Space>::wanted(const Setup<Space>& setup, const WaterPoints<Space>& water) {
  return setup.unsaturated && Space::axes == 2 &&
         (water.size() > 0 || !setup.reservoirs.empty() || !setup.rains.empty() || !setup.open_sides.empty());
}

template <class Space>
OpenWater<Space>::OpenWater(const Setup<Space>& setup, const SoilPoints<Space>& soil, std::size_t water_points,
                            int threads)
    : inner_(std::make_unique<Stepper<Space>>(of_water(setup), SoilPoints<Space>{}, WaterPoints<Space>{}, threads)),
      ground_(ground_heights(setup, soil)) {
  inner_->next_water_id = water_points;
  account_.assign(ground_.size(), 0.0);
  wanted_by_air_ = on_ground_ = account_;
  cover = {account_, account_, account_, account_};
  surface_.assign(ground_.size(), -1);
}

template <class Space>
OpenWater<Space>::~OpenWater() = default;

template <class Space>
double OpenWater<Space>::natural_step() const {
  return inner_->natural_step();
}

template <class Space>
void OpenWater<Space>::rebuild(const Setup<Space>& setup) {
  const auto& lattice = setup.lattice;
  std::vector<BodySection> sections = setup.bodies.sections();
  if (std::vector<Point2> outline = ground_outline(setup, ground_); !outline.empty()) {
    BodySection ground;
    ground.polygon = std::move(outline);
    sections.push_back(std::move(ground));
  }
  inner_->setup.walls = setup.walls;
  inner_->setup.bodies = Bodies<Space>(lattice, std::move(sections));
  for (int i = 0; i < lattice.cells[0]; ++i) {
    int level = 0;
    while (level < lattice.cells[Space::up] && inner_->setup.bodies.covered(lattice.index(i, level))) ++level;
    surface_[i] = level < lattice.cells[Space::up] ? lattice.index(i, level) : -1;
  }
  stale_ = false;
}

/// Rain goes to the accounts; what the air wants is remembered until the ground has been asked, too.
template <class Space>
void OpenWater<Space>::let_it_rain(const Setup<Space>& setup, double time, double dt,
                                   std::vector<Exchange>& exchanged) {
  for (int i = 0; i < setup.lattice.cells[0]; ++i) {
    const double volume = rain_on(setup, time, i) * dt * setup.lattice.face_area(Space::up, setup.lattice.index(i, 0));
    wanted_by_air_[i] = std::max(-volume, 0.0);
    if (volume <= 0 || surface_[i] < 0) continue;
    account_[i] += volume;
    exchanged.push_back({surface_[i], volume});
  }
}

/// Of an account, what is paid in a step where water stands: the water has to make room.
template <class Space>
double OpenWater<Space>::share_paid(double dt) const {
  const double gravity = std::max(inner_->setup.gravity, 1e-9);
  return std::min(1.0, dt / std::sqrt(inner_->setup.lattice.smallest_spacing() / gravity));
}

/// Pays this share of accounts into and out of the points in these cells, each that of the column `aside` before its
/// own.
template <class Space>
void OpenWater<Space>::pay(const std::vector<std::ptrdiff_t>& cells, int aside, double share) {
  const auto account = [&](std::ptrdiff_t cell) -> double& {
    return account_[inner_->setup.lattice.place(cell, 0) - aside];
  };
  std::vector<WellFlow> flows;
  flows.reserve(cells.size());
  for (const std::ptrdiff_t cell : cells) flows.push_back({cell, 0, 0, -share * account(cell)});
  const std::uint64_t first_new = inner_->next_water_id;
  WaterPoints<Space>& water = inner_->water;
  bool sorted = true;
  for (const Exchange& paid :
       exchange_with_wells(inner_->setup, 1.0, flows, inner_->grid, inner_->next_water_id, water, sorted))
    account(paid.cell) -= paid.volume;
  if (sorted) return;
  for (std::size_t p = 0; p < water.size() && first_new < inner_->next_water_id; ++p) {
    if (water.id[p] < first_new) continue;
    std::array<double, 3> x = position_of(water, p);
    inner_->setup.bodies.push_out(x);
    for (int a = 0; a < Space::axes; ++a) water.position[a][p] = x[a];
  }
  inner_->points_changed();
}

/// Settles what accounts hold: little by little where water stands, else takes what there is and gives by parcels.
template <class Space>
void OpenWater<Space>::settle(double dt) {
  const auto& lattice = inner_->setup.lattice;
  const std::ptrdiff_t rise = lattice.stride[Space::up];
  std::vector<std::ptrdiff_t> standing, films;
  for (std::size_t i = 0; i < account_.size(); ++i) {
    const std::ptrdiff_t cell = surface_[i];
    if (cell < 0 || account_[i] == 0) continue;
    if (inner_->grid.wet[cell])
      standing.push_back(cell);
    else if (account_[i] < 0)
      films.push_back(cell);
    else if (account_[i] >= parcel * inner_->setup.nominal_point_volume(cell))
      emit(i);
  }
  if (!standing.empty()) pay(standing, 0, share_paid(dt));
  // also in the sliver below, on its way above, and beside, where a point is whose box reaches here
  const std::array<std::array<int, 2>, 5> ways{{{0, 0}, {0, -1}, {0, 1}, {-1, 0}, {1, 0}}};
  for (const auto& [aside, up] : ways) {
    std::vector<std::ptrdiff_t> there;
    for (const std::ptrdiff_t cell : films) {
      const int column = lattice.place(cell, 0), level = lattice.place(cell, Space::up) + up;
      if (account_[column] >= 0 || level < 0 || level >= lattice.cells[Space::up]) continue;
      if (column + aside < 0 || column + aside >= lattice.cells[0]) continue;
      if (aside != 0 && inner_->setup.walls.blocked(0, aside < 0 ? cell : cell + 1)) continue;
      there.push_back(cell + aside + up * rise);
    }
    if (!there.empty()) pay(there, aside, 1);
  }
}

/// A point on dry ground, of all that the column owes.
template <class Space>
void OpenWater<Space>::emit(std::size_t column) {
  const auto& lattice = inner_->setup.lattice;
  WaterPoints<Space>& water = inner_->water;
  const std::size_t p = append_points(water, 1);
  water.id[p] = inner_->next_water_id++;
  water.volume[p] = account_[column];
  account_[column] = 0;
  const double share = uniform(inner_->setup.numerics.seed, water.id[p], 0);
  std::array<double, 3> x{lattice.axis[0].at_place(static_cast<double>(column) + share), 0, 0};
  x[Space::up] = ground_at(lattice, ground_, x[0]) +
                 over_ground * lattice.axis[Space::up].width(lattice.place(surface_[column], Space::up));
  inner_->setup.bodies.push_out(x);
  for (int a = 0; a < Space::axes; ++a) water.position[a][p] = x[a];
  inner_->points_changed();
}

/// Depth of the free water on column i up to the first gap, m. Cells under water count as full, whatever points happen
/// to be in them: were the depth the volume over the column, what is missing in a cell would draw water out of the
/// ground there, which drives more out of the cell. `bottom` is the height of the ground in the column's lowest open
/// cell.
template <class Space>
double OpenWater<Space>::depth_over(std::size_t i, double bottom) const {
  const auto& lattice = inner_->setup.lattice;
  const GridAxis& upwards = lattice.axis[Space::up];
  const Array& volume = inner_->grid.water_volume;
  const double area = lattice.face_area(Space::up, surface_[i]);
  const auto filled = [&](std::ptrdiff_t cell, int k) {
    return volume[cell] / (area * upwards.width(k) * inner_->setup.bodies.own_share(cell));
  };
  double depth = 0;
  std::ptrdiff_t cell = surface_[i];
  for (int k = lattice.place(cell, Space::up); k < lattice.cells[Space::up] && volume[cell] > 0; ++k) {
    const std::ptrdiff_t above = cell + lattice.stride[Space::up];
    const double under_water = k + 1 < lattice.cells[Space::up] ? std::min(1.0, 2 * filled(above, k + 1)) : 0;
    const double own = filled(cell, k), height = cell == surface_[i] ? upwards.edge(k + 1) - bottom : upwards.width(k);
    depth += height * (own + under_water * (1 - own));
    cell = above;
  }
  return depth;
}

/// Evens out the levels of columns whose water is joined, m, over some three of them to either side: points leave a
/// surface rough by a fifth of a cell even where hardly anything moves, and weak soil crept under that. No depth
/// changes by more than half. `bottom`: the ground; level[i] ≤ bottom[i] where there is no water.
template <class Space>
void OpenWater<Space>::level_out(const Array& bottom, Array& level) const {
  const auto& lattice = inner_->setup.lattice;
  const Array rough = level;
  Array share(level.size() + 1, 0.0), flow = share;  // across the low side of each column, where its water is joined
  for (std::size_t i = 1; i < level.size(); ++i) {
    const double ground = std::max(bottom[i - 1], bottom[i]);
    const int at = std::clamp(static_cast<int>(lattice.axis[Space::up].place(ground)), 0, lattice.cells[Space::up] - 1);
    const bool joined = rough[i - 1] > ground && rough[i] > ground;
    if (joined && !inner_->setup.walls.blocked(0, lattice.index(static_cast<int>(i), at))) share[i] = 0.25;
  }
  for (int pass = 0; pass < evening_passes; ++pass) {
    for (std::size_t i = 1; i < level.size(); ++i) flow[i] = share[i] * (level[i - 1] - level[i]);
    for (std::size_t i = 0; i < level.size(); ++i) level[i] += flow[i] - flow[i + 1];
  }
  for (std::size_t i = 0; i < level.size(); ++i) {
    const double depth = rough[i] - bottom[i];
    if (depth > 0) level[i] = std::clamp(level[i], bottom[i] + 0.5 * depth, bottom[i] + 1.5 * depth);
  }
}

/// What the ground is to see of the water: the pressure of its depth. That in its lowest cell would answer to what
/// seeps by the inertia of all that stands above, and the two would drive each other up.
template <class Space>
void OpenWater<Space>::set_cover(double gravity) {
  const auto& lattice = inner_->setup.lattice;
  const Array& volume = inner_->grid.water_volume;
  const double weight = inner_->setup.water.density * gravity;
  const std::ptrdiff_t rise = lattice.stride[Space::up];
  const GridAxis& upwards = lattice.axis[Space::up];
  Array bottom = ground_;
  Array top(account_.size(), -1.0);
  for (std::size_t i = 0; i < account_.size(); ++i) {
    cover.pressure[i] = cover.gained[i] = cover.available[i] = cover.bare[i] = on_ground_[i] = 0;
    const std::ptrdiff_t cell = surface_[i];
    if (cell < 0) continue;
    const int level = lattice.place(cell, Space::up);
    if (level > 0) on_ground_[i] = volume[cell - rise];
    std::ptrdiff_t above = cell;
    for (int k = level; k < lattice.cells[Space::up] && volume[above] > 0; ++k, above += rise)
      on_ground_[i] += volume[above];
    // the ground does not pay what water has run away with
    cover.available[i] = std::max(0.0, on_ground_[i] + account_[i]) - wanted_by_air_[i];
    if (ground_[i] < 0)
      bottom[i] = upwards.edge(level) + (1 - inner_->setup.bodies.own_share(cell)) * upwards.width(level);
    top[i] = bottom[i] + depth_over(i, bottom[i]) + account_[i] / lattice.face_area(Space::up, cell);
  }
  level_out(bottom, top);
  for (std::size_t i = 0; i < account_.size(); ++i) {
    if (surface_[i] < 0 || top[i] <= bottom[i]) continue;
    if (ground_[i] >= 0)
      cover.pressure[i] = weight * (top[i] - bottom[i]);
    else
      cover.bare[i] = top[i];
  }
}

template <class Space>
void OpenWater<Space>::advance(const Setup<Space>& setup, const StepControl& control, double dt,
                               WaterPoints<Space>& water, std::vector<Exchange>& exchanged) {
  if (stale_) rebuild(setup);
  std::swap(water, inner_->water);
  let_it_rain(setup, control.time, dt, exchanged);
  const double share = share_paid(dt);
  inner_->sources.clear();
  for (std::size_t i = 0; i < account_.size(); ++i)
    if (surface_[i] >= 0 && account_[i] != 0) inner_->sources.push_back({surface_[i], 0, 0, -share * account_[i] / dt});
  inner_->advance(control, dt);
  exchanged.insert(exchanged.end(), inner_->exchanged.begin(), inner_->exchanged.end());
  settle(dt);
  set_cover(setup.gravity * control.gravity_factor);
  std::swap(water, inner_->water);
}

template <class Space>
void OpenWater<Space>::follow(const Setup<Space>& setup, const Array& bulk, std::vector<Exchange>& exchanged) {
  for (std::size_t i = 0; i < account_.size(); ++i) {
    account_[i] += cover.gained[i];
    const double evaporates = std::clamp(on_ground_[i] + account_[i], 0.0, wanted_by_air_[i]);
    account_[i] -= evaporates;
    if (evaporates > 0) exchanged.push_back({surface_[i], -evaporates});
  }
  Array now = ground_heights(setup, bulk);
  double way = 0;
  for (std::size_t i = 0; i < now.size(); ++i) way = std::max(way, std::abs(now[i] - ground_[i]));
  if (way <= follows_by * setup.lattice.smallest_spacing()) return;
  ground_ = std::move(now);
  stale_ = true;
}

template <class Space>
void OpenWater<Space>::show(const Setup<Space>& setup, const PoreFields<Space>& pores, GridFields<Space>& grid) const {
  const auto& lattice = setup.lattice;
  const auto& free = inner_->grid;
  const auto& bodies = inner_->setup.bodies;
  over_all_cells(lattice, [&](std::ptrdiff_t cell, const std::array<int, 3>&) {
    if (free.water_volume[cell] <= 0 || bodies.covered(cell)) return;
    const double open = bodies.own_share(cell);
    grid.fill[cell] = open < 1 ? std::min(1.0, 1 - open + open * free.fill[cell]) : free.fill[cell];
    if (!free.wet[cell]) return;
    grid.wet[cell] = 1;
    const bool own = pores.active[cell] && pores.host[cell] < 0;  // the pores' pressure there is the ground's
    if (!own) grid.pressure[cell] = free.pressure[cell];
  });
  for (int a = 0; a < Space::axes; ++a)
    for (std::size_t f = 0; f < grid.discharge[a].size(); ++f) {
      const auto face = static_cast<std::ptrdiff_t>(f);
      if (!free.reached[a][f]) continue;
      grid.discharge[a][f] +=
          bodies.open_face(a, face) * flowing_share(inner_->setup, free, a, face) * free.water_velocity[a][f];
    }
}

template <class Space>
bool OpenWater<Space>::covers(const std::array<double, 3>& x) const {
  return x[Space::up] > ground_at(inner_->setup.lattice, ground_, x[0]);
}

template <class Space>
double OpenWater<Space>::pressure_at(const std::array<double, 3>& x) const {
  const auto& lattice = inner_->setup.lattice;
  std::ptrdiff_t cell = cell_at(lattice, x);
  if (inner_->setup.bodies.covered(cell)) cell = surface_[lattice.place(cell, 0)];
  if (cell < 0 || !inner_->grid.wet[cell]) return 0;
  const double over = x[Space::up] - lattice.axis[Space::up].centre(lattice.place(cell, Space::up));
  return std::max(0.0, inner_->grid.pressure[cell] - inner_->setup.water.density * inner_->setup.gravity * over);
}

template <class Space>
double OpenWater<Space>::booked() const {
  double sum = 0;
  for (const double a : account_) sum += a;
  return sum;
}

template <class Space>
bool OpenWater<Space>::unsorted() const {
  return inner_->unsorted();
}

template <class Space>
void OpenWater<Space>::points_changed() {
  inner_->points_changed();
}

template <class Space>
void OpenWater<Space>::restored(WaterPoints<Space>& water) {
  std::swap(water, inner_->water);
  inner_->restored();
  std::swap(water, inner_->water);
  stale_ = true;
}

template <class Space>
bool OpenWater<Space>::sound() const {
  const double height = inner_->setup.lattice.length(Space::up);
  return inner_->drift_water >= 0 && inner_->motion.speed >= 0 &&
         std::all_of(account_.begin(), account_.end(), [](double a) { return std::isfinite(a); }) &&
         std::all_of(ground_.begin(), ground_.end(), [&](double y) { return y >= -1 && y <= 2 * height; });
}

template std::vector<Point2> ground_outline(const Setup<PlaneStrain>&, const Array&);
template std::vector<Point2> ground_outline(const Setup<Solid>&, const Array&);
template class OpenWater<PlaneStrain>;
template class OpenWater<Solid>;

}  // namespace polder
