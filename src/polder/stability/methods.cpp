#include "polder/stability/methods.hpp"

#include <fmt/format.h>

#include "polder/stability/section_from_model.hpp"
#include "polder/stability/sliding_area.hpp"

namespace polder::stability {
namespace {

Equilibrium by_bishop(const Slices& slices, const SlipSurface& surface) { return bishop(slices, surface.circle); }
Equilibrium by_spencer(const Slices& slices, const SlipSurface&) { return spencer(slices); }
Equilibrium by_morgenstern_price(const Slices& slices, const SlipSurface&) {
  return morgenstern_price(slices, Interslice::half_sine);
}
Equilibrium by_uplift_van(const Slices& slices, const SlipSurface& surface) {
  return uplift_van(slices, surface.plane);
}

std::string describe(const SlipSurface& surface) {
  const std::string span = fmt::format("x {:.2f} to {:.2f} m", surface.left, surface.right);
  if (surface.kind == SurfaceKind::circle)
    return fmt::format("{}, centre ({:.2f}, {:.2f}), R {:.2f}", span, surface.circle.centre[0],
                       surface.circle.centre[1], surface.circle.radius);
  if (surface.kind == SurfaceKind::uplift_van)
    return fmt::format("{}, plane at {:.2f} from {:.2f} to {:.2f} m", span, surface.plane.tangent,
                       surface.plane.active[0], surface.plane.passive[0]);
  return fmt::format("{}, {} points", span, surface.points.size());
}

Outcome finish(SearchResult search) {
  Outcome outcome;
  outcome.problem = search.problem;
  outcome.factor = search.equilibrium.factor;
  if (search) outcome.remark = describe(search.surface);
  outcome.search = std::move(search);
  return outcome;
}

Outcome run_bishop(const Study& study, const PreparedSection& prepared) {
  if (study.input.circle) return finish(evaluate(prepared, circle_surface(prepared, *study.input.circle), by_bishop));
  return finish(critical_circle(prepared, by_bishop));
}

// Given surfaces are computed as they are; a search tries circles, then lets their vertices go, and keeps the lesser.
Outcome run_interslice(const Study& study, const PreparedSection& prepared, const Method& method) {
  if (!study.input.surface.empty())
    return finish(evaluate(prepared, free_surface(prepared, study.input.surface), method));
  if (study.input.circle) return finish(evaluate(prepared, circle_surface(prepared, *study.input.circle), method));
  SearchResult circle = critical_circle(prepared, method);
  SearchResult loose = critical_free_surface(prepared, method);
  const bool take_loose = loose && (!circle || loose.equilibrium.factor < circle.equilibrium.factor);
  return finish(take_loose ? std::move(loose) : std::move(circle));
}

Outcome run_spencer(const Study& study, const PreparedSection& prepared) {
  return run_interslice(study, prepared, by_spencer);
}

Outcome run_morgenstern_price(const Study& study, const PreparedSection& prepared) {
  return run_interslice(study, prepared, by_morgenstern_price);
}

Outcome run_uplift_van(const Study& study, const PreparedSection& prepared) {
  if (study.input.plane)
    return finish(evaluate(prepared, uplift_van_surface(prepared, *study.input.plane), by_uplift_van));
  return finish(critical_uplift_van(prepared));
}

Outcome run_strength_reduction(const Study& study, const PreparedSection& prepared) {
  SectionReductionOptions options;
  if (study.input.fem_triangles > 0) options.triangles = study.input.fem_triangles;
  options.mesh_file = study.input.mesh_file;
  if (!study.input.fixed_line.empty()) options.fixed.push_back(study.input.fixed_line);
  for (const MaterialInput& material : study.model.materials)
    options.stiffness.push_back({law_parameter(material, "young_modulus").value_or(options.young_modulus),
                                 law_parameter(material, "poisson_ratio").value_or(options.poisson_ratio)});
  const auto reduction = std::make_shared<SectionReduction>(reduce_strength(prepared, options));
  Outcome outcome;
  outcome.problem = reduction->problem;
  outcome.factor = reduction->result.factor;
  if (outcome)
    outcome.remark =
        fmt::format("stands at {:.3f}, fails at {:.3f}, {:.4g} m2 slide; {} triangles", reduction->result.stable,
                    reduction->result.failed, sliding_area(reduction->mesh, reduction->result.mechanism),
                    reduction->mesh.triangles.size());
  outcome.reduction = reduction;
  return outcome;
}

constexpr StabilityMethod methods[] = {
    {"bishop", "circles, simplified (1955)", run_bishop},
    {"spencer", "circles and free surfaces, parallel interslice forces (1967)", run_spencer},
    {"morgenstern-price", "circles and free surfaces, half-sine interslice function (1965)", run_morgenstern_price},
    {"uplift-van", "active circle, horizontal plane, passive circle (2001)", run_uplift_van},
    {"srm", "finite elements with strength reduction (1999)", run_strength_reduction},
};

}  // namespace

std::span<const StabilityMethod> stability_methods() { return methods; }

const StabilityMethod* find_stability_method(std::string_view name) {
  for (const StabilityMethod& method : methods)
    if (method.name == name) return &method;
  return nullptr;
}

std::string stability_method_names() {
  std::string names;
  for (const StabilityMethod& method : methods) names += (names.empty() ? "" : ", ") + std::string(method.name);
  return names;
}

}  // namespace polder::stability
