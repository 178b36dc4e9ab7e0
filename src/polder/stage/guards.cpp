#include "polder/stage/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/stage/sound.hpp"
#include "polder/step/far_field.hpp"
#include "polder/step/loads.hpp"
#include "polder/step/soil_volume.hpp"

namespace polder {

namespace {

constexpr std::uint64_t between_sums = 16;  // steps from one look at what takes sums over all points to the next

/// Kinetic and potential energy of both phases, J.
template <class Space>
double mechanical_energy(const Stepper<Space>& state) {
  const double g = state.setup.gravity, rho = state.setup.water.density;
  double energy = 0;
  const auto& soil = state.soil;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    double mass = soil.mass[p];
    if (state.setup.single_point) mass += rho * soil.water[p];
    energy += mass * (0.5 * speed_squared(soil, p) + g * soil.position[Space::up][p]);
  }
  const auto& water = state.water;
  for (std::size_t p = 0; p < water.size(); ++p)
    energy += rho * water.volume[p] * (0.5 * speed_squared(water, p) + g * water.position[Space::up][p]);
  return energy;
}

/// What the stress may give back, J: Σ V σ:σ/(2M), M the constrained modulus, which no mode of elastic soil undercuts
/// by more than a factor of 3.
template <class Space>
double strain_energy(const Stepper<Space>& state) {
  const auto& soil = state.soil;
  double energy = 0;
  for (std::size_t p = 0; p < soil.size(); ++p) {
    const SoilMaterial& material = state.setup.materials[soil.material[p]];
    if (material.fixed) continue;
    const double mean = -(soil.stress[0][p] + soil.stress[1][p] + soil.stress[2][p]) / 3;
    double square = 0;
    for (std::size_t s = 0; s < soil.stress.size(); ++s) square += (s < 3 ? 1 : 2) * std::pow(soil.stress[s][p], 2);
    const double modulus = material.law->constrained_modulus(std::max(mean, 0.0));
    if (modulus > 0) energy += 3 * bulk_volume(state.setup, state.soil, p) * square / (2 * modulus);
  }
  return energy;
}

template <class Space>
std::string place_of_fastest(const Stepper<Space>& state) {
  double most = -1;
  std::string place = "there are no points";
  const auto look = [&](const auto& points, const char* phase) {
    for (std::size_t p = 0; p < points.size(); ++p)
      if (speed_squared(points, p) > most) {
        most = speed_squared(points, p);
        place = fmt::format("the fastest is {} point {} near ({:.4g}, {:.4g}) with {:.3g} m/s", phase, points.id[p],
                            points.position[0][p], points.position[Space::up][p], std::sqrt(most));
      }
  };
  look(state.soil, "soil");
  look(state.water, "water");
  return place;
}

void note(Warning& warning, double value, double bound, double time, double x, double height) {
  if (!(value > bound)) return;
  if (warning.worst == 0) warning.first_time = time, warning.x = x, warning.height = height;
  warning.worst = std::max(warning.worst, value);
}

}  // namespace

template <class Space>
void Guards<Space>::begin_event(const Stepper<Space>& state) {
  energy_at_start_ = mechanical_energy(state);
  strain_energy_ = strain_energy(state);
  work_ = 0;
}

template <class Space>
void Guards<Space>::before_step(const Stepper<Space>& state, double time) const {
  const std::string escaped = escaped_point(state);
  if (!escaped.empty()) throw RunFailure(fmt::format("{}; t = {:.6g} s (step {})", escaped, time, state.step));
}

template <class Space>
void Guards<Space>::take(const Stepper<Space>& state, const Audit<Space>& audit, const StepReport& report,
                         const std::string& unsound, double time, bool event) {
  if (!unsound.empty()) throw RunFailure(fmt::format("{}; t = {:.6g} s (step {})", unsound, time, state.step));
  check_solve(state, report, time);
  if (event) add_work(state, time, report.dt);
  note_limits(state, audit, time);
  if (state.step % between_sums != 0) return;
  check_balances(state, audit, time);
  if (event) check_energy(state, time);
}

template <class Space>
void Guards<Space>::check_solve(const Stepper<Space>& state, const StepReport& report, double time) const {
  if (report.pressure.converged && std::isfinite(report.pressure.residual)) return;
  const auto& lattice = state.setup.lattice;
  const auto& p = state.grid.pressure;
  std::size_t at = 0;  // the first pressure that is not finite, else the largest
  for (std::size_t cell = 0; cell < p.size() && std::isfinite(p[at]); ++cell)
    if (!(std::abs(p[cell]) <= std::abs(p[at]))) at = cell;
  const auto cell = static_cast<std::ptrdiff_t>(at);
  throw RunFailure(fmt::format(
      "the pressure solve did not converge at t = {:.6g} s (step {}): residual {:.2e} after {} iterations, {} {:.3g} "
      "Pa in the cell at ({:.4g}, {:.4g}); {}",
      time, state.step, report.pressure.residual, report.pressure.iterations,
      std::isfinite(p[at]) ? "largest pressure" : "pressure", p[at], lattice.axis[0].centre(lattice.place(cell, 0)),
      lattice.axis[Space::up].centre(lattice.place(cell, Space::up)), place_of_fastest(state)));
}

template <class Space>
void Guards<Space>::check_balances(const Stepper<Space>& state, const Audit<Space>& audit, double time) const {
  const auto fail = [&](const char* what, double error, double bound) {
    throw RunFailure(fmt::format("{} is off by {:.2e} at t = {:.6g} s (step {}), more than {:.0e}; {}", what, error,
                                 time, state.step, bound, place_of_fastest(state)));
  };
  const double water = audit.water_balance_error(state), solid = audit.solid_mass_error(state);
  if (!(water <= GuardLimits::water_balance)) fail("the balance of the water", water, GuardLimits::water_balance);
  if (!(solid <= GuardLimits::solid_mass)) fail("the mass of the grains", solid, GuardLimits::solid_mass);
}

/// An upper bound: water that enters brings its height, pressure and speed, water that leaves takes nothing away.
template <class Space>
void Guards<Space>::add_work(const Stepper<Space>& state, double time, double dt) {
  constexpr int up = Space::up;
  const auto& lattice = state.setup.lattice;
  const double g = state.setup.gravity, rho = state.setup.water.density;
  for (const Exchange& exchange : state.exchanged) {
    if (exchange.volume <= 0) continue;
    double square = 0;
    for (int a = 0; a < Space::axes; ++a) {
      const Array& v = state.grid.water_velocity[a];
      square += std::max(std::pow(v[exchange.cell], 2), std::pow(v[exchange.cell + lattice.stride[a]], 2));
    }
    const double height = lattice.axis[up].edge(lattice.place(exchange.cell, up) + 1);
    work_ += exchange.volume * (rho * (g * height + 0.5 * square) + std::max(0.0, state.grid.pressure[exchange.cell]));
  }
  if (state.setup.any_absorbs()) work_ += far_work(state.setup, state.grid, dt);
  if (state.setup.loads.empty()) return;
  const auto& soil = state.soil;
  for (std::size_t p = 0; p < soil.size(); ++p)
    work_ += std::max(0.0, -soil.velocity[up][p]) * dt * std::abs(load_on(state.setup, soil, p, time));
}

template <class Space>
void Guards<Space>::check_energy(const Stepper<Space>& state, double time) {
  energy_now = mechanical_energy(state);
  energy_allowed = energy_at_start_ + strain_energy_ + work_;
  if (energy_now <= energy_allowed + GuardLimits::energy * std::abs(energy_at_start_ + work_)) return;
  throw RunFailure(
      fmt::format("energy grows without work: {:.4g} J of motion and height at t = {:.6g} s (step {}), at most {:.4g} "
                  "J can be there; "
                  "{}",
                  energy_now, time, state.step, energy_allowed, place_of_fastest(state)));
}

template <class Space>
void Guards<Space>::note_limits(const Stepper<Space>& state, const Audit<Space>& audit, double time) {
  const auto& lattice = state.setup.lattice;
  const FluxError flux = audit.worst_flux();
  note(flux_, flux.passed > GuardLimits::flux_counts ? flux.error : 0, GuardLimits::flux_balance, time,
       flux.axis == 0 ? flux.at : 0, flux.axis == 0 ? 0 : flux.at);
  if (audit.overfilled_now > GuardLimits::overfilled) {
    std::ptrdiff_t fullest = 0;
    for (std::ptrdiff_t cell = 0; cell < lattice.size; ++cell)
      if (state.grid.wet[cell] && (!state.grid.wet[fullest] || state.grid.fill[cell] > state.grid.fill[fullest]))
        fullest = cell;
    note(overfilled_, audit.overfilled_now, GuardLimits::overfilled, time,
         lattice.axis[0].centre(lattice.place(fullest, 0)),
         lattice.axis[Space::up].centre(lattice.place(fullest, Space::up)));
  }
  const auto& n = state.soil.porosity;
  std::size_t number = 0;
  for (const double value : n) number += value <= least_porosity || value >= most_porosity;
  if (static_cast<double>(number) <= GuardLimits::porosity * static_cast<double>(n.size())) return;
  const auto p = static_cast<std::size_t>(
      std::find_if(n.begin(), n.end(), [](double v) { return v <= least_porosity || v >= most_porosity; }) - n.begin());
  note(porosity_, static_cast<double>(number) / static_cast<double>(n.size()), GuardLimits::porosity, time,
       state.soil.position[0][p], state.soil.position[Space::up][p]);
}

template <class Space>
std::vector<std::string> Guards<Space>::warnings() const {
  std::vector<std::string> list;
  if (flux_.worst > 0)
    list.push_back(fmt::format(
        "the flux on the grid and the motion of the points differ by up to {:.2g} % at the section {} m, beyond 5 % "
        "first "
        "at t = {:.4g} s: discharges through it are not to be trusted",
        100 * flux_.worst, flux_.x > 0 ? fmt::format("x = {:.4g}", flux_.x) : fmt::format("y = {:.4g}", flux_.height),
        flux_.first_time));
  if (overfilled_.worst > 0)
    list.push_back(
        fmt::format("up to {:.2g} % of the wet cells were overfilled, beyond 5 % first at t = {:.4g} s, most near "
                    "({:.4g}, {:.4g}): "
                    "water is squeezed there; a finer grid may help",
                    100 * overfilled_.worst, overfilled_.first_time, overfilled_.x, overfilled_.height));
  if (porosity_.worst > 0)
    list.push_back(fmt::format(
        "the porosity of up to {:.2g} % of the soil was held at {} or {}, beyond 1 % first at t = {:.4g} s, for one "
        "near "
        "({:.4g}, {:.4g}): there the volume of the soil is not that of its deformation",
        100 * porosity_.worst, least_porosity, most_porosity, porosity_.first_time, porosity_.x, porosity_.height));
  return list;
}

template class Guards<PlaneStrain>;
template class Guards<Solid>;

}  // namespace polder
