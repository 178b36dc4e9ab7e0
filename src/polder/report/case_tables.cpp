#include "polder/report/case_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "polder/case/schema.hpp"
#include "polder/math/units.hpp"
#include "polder/result/ticks.hpp"

namespace polder {
namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Json& inputs, const char* section) {
  const Json list = inputs.is_object() ? inputs.value(section, Json()) : Json();
  return list.is_array() ? list : Json::array();
}

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  if (!key.empty() && key[0] >= 'a' && key[0] <= 'z') key[0] = static_cast<char>(key[0] - 'a' + 'A');
  return key;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Units as they are printed, not as they are typed.
std::string typeset(std::string text) {
  replace_all(text, " deg", "°");
  replace_all(text, "m3", "m³");
  replace_all(text, "m2", "m²");
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

/// The case file's description of a material's key, be it the schema's or that of the law.
std::optional<case_file::Key> material_key(const std::string& name, const std::string& law) {
  if (const LawDescription* description = find_soil_law(law))
    for (const Parameter& parameter : description->parameters)
      if (parameter.key == name) return case_file::law_key(parameter);
  if (const case_file::Key* key = case_file::find_key("material", name)) return *key;
  return std::nullopt;
}

std::string value_text(const Json& value, const std::string& quantity) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) return value.is_null() ? "–" : value.dump();
  const Quantity* known = find_quantity(quantity);
  return known ? typeset(show_measure(value.get<double>(), *known)) : number_text(value.get<double>());
}

PageTable materials(const Json& list) {
  PageTable table{"materials", "Materials", "", {"Quantity", "Symbol"}, {false, false}, {}};
  std::vector<std::pair<std::string, case_file::Key>> keys;
  for (const Json& material : list) {
    table.columns.push_back(words(text_of(material, "name")));
    table.numeric.push_back(true);
    for (const auto& [name, value] : material.items()) {
      const bool listed =
          std::any_of(keys.begin(), keys.end(), [&key = name](const auto& k) { return k.first == key; });
      if (name == "name" || listed) continue;
      keys.emplace_back(name, material_key(name, text_of(material, "law")).value_or(case_file::Key{}));
    }
  }
  for (const auto& [name, key] : keys) {
    std::vector<PageCell> row{{words(name), {}, key.doc}, {key.symbol, {}, {}}};
    for (const Json& material : list)
      row.push_back({material.contains(name) ? value_text(material[name], key.quantity) : "–", {}, {}});
    table.rows.push_back(row);
  }
  return table;
}

std::string point_text(const Json& point) {
  std::string text;
  for (const Json& coordinate : point)
    if (coordinate.is_number()) text += (text.empty() ? "(" : ", ") + number_text(coordinate.get<double>());
  return text + ")";
}

std::string place_text(const Json& boundary) {
  if (const std::string side = text_of(boundary, "side"); !side.empty()) return side + " side";
  std::string text;
  for (const char* key : {"line", "region"})
    for (const Json& point : list_of(boundary, key)) text += (text.empty() ? "" : " – ") + point_text(point);
  return text;
}

std::string head_text(const Json& boundary) {
  const Json head = list_of(boundary, "head");
  if (head.empty()) return "–";
  const auto level = [](const Json& row) { return number_text(row.at(1).get<double>()) + " m"; };
  if (head.size() == 1) return level(head[0]);
  return fmt::format("{} to {} in {}", level(head.front()), level(head.back()),
                     time_text(head.back().at(0).get<double>()));
}

PageTable boundaries(const Json& list) {
  PageTable table{"boundaries", "Boundaries", "", {"Boundary", "Where", "Soil", "Water", "Head"}, {}, {}};
  table.numeric.assign(table.columns.size(), false);
  for (const Json& b : list)
    table.rows.push_back({{words(text_of(b, "name")), {}, {}},
                          {place_text(b), {}, {}},
                          {text_of(b, "soil"), {}, {}},
                          {text_of(b, "water"), {}, {}},
                          {head_text(b), {}, {}}});
  return table;
}

std::string what_happens(const Json& stage) {
  std::vector<std::string> parts;
  const auto number = [&](const char* key) {
    return stage.contains(key) && stage[key].is_number() ? stage[key].get<double>() : 0;
  };
  if (stage.value("initial", false)) parts.push_back("before t = 0, ends at rest with displacements set to zero");
  if (number("ramp") > 0) parts.push_back("gravity rises over " + time_text(number("ramp")));
  if (number("damping") > 0) parts.push_back(fmt::format("viscous damping {} 1/s", number_text(number("damping"))));
  if (number("local_damping") > 0) parts.push_back("local damping " + number_text(number("local_damping")));
  if (stage.value("hold_water", false)) parts.push_back("water held horizontally");
  return parts.empty() ? "–" : fmt::format("{}", fmt::join(parts, "; "));
}

PageTable stages(const Json& list) {
  PageTable table{"stages", "Stages", "", {"Stage", "Duration", "What is special"}, {false, true, false}, {}};
  for (const Json& s : list)
    table.rows.push_back({{words(text_of(s, "name")), {}, {}},
                          {s.contains("duration") ? time_text(s["duration"].get<double>()) : "–", {}, {}},
                          {what_happens(s), {}, {}}});
  return table;
}

}  // namespace

std::vector<std::string> material_names(const Json& inputs) {
  std::vector<std::string> names;
  for (const Json& material : list_of(inputs, "material")) names.push_back(text_of(material, "name"));
  return names;
}

std::vector<PageTable> case_tables(const Json& inputs) {
  std::vector<PageTable> tables;
  if (const Json list = list_of(inputs, "material"); !list.empty()) tables.push_back(materials(list));
  if (const Json list = list_of(inputs, "boundary"); !list.empty()) tables.push_back(boundaries(list));
  if (const Json list = list_of(inputs, "stage"); !list.empty()) tables.push_back(stages(list));
  return tables;
}

std::vector<PageMonitor> page_monitors(const Json& inputs, std::size_t up) {
  std::vector<PageMonitor> monitors;
  for (const Json& monitor : list_of(inputs, "monitor")) {
    PageMonitor shown{text_of(monitor, "name"), {}};
    for (const Json& point : list_of(monitor, "at"))
      if (point.size() > up && point[0].is_number() && point[up].is_number())
        shown.points.push_back({point[0].get<double>(), point[up].get<double>()});
    if (!shown.points.empty()) monitors.push_back(shown);
  }
  return monitors;
}

}  // namespace polder
