// Phase relations of a soil from an engineer's numbers: γ_unsat = (1 − n) ρs g, γ_sat = [(1 − n) ρs + n ρw] g,
// e = n / (1 − n); k = κ ρw g / μ. Two independent numbers fix ρs and n; more must agree.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "polder/case/sections.hpp"
#include "polder/math/units.hpp"

namespace polder::case_file {
namespace {

constexpr double agreement = 0.01;  // of numbers that say the same thing twice

struct State {
  double grain_density, porosity;
};

bool plausible(const State& s) { return s.porosity > 0 && s.porosity < 1 && s.grain_density > 0; }

/// `dry` and `saturated` are densities (γ/g).
std::optional<State> solve(std::optional<double> rho_s, std::optional<double> n, std::optional<double> dry,
                           std::optional<double> saturated, double rho_w) {
  if (rho_s && n) return State{*rho_s, *n};
  if (rho_s && dry) return State{*rho_s, 1 - *dry / *rho_s};
  if (rho_s && saturated) return State{*rho_s, (*rho_s - *saturated) / (*rho_s - rho_w)};
  if (n && dry) return State{*dry / (1 - *n), *n};
  if (n && saturated) return State{(*saturated - *n * rho_w) / (1 - *n), *n};
  if (dry && saturated) {
    const double porosity = (*saturated - *dry) / rho_w;
    return State{*dry / (1 - porosity), porosity};
  }
  return {};
}

void require_agreement(const Fields& fields, std::string_view key, double given, double follows,
                       const Quantity& quantity, Diagnostics& diagnostics) {
  if (std::abs(given - follows) <= agreement * std::abs(given)) return;
  report(
      diagnostics, fields.place_of(key), fields.path_of(key),
      fmt::format("{} contradicts the other keys, from which {} follows", show_measure(given, quantity),
                  show_measure(follows, quantity)),
      "two of grain_density, porosity (or void_ratio), unsaturated_unit_weight and saturated_unit_weight are enough");
}

}  // namespace

void settle_phases(const Fields& fields, const WaterProperties& water, MaterialInput& material,
                   Diagnostics& diagnostics) {
  const auto value = [&](std::string_view key, double factor = 1) -> std::optional<double> {
    const Entry* field = fields.find(key);
    return field ? std::optional(field->number * factor) : std::nullopt;
  };
  if (fields.is_given("porosity") && fields.is_given("void_ratio"))
    report(diagnostics, fields.place_of("void_ratio"), fields.path_of("void_ratio"), "is given beside the porosity",
           "keep one of the two: e = n / (1 − n)");
  const auto e = value("void_ratio");
  const auto n = value("porosity") ? value("porosity") : e ? std::optional(*e / (1 + *e)) : std::nullopt;
  const auto rho_s = value("grain_density");
  const auto dry = value("unsaturated_unit_weight", 1 / standard_gravity);
  const auto saturated = value("saturated_unit_weight", 1 / standard_gravity);
  int given = 0;
  for (const std::string_view key :
       {"grain_density", "porosity", "void_ratio", "unsaturated_unit_weight", "saturated_unit_weight"})
    given += fields.is_given(key);
  if (given < 2) {
    report(
        diagnostics, fields.place, fields.path, "density and porosity are not fixed",
        "give grain_density and porosity (or void_ratio), or two unit weights such as unsaturated_unit_weight = \"16 "
        "kN/m3\" and saturated_unit_weight = \"20 kN/m3\"");
    return;
  }
  const auto state = solve(rho_s, n, dry, saturated, water.density);
  if (!state) return;  // what is missing could not be read, and has been reported
  if (!plausible(*state)) {
    report(diagnostics, fields.place, fields.path,
           fmt::format("the densities give a porosity of {:.3g} and a grain density of {:.4g} kg/m3", state->porosity,
                       state->grain_density),
           "a soil has γ_unsat < γ_sat < ρs g and a porosity between 0 and 1");
    return;
  }
  material.grain_density = state->grain_density;
  material.porosity = state->porosity;
  const double solid = (1 - state->porosity) * state->grain_density;
  const Quantity& weight = *find_quantity("unit weight");
  if (dry)
    require_agreement(fields, "unsaturated_unit_weight", *dry * standard_gravity, solid * standard_gravity, weight,
                      diagnostics);
  if (saturated)
    require_agreement(fields, "saturated_unit_weight", *saturated * standard_gravity,
                      (solid + state->porosity * water.density) * standard_gravity, weight, diagnostics);
  if (material.max_porosity <= material.porosity)
    report(diagnostics, fields.place_of("max_porosity"), fields.path_of("max_porosity"),
           fmt::format("{:.4g} is not above the initial porosity {:.4g}", material.max_porosity, material.porosity),
           "the loosest packing must be looser than the soil at the start");
  if (material.grain_density <= water.density)
    warn(diagnostics, fields.place_of("grain_density"), fields.path_of("grain_density"),
         fmt::format("grains of {:.4g} kg/m3 float in this water", material.grain_density));
}

void settle_permeability(const Fields& fields, const WaterProperties& water, double gravity, MaterialInput& material,
                         Diagnostics& diagnostics) {
  const bool h = fields.is_given("horizontal_permeability"), v = fields.is_given("vertical_permeability");
  const bool both = fields.is_given("permeability"), intrinsic = fields.is_given("intrinsic_permeability");
  if ((both ? 1 : 0) + (intrinsic ? 1 : 0) + (h || v ? 1 : 0) > 1)
    report(diagnostics, fields.place_of(both ? "permeability" : "intrinsic_permeability"),
           fields.path_of("permeability"), "the permeability is given in more than one way",
           "keep one of permeability, intrinsic_permeability, and horizontal_permeability with vertical_permeability");
  if (h != v)
    report(diagnostics, fields.place_of(h ? "horizontal_permeability" : "vertical_permeability"),
           fields.path_of(h ? "horizontal_permeability" : "vertical_permeability"),
           fmt::format("the {} permeability is missing", h ? "vertical" : "horizontal"),
           "give both, or permeability for the same in all directions");
  material.grain_diameter = fields.number("grain_diameter");
  const double per_area = water.density * (gravity > 0 ? gravity : standard_gravity) / water.viscosity;
  if (const Entry* k = fields.find("permeability")) material.permeability = {k->number, k->number};
  if (const Entry* kappa = fields.find("intrinsic_permeability"))
    material.permeability = {kappa->number * per_area, kappa->number * per_area};
  if (h && v)
    material.permeability = {fields.number("horizontal_permeability"), fields.number("vertical_permeability")};
  if (!both && !intrinsic && !h && !v && !fields.is_given("grain_diameter"))
    report(diagnostics, fields.place, fields.path, "the permeability is not fixed",
           "give permeability = \"1e-3 m/s\" or grain_diameter = \"0.5 mm\"");
  const bool dilute = material.drag == DragLaw::beetstra || material.drag == DragLaw::gidaspow;
  if (dilute && !fields.is_given("grain_diameter"))
    report(diagnostics, fields.place_of("drag"), fields.path_of("drag"),
           fmt::format("\"{}\" needs the grain diameter", fields.text("drag")), "give grain_diameter = \"0.5 mm\"");
  if (material.permeability && material.grain_diameter > 0) {
    const double n = material.porosity, d = material.grain_diameter;
    const double kozeny = d * d * n * n * n / (material.ergun_a * (1 - n) * (1 - n)) * per_area;
    const double ratio = (*material.permeability)[1] / kozeny;
    if (ratio > 3 || ratio < 1.0 / 3)
      warn(diagnostics, fields.place_of("grain_diameter"), fields.path_of("grain_diameter"),
           fmt::format("Kozeny–Carman makes k = {:.2g} m/s of it, {:.2g} times the given permeability", kozeny,
                       1 / ratio),
           "the given permeability counts; the diameter enters where a drag law needs it");
  }
}

}  // namespace polder::case_file
