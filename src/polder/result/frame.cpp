#include "polder/result/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace polder {
namespace {

struct KnownField {
  const char *name, *label, *symbol, *unit;
};

constexpr std::array known_fields{
    KnownField{"porosity", "Porosity", "n", ""},
    KnownField{"void_ratio", "Void ratio", "e", ""},
    KnownField{"saturation", "Degree of saturation", "S", ""},
    KnownField{"pore_pressure", "Pore water pressure", "p", "Pa"},
    KnownField{"pressure", "Water pressure", "p", "Pa"},
    KnownField{"excess_pressure", "Excess pore pressure", "Δp", "Pa"},
    KnownField{"effective_stress", "Effective stress", "σ′", "Pa"},
    KnownField{"mean_effective_stress", "Mean effective stress", "p′", "Pa"},
    KnownField{"deviatoric_stress", "Deviatoric stress", "q", "Pa"},
    KnownField{"vertical_effective_stress", "Vertical effective stress", "σ′ᵥ", "Pa"},
    KnownField{"deviatoric_strain", "Deviatoric strain", "εₛ", ""},
    KnownField{"plastic_strain", "Plastic deviatoric strain", "εₚ", ""},
    KnownField{"volumetric_strain", "Volumetric strain", "εᵥ", ""},
    KnownField{"displacement", "Displacement", "u", "m"},
    KnownField{"velocity", "Velocity", "v", "m/s"},
    KnownField{"seepage_velocity", "Seepage velocity", "q", "m/s"},
    KnownField{"material", "Material", "", ""},
    KnownField{"density", "Density", "ρ", "kg/m³"},
    KnownField{"strength_ratio", "Mobilised strength", "", ""},
    KnownField{"liquefied", "Liquefied", "", ""},
};

void check_points(const PointSet& points, const char* phase) {
  const auto check = [&](const std::string& name, std::size_t length, std::size_t components) {
    if (length != points.size() * components)
      throw std::logic_error(std::string("frame: ") + phase + " field '" + name + "' has " + std::to_string(length) +
                             " values for " + std::to_string(points.size()) + " points of " +
                             std::to_string(components) + " components");
  };
  check("id", points.id.size(), 1);
  check("volume", points.volume.size(), 1);
  for (const PointField& field : points.fields)
    check(field.info.name, field.values.size(), static_cast<std::size_t>(field.components));
}

}  // namespace

FieldInfo field_info(std::string_view name) {
  for (const KnownField& known : known_fields)
    if (name == known.name) return {known.name, known.label, known.symbol, known.unit};
  std::string label(name);
  std::replace(label.begin(), label.end(), '_', ' ');
  if (!label.empty() && label[0] >= 'a' && label[0] <= 'z') label[0] = static_cast<char>(label[0] - 'a' + 'A');
  return {std::string(name), label, "", ""};
}

PointField make_field(std::string_view name, std::vector<double> values, int components) {
  return {field_info(name), components, std::move(values)};
}

const PointField* PointSet::find(std::string_view name) const {
  for (const PointField& field : fields)
    if (field.info.name == name) return &field;
  return nullptr;
}

std::vector<double> magnitudes(const PointField& field) {
  if (field.components == 1) return field.values;
  if (field.components > 3) throw std::invalid_argument("field '" + field.info.name + "' is a tensor");
  const std::size_t axes = static_cast<std::size_t>(field.components);
  std::vector<double> result(field.values.size() / axes);
  for (std::size_t p = 0; p < result.size(); ++p) {
    double sum = 0;
    for (std::size_t a = 0; a < axes; ++a) sum += field.values[p * axes + a] * field.values[p * axes + a];
    result[p] = std::sqrt(sum);
  }
  return result;
}

void check_frame(const Frame& frame) {
  check_points(frame.soil, "soil");
  check_points(frame.water, "water");
}

}  // namespace polder
