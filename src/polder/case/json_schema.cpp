// docs/case.schema.json from the schema.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "polder/case/schema.hpp"
#include "polder/case/schema_pages.hpp"
#include "polder/math/units.hpp"

namespace polder {
namespace {

using namespace case_file;

using Json = nlohmann::ordered_json;

/// A text with a unit, or a plain number in its range; of angles only zero is a plain number.
Json measure(const Quantity& quantity, const Key& key) {
  Json number{{"type", "number"}};
  if (std::isfinite(key.low)) number["minimum"] = key.low;
  if (std::isfinite(key.high)) number["maximum"] = key.high;
  if (quantity.name == "angle") number = Json{{"const", 0}};
  return {{"anyOf", {{{"type", "string"}}, number}}};
}

Json points(std::size_t least, std::size_t most, std::size_t coordinates) {
  Json list{{"type", "array"}, {"minItems", least}};
  if (most > 0) list["maxItems"] = most;
  list["items"] = {
      {"type", "array"}, {"minItems", 2}, {"maxItems", coordinates}, {"items", {{"type", {"string", "number"}}}}};
  return list;
}

Json value_of(const Key& key) {
  if (const auto words = choices_of(key.quantity); !words.empty()) return {{"enum", words}};
  if (const Quantity* q = find_quantity(key.quantity)) return measure(*q, key);
  if (key.quantity == "flag") return {{"type", "boolean"}};
  if (key.quantity == "count")
    return {{"type", "integer"},
            {"minimum", static_cast<long long>(key.low)},
            {"maximum", static_cast<long long>(key.high)}};
  if (key.quantity == "polygon") return points(3, 0, 2);
  if (key.quantity == "polyline") return points(2, 0, 2);
  if (key.quantity == "box") return points(2, 2, 3);
  if (key.quantity == "points") return points(1, 0, 3);
  if (key.quantity.starts_with("list of ")) {
    const Json one = measure(*find_quantity(key.quantity.substr(8)), key);
    return {{"anyOf", {one["anyOf"][0], one["anyOf"][1], Json{{"type", "array"}, {"items", one}}}}};
  }
  if (const auto table = table_kind(key.quantity)) {
    const Json one = measure(*table->of, key);
    const Json pairs{{"type", "array"}, {"minItems", 1}, {"items", points(2, 2, 2)["items"]}};
    if (!table->by_time()) return {{"anyOf", {Json{{"type", "string"}}, pairs}}};
    return {{"anyOf", {one["anyOf"][0], one["anyOf"][1], pairs}}};
  }
  return {{"type", "string"}};
}

Json property(const Key& key) {
  Json json{{"description", key.symbol.empty() ? key.doc : fmt::format("{}: {}", key.symbol, key.doc)}};
  json.update(value_of(key));
  if (!key.standard.empty()) {
    if (key.quantity == "flag")
      json["default"] = key.standard == "true";
    else if (key.quantity == "count")
      json["default"] = std::stoll(key.standard);
    else
      json["default"] = key.standard;
  }
  return json;
}

std::vector<Key> keys_with_laws(const Section& section) {
  std::vector<Key> keys;
  for (const Key* key : keys_of(section.name)) keys.push_back(*key);
  if (section.name != "material") return keys;
  for (const LawDescription& law : soil_laws())
    for (const Parameter& parameter : law.parameters) {
      const bool known = std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == parameter.key; });
      if (!known) keys.push_back(law_key(parameter));
      if (!known) keys.back().required = false;  // by its law only
    }
  return keys;
}

/// What must be there in a file that is not based on another one.
Json complete() {
  Json top = Json::array(), sections = Json::object();
  for (const Section& section : case_sections()) {
    if (section.required) top.push_back(section.name);
    Json required = Json::array();
    for (const Key* key : keys_of(section.name))
      if (key->required) required.push_back(key->name);
    if (required.empty()) continue;
    Json table{{"required", required}};
    if (section.name == "material") {
      for (const LawDescription& law : soil_laws()) {
        Json of_law = Json::array();
        for (const Parameter& parameter : law.parameters)
          if (parameter.required) of_law.push_back(parameter.key);
        table["allOf"].push_back(
            {{"if", {{"properties", {{"law", {{"const", law.name}}}}}}}, {"then", {{"required", of_law}}}});
      }
    }
    sections[std::string(section.name)] = section.list ? Json{{"items", table}} : table;
  }
  return {{"required", top}, {"properties", sections}};
}

}  // namespace

std::string case_json_schema() {
  Json schema{
      {"$schema", "http://json-schema.org/draft-07/schema#"},
      {"title", "A Polder case"},
      {"description", "Written by `polder schema --json` from the table in src/polder/case/schema.cpp; do not edit."},
      {"type", "object"},
      {"additionalProperties", false}};
  schema["properties"]["base"] = {{"type", "string"},
                                  {"description", "A case file that this one overrides, from this file's folder."}};
  for (const Section& section : case_sections()) {
    Json table{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    for (const Key& key : keys_with_laws(section)) {
      table["properties"][key.name] = property(key);
      if (key.name == "law") {
        Json names = Json::array();
        for (const LawDescription& law : soil_laws()) names.push_back(law.name);
        table["properties"]["law"]["enum"] = names;
      }
    }
    Json json = section.list ? Json{{"description", section.doc}, {"type", "array"}, {"items", table}} : table;
    if (!section.list) json["description"] = section.doc;
    schema["properties"][std::string(section.name)] = json;
  }
  schema["anyOf"] = Json::array({Json{{"required", {"base"}}}, complete()});
  return schema.dump(1, '\t') + "\n";
}

}  // namespace polder
