#include "polder/report/case_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// Rows of two numbers, by time; none where the list is something else.
Json rows_of(const Json& object, const char* key) {
  const Json list = list_of(object, key);
  const bool good = std::all_of(list.begin(), list.end(), [](const Json& row) {
    return row.is_array() && row.size() == 2 && row[0].is_number() && row[1].is_number();
  });
  return good ? list : Json::array();
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

/// "1.2e-05" as 1.2·10⁻⁵.
void set_power(std::string& text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos || e == 0 || e + 1 >= text.size()) return;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (!is_digit(text[e - 1]) || (text[e + 1] != '-' && text[e + 1] != '+')) return;
  std::size_t begin = e + 2, end = begin;
  while (end < text.size() && is_digit(text[end])) ++end;
  while (begin + 1 < end && text[begin] == '0') ++begin;
  if (begin == end) return;
  constexpr std::array raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string power = text[e + 1] == '-' ? "10⁻" : "10";
  for (std::size_t k = begin; k < end; ++k) power += raised[static_cast<std::size_t>(text[k] - '0')];
  const bool one = text.substr(0, e) == "1";
  text.replace(one ? 0 : e, end - (one ? 0 : e), one ? power : "·" + power);
}

/// Units as they are printed, not as they are typed.
std::string typeset(std::string text) {
  replace_all(text, " deg", "°");
  replace_all(text, "m3", "m³");
  replace_all(text, "m2", "m²");
  if (text.starts_with('-')) text.replace(0, 1, "−");
  set_power(text);
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

/// A table by time, as "2.5 m to 6 m in 18 h" or, with a way back, by its extremes.
std::string course_text(const Json& table, const char* quantity) {
  const Quantity* known = find_quantity(quantity);
  const auto shown = [&](const Json& row) {
    const double value = row.at(1).get<double>();
    return known ? typeset(show_measure(value, *known)) : number_text(value);
  };
  if (table.empty()) return "";
  if (table.size() == 1) return shown(table[0]);
  const auto [low, high] = std::minmax_element(table.begin(), table.end(), [](const Json& a, const Json& b) {
    return a.at(1).get<double>() < b.at(1).get<double>();
  });
  const std::string time = time_text(table.back().at(0).get<double>());
  const auto ends = std::minmax({table.front().at(1).get<double>(), table.back().at(1).get<double>()});
  if (ends.first <= low->at(1).get<double>() && ends.second >= high->at(1).get<double>())
    return fmt::format("{} to {} in {}", shown(table.front()), shown(table.back()), time);
  return fmt::format("{} to {}, {} after {}", shown(*low), shown(*high), shown(table.back()), time);
}

/// What is given there: a head, a discharge, a motion, a pressure.
std::string given_text(const Json& boundary) {
  struct Course {
    const char *key, *name, *quantity;
  };
  std::vector<std::string> parts;
  for (const Course& c : {Course{"head", "head", "length"},
                          {"head_at_end", "at its end", "length"},
                          {"rate", "rain", "velocity"},
                          {"inflow", "inflow", "velocity"},
                          {"discharge", "discharge", "discharge"},
                          {"slide", "slides", "velocity"},
                          {"push", "moves", "velocity"},
                          {"pressure", "pressure", "pressure"}})
    if (const std::string text = course_text(rows_of(boundary, c.key), c.quantity); !text.empty())
      parts.push_back(fmt::format("{} {}", c.name, text));
  return parts.empty() ? "–" : fmt::format("{}", fmt::join(parts, "; "));
}

/// Boundaries of the model, of the water in the ground, and loads.
PageTable boundaries(const Json& inputs) {
  PageTable table{"boundaries", "Boundaries", "", {"Boundary", "Where", "Soil", "Water", "Given"}, {}, {}};
  table.numeric.assign(table.columns.size(), false);
  const auto add = [&](const Json& b, const std::string& where, const std::string& soil, const std::string& water) {
    table.rows.push_back({{words(text_of(b, "name"))}, {where}, {soil}, {water}, {given_text(b)}});
  };
  for (const Json& b : list_of(inputs, "boundary")) add(b, place_text(b), text_of(b, "soil"), text_of(b, "water"));
  for (const Json& b : list_of(inputs, "seepage_boundary")) add(b, place_text(b), "–", text_of(b, "condition"));
  const auto over = [](const Json& span) {
    return span.size() == 2 ? fmt::format("x from {} to {} m", number_text(span[0]), number_text(span[1]))
                            : "everywhere";
  };
  for (const Json& rain : list_of(inputs, "rain")) add(rain, over(list_of(rain, "span")), "–", "rain");
  for (const Json& well : list_of(inputs, "well")) add(well, point_text(list_of(well, "at")), "–", "well");
  for (const Json& load : list_of(inputs, "load")) add(load, over(list_of(load, "span")), "load", "–");
  const Json initial = inputs.is_object() ? inputs.value("initial", Json()) : Json();
  std::string line;
  for (const Json& point : list_of(initial, "water_table")) line += (line.empty() ? "" : " – ") + point_text(point);
  if (!line.empty()) table.note = "Water table at the start: " + line + " m.";
  return table;
}

/// How each soil holds water, where pores may hold air.
PageTable retention(const Json& list) {
  PageTable table{"retention", "Water in the pores", "", {"Quantity"}, {false}, {}};
  std::vector<std::string> keys;
  for (const Json& soil : list) {
    table.columns.push_back(words(text_of(soil, "material")));
    table.numeric.push_back(true);
    for (const auto& [key, value] : soil.items())
      if (key != "material" && !value.is_array() && std::find(keys.begin(), keys.end(), key) == keys.end())
        keys.push_back(key);
  }
  for (const std::string& key : keys) {
    const char* quantity = key == "entry_pressure" ? "pressure" : "";
    const std::string unit = key == "slope" || key.ends_with("rate") ? " 1/Pa" : "";
    std::vector<PageCell> row{{words(key)}};
    for (const Json& soil : list)
      row.push_back({soil.contains(key) ? value_text(soil[key], quantity) + unit : std::string("–")});
    table.rows.push_back(row);
  }
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
  if (stage.value("until_rest", false)) parts.push_back("ends as soon as the ground is at rest");
  if (stage.value("hold_water", false)) parts.push_back("water held horizontally");
  return parts.empty() ? "–" : fmt::format("{}", fmt::join(parts, "; "));
}

/// What is dug, placed, switched on or taken away as a stage begins.
std::string what_changes(const Json& inputs, const std::string& stage) {
  std::vector<std::string> parts;
  for (const Json& change : list_of(inputs, "change")) {
    if (text_of(change, "stage") != stage) continue;
    std::string name = text_of(change, "name");
    if (name.empty()) name = text_of(change, "material");
    parts.push_back(text_of(change, "action") + (name.empty() ? "" : " " + name));
  }
  for (const char* section : {"wall", "load", "well"})
    for (const Json& thing : list_of(inputs, section)) {
      const std::string name = text_of(thing, "name").empty() ? section : text_of(thing, "name");
      if (text_of(thing, "from_stage") == stage) parts.push_back(name + " from here on");
      if (text_of(thing, "until_stage") == stage) parts.push_back(name + " until here");
    }
  return fmt::format("{}", fmt::join(parts, "; "));
}

PageTable stages(const Json& inputs) {
  const Json list = list_of(inputs, "stage");
  PageTable table{"stages", "Stages", "", {"Stage", "Duration", "What is special"}, {false, true, false}, {}};
  for (const Json& s : list) {
    std::string text = what_happens(s);
    if (const std::string changes = what_changes(inputs, text_of(s, "name")); !changes.empty())
      text = text == "–" ? changes : fmt::format("{}; {}", changes, text);
    table.rows.push_back(
        {{words(text_of(s, "name"))}, {s.contains("duration") ? time_text(s["duration"].get<double>()) : "–"}, {text}});
  }
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
  if (const Json list = list_of(inputs, "retention"); !list.empty()) tables.push_back(retention(list));
  if (PageTable table = boundaries(inputs); !table.rows.empty()) tables.push_back(std::move(table));
  if (PageTable table = stages(inputs); !table.rows.empty()) tables.push_back(std::move(table));
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

std::vector<PageLevel> page_levels(const Json& inputs) {
  std::vector<PageLevel> levels;
  for (const Json& boundary : list_of(inputs, "seepage_boundary")) {
    if (text_of(boundary, "condition") != "head" || !list_of(boundary, "head_at_end").empty()) continue;
    PageLevel level{text_of(boundary, "name"), {}, {}};
    for (const Json& point : rows_of(boundary, "line"))
      level.line.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
    for (const Json& row : rows_of(boundary, "head"))
      level.head.push_back({row.at(0).get<double>(), row.at(1).get<double>()});
    if (level.line.size() > 1 && !level.head.empty()) levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace polder
