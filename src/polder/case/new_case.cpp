// Case files written by the program: the document in the order of the schema, with the schema's words above each key,
// and the keys that it leaves at their defaults commented out.
#include <fmt/format.h>

#include <filesystem>

#include "polder/case/document.hpp"
#include "polder/case/schema.hpp"
#include "polder/case/schema_pages.hpp"

namespace polder {
namespace {

using namespace case_file;

namespace fs = std::filesystem;

constexpr const char* starter = R"(
[model]
title = "Seepage through a small dike"
space = "plane-strain"
size  = ["4.5 m", "1.2 m"]
cell  = "0.1 m"

[[material]]
name = "sand"
law  = "mohr-coulomb"
grain_density  = "2650 kg/m3"
porosity       = 0.4
grain_diameter = "1 mm"
young_modulus  = "5 MPa"
poisson_ratio  = 0.3
friction_angle = "34 deg"
cohesion       = "1 kPa"

[[soil]]
name = "dike"
material = "sand"
polygon = [["1 m", "0 m"], ["2.2 m", "0.8 m"], ["2.6 m", "0.8 m"], ["3.8 m", "0 m"]]

[[free_water]]
name = "river"
polygon = [["0 m", "0 m"], ["1 m", "0 m"], ["1.9 m", "0.6 m"], ["0 m", "0.6 m"]]

[initial]
water_table = [["1.9 m", "0.6 m"], ["3.8 m", "0 m"]]
stress = "none"

[[boundary]]
side = "base"
soil = "rough"

[[stage]]
name = "gravity"
initial = true
duration = "1 s"
ramp = "0.7 s"
damping = "10 1/s"
hold_water = true

[[stage]]
name = "seepage"
duration = "5 s"

[output]
history = "0.1 s"
snapshots = "0.5 s"
)";

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

std::string toml_of(const Value& value) {
  switch (value.kind) {
    case Value::Kind::text:
      return quoted(value.text);
    case Value::Kind::integer:
      return fmt::format("{:.0f}", value.number);
    case Value::Kind::flag:
      return value.flag ? "true" : "false";
    case Value::Kind::number: {
      const std::string text = fmt::format("{}", value.number);
      return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
    }
    case Value::Kind::list: {
      std::string text = "[";
      for (const Value& item : value.items) text += (text.size() > 1 ? ", " : "") + toml_of(item);
      return text + "]";
    }
    default:
      return "{}";
  }
}

/// Words in lines of about 100 characters, each behind "# ".
std::string comment(std::string_view words) {
  std::string text, line = "#";
  while (!words.empty()) {
    const std::size_t blank = std::min(words.find(' '), words.size());
    if (line.size() + 1 + blank > 110 && line.size() > 1) {
      text += line + "\n";
      line = "#";
    }
    line += " " + std::string(words.substr(0, blank));
    words.remove_prefix(std::min(blank + 1, words.size()));
  }
  return text + line + "\n";
}

std::string with_range(const Key& key) {
  std::string doc = key.doc;
  if (!doc.ends_with('.')) doc += '.';
  if (const auto words = choices_of(key.quantity); !words.empty() && words.size() < 9)
    doc += fmt::format(" One of {}.", fmt::join(words, ", "));
  return doc;
}

/// A default, as TOML.
std::string standard_toml(const Key& key) {
  const bool plain = key.quantity == "flag" || key.quantity == "count" || key.quantity == "ratio";
  return plain ? key.standard : quoted(key.standard);
}

std::vector<Key> keys_of_entry(const Section& section, const Value& table) {
  std::vector<Key> keys;
  for (const Key* key : keys_of(section.name)) keys.push_back(*key);
  const Value* law = table.find("law");
  if (section.name == "material" && law)
    if (const LawDescription* known = find_soil_law(law->text))
      for (const Parameter& parameter : known->parameters) keys.push_back(law_key(parameter));
  return keys;
}

/// `explain`: with the schema's words and the keys that are absent; else only what is there.
std::string section_text(const Section& section, const Value& table, bool explain) {
  const std::string name(section.name);
  std::string text = explain ? "\n" + comment(section.doc) : "\n";
  text += section.list ? "[[" + name + "]]\n" : "[" + name + "]\n";
  for (const Key& key : keys_of_entry(section, table)) {
    const Value* value = table.find(key.name);
    if (!value && !explain) continue;
    if (explain) text += comment(with_range(key));
    if (value)
      text += fmt::format("{} = {}\n", key.name, toml_of(*value));
    else if (!key.standard.empty())
      text += fmt::format("#{} = {}\n", key.name, standard_toml(key));
    else
      text += fmt::format("#{} = {}\n", key.name, key.example.empty() ? "…" : key.example);
  }
  return text;
}

std::string document_text(const Value& document) {
  std::string text =
      "# A Polder case. Keys that begin with '#' have their defaults or are examples; docs/case-file.md has all of "
      "them.\n"
      "# polder check THIS-FILE says whether it is right; polder run THIS-FILE computes it.\n";
  for (const Section& section : case_sections()) {
    const Value* value = document.find(section.name);
    if (value && value->kind == Value::Kind::table) text += section_text(section, *value, true);
    if (value && value->kind == Value::Kind::list)
      for (const Value& entry : value->items) text += section_text(section, entry, &entry == value->items.data());
  }
  return text;
}

void move_files(const std::string& section, Value& entry, const std::string& folder) {
  for (Member& key : entry.members) {
    const Key* known = find_key(section, key.name);
    const bool table = known && known->quantity.starts_with("table of ") && key.value.text.ends_with(".csv");
    if (!table && !(known && known->quantity == "file")) continue;
    const fs::path file = fs::absolute(fs::path(key.value.place.file).parent_path() / key.value.text);
    key.value.text = file.lexically_normal().lexically_proximate(fs::absolute(folder).lexically_normal()).string();
  }
}

void move_files(Value& document, const std::string& folder) {
  for (Member& member : document.members) {
    for (Value& entry : member.value.items) move_files(member.name, entry, folder);
    move_files(member.name, member.value, folder);
  }
}

}  // namespace

std::string new_case() {
  Diagnostics none;
  return document_text(read_document(starter, "starter", none));
}

std::string new_case_from(const std::string& path, const std::string& folder, Diagnostics& diagnostics) {
  Value document = load_document(path, {}, diagnostics);
  move_files(document, folder);
  return document_text(document);
}

}  // namespace polder
