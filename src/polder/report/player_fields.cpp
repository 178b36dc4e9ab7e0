#include "polder/report/player_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "polder/result/model_drawing.hpp"

namespace polder {
namespace {

struct Viewing {
  const char* key;
  FieldScale scale;
  const char* note;
};

/// Fields that are not simply "from little to much".
constexpr std::array viewings{
    Viewing{"excess_pressure", FieldScale::diverging, "over the initial water table at rest"},
    Viewing{"volumetric_strain", FieldScale::diverging, "positive: looser"},
    Viewing{"mean_effective_stress", FieldScale::sequential, "compression positive"},
    Viewing{"vertical_effective_stress", FieldScale::sequential, "tension positive"},
    Viewing{"material", FieldScale::category, ""},
    Viewing{"liquefied", FieldScale::category, ""},
    Viewing{"fluidised", FieldScale::category, ""},
    Viewing{"fluid", FieldScale::category, ""},
};

/// What readers look for first; the rest follows as the snapshot has it.
constexpr std::array first_of_all{"deviatoric_strain", "displacement", "porosity",         "pore_pressure", "pressure",
                                  "excess_pressure",   "saturation",   "effective_stress", "plastic_strain"};

bool says_loss_of_contact(const std::string& key) { return key == "liquefied" || key == "fluidised" || key == "fluid"; }

std::string hex_text(const Colour& c) {
  const auto byte = [](double v) { return static_cast<int>(std::lround(255 * v)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.red), byte(c.green), byte(c.blue));
}

PlayerField described(const FieldInfo& info, const std::vector<std::string>& material_names) {
  PlayerField field{info.name, info.label, info.symbol, info.unit};
  for (const Viewing& viewing : viewings)
    if (info.name == viewing.key) {
      field.scale = viewing.scale;
      field.note = viewing.note;
    }
  if (info.name == "material") {
    field.categories = material_names;
    for (const Colour& c : material_colours(material_names)) field.colours.push_back(hex_text(c));
  }
  if (says_loss_of_contact(info.name)) {
    field.label = "Fluidised state";
    field.categories = {"grains in contact", "fluidised"};
    field.colours = {"#dccba0", "#b03a48"};
  }
  return field;
}

void add_tensor(std::vector<PlayerColumn>& columns, const PointField& field, int up) {
  if (field.info.name != "effective_stress") return;
  using Take = PlayerColumn::Take;
  columns.push_back({described(field_info("mean_effective_stress"), {}), field.info.name, Take::mean_pressure});
  columns.push_back({described(field_info("deviatoric_stress"), {}), field.info.name, Take::deviator});
  columns.push_back({described(field_info("vertical_effective_stress"), {}), field.info.name, Take::component, up});
}

void add_vector(std::vector<PlayerColumn>& columns, const PointField& field, int up) {
  using Take = PlayerColumn::Take;
  if (field.info.name == "displacement") return;  // the player knows where a point was first seen
  if (field.info.name != "velocity") {
    columns.push_back({described(field.info, {}), field.info.name, Take::magnitude});
    return;
  }
  for (const auto& [key, component] : {std::pair{"velocity_x", 0}, std::pair{"velocity_y", up}}) {
    PlayerField info{key, key, "", "m/s"};
    info.shown = false;
    columns.push_back({info, field.info.name, Take::component, component});
  }
}

std::size_t rank(const std::string& name) {
  return static_cast<std::size_t>(std::find(first_of_all.begin(), first_of_all.end(), name) - first_of_all.begin());
}

double taken(const PlayerColumn& column, const double* v, int components) {
  switch (column.take) {
    case PlayerColumn::Take::value:
      return v[0];
    case PlayerColumn::Take::component:
      return v[column.component];
    case PlayerColumn::Take::magnitude: {
      double sum = 0;
      for (int c = 0; c < components; ++c) sum += v[c] * v[c];
      return std::sqrt(sum);
    }
    case PlayerColumn::Take::mean_pressure:
      return -(v[0] + v[1] + v[2]) / 3;
    case PlayerColumn::Take::deviator: {
      const double mean = (v[0] + v[1] + v[2]) / 3;
      double product = 0;
      for (int c = 0; c < components; ++c) product += c < 3 ? (v[c] - mean) * (v[c] - mean) : 2 * v[c] * v[c];
      return std::sqrt(1.5 * product);
    }
  }
  throw std::logic_error("report: unknown way to take a value");
}

}  // namespace

std::vector<PlayerColumn> player_columns(const PointSet& points, int up,
                                         const std::vector<std::string>& material_names) {
  using Take = PlayerColumn::Take;
  std::vector<PlayerColumn> columns;
  columns.push_back({{"x", "x", "x", "m", "", FieldScale::sequential, false}, "", Take::component, 0});
  columns.push_back({{"y", "y", "y", "m", "", FieldScale::sequential, false}, "", Take::component, up});

  std::vector<const PointField*> ordered;
  for (const PointField& field : points.fields) ordered.push_back(&field);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const PointField* a, const PointField* b) { return rank(a->info.name) < rank(b->info.name); });
  for (const PointField* field : ordered) {
    if (field->components == 1)
      columns.push_back({described(field->info, material_names), field->info.name, Take::value});
    else if (field->components <= 3)
      add_vector(columns, *field, up);
    else
      add_tensor(columns, *field, up);
  }
  return columns;
}

void append_values(const PlayerColumn& column, const PointSet& points, const std::vector<std::size_t>& chosen,
                   std::vector<float>& values) {
  if (column.source.empty()) {
    for (const std::size_t p : chosen)
      values.push_back(static_cast<float>(points.position[p][static_cast<std::size_t>(column.component)]));
    return;
  }
  const PointField* field = points.find(column.source);
  for (const std::size_t p : chosen)
    values.push_back(
        field ? static_cast<float>(
                    taken(column, &field->values[p * static_cast<std::size_t>(field->components)], field->components))
              : std::numeric_limits<float>::quiet_NaN());
}

}  // namespace polder
