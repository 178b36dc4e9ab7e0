#include "polder/case/sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polder::case_file {
namespace {

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const Section& section : case_sections()) names.emplace_back(section.name);
  return names;
}

void refuse_unknown_sections(const Value& document, Diagnostics& diagnostics) {
  const auto names = section_names();
  for (const Member& member : document.members) {
    if (std::find(names.begin(), names.end(), member.name) != names.end()) continue;
    std::string help = fmt::format("known: {}", fmt::join(names, ", "));
    if (const std::string near = nearest(member.name, names); !near.empty())
      help = fmt::format("did you mean \"{}\"?", near);
    else
      for (const std::string& section : names)
        if (find_key(section, member.name))
          help = fmt::format("\"{}\" is a key of the section \"{}\"", member.name, section);
    report(diagnostics, member.place, member.name,
           member.value.kind == Value::Kind::table || member.value.kind == Value::Kind::list ? "unknown section"
                                                                                             : "unknown key",
           std::move(help));
  }
}

}  // namespace

std::vector<const Value*> tables_of(const Value& document, const Section& section, Diagnostics& diagnostics) {
  std::vector<const Value*> tables;
  const std::string name(section.name);
  const auto member = std::find_if(document.members.begin(), document.members.end(),
                                   [&](const Member& m) { return m.name == section.name; });
  const std::string form = section.list ? "[[" + name + "]]" : "[" + name + "]";
  if (member == document.members.end()) {
    if (section.required) report(diagnostics, document.place, name, "missing", "add a section " + form);
    return tables;
  }
  const Value& value = member->value;
  const bool is_list =
      value.kind == Value::Kind::list && std::all_of(value.items.begin(), value.items.end(),
                                                     [](const Value& item) { return item.kind == Value::Kind::table; });
  if (section.list ? !is_list : value.kind != Value::Kind::table)
    report(diagnostics, member->place, name, "is not written as a section of this kind", "its heading is " + form);
  else if (section.list)
    for (const Value& item : value.items) tables.push_back(&item);
  else
    tables.push_back(&value);
  if (section.list && is_list && value.items.empty() && section.required)
    report(diagnostics, member->place, name, "is empty", "add a section " + form);
  return tables;
}

std::string path_of_entry(const Section& section, const Value& table, std::size_t index) {
  const Value* name = table.find("name");
  if (name && name->kind == Value::Kind::text && !name->text.empty())
    return fmt::format("{}.{}", section.name, name->text);
  return fmt::format("{}.{}", section.name, index + 1);
}

namespace {

void refuse_duplicate_names(const std::vector<Fields>& entries, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const std::string name = entries[i].text("name"); !name.empty() && name == entries[j].text("name")) {
        report(diagnostics, entries[i].place_of("name"), entries[i].path_of("name"),
               fmt::format("\"{}\" is already the name of the entry in line {}", name, entries[j].place.line),
               "give each entry its own name");
        break;
      }
}

}  // namespace

Fields read_material_section(const Value& table, const std::string& path, const LawDescription*& law,
                             Diagnostics& diagnostics) {
  std::vector<const Key*> keys = keys_of("material");
  const Value* name = table.find("law");
  law = name && name->kind == Value::Kind::text ? find_soil_law(name->text) : nullptr;
  std::vector<Key> own;
  std::set<std::string> ignored;
  for (const LawDescription& known : soil_laws())
    for (const Parameter& parameter : known.parameters) {
      if (&known == law)
        own.push_back(law_key(parameter));
      else if (const Value* given = table.find(parameter.key); !law || (given && given->place.file != name->place.file))
        ignored.emplace(parameter.key);
    }
  for (const Key& key : own) ignored.erase(key.name);
  for (const Key& key : own) keys.push_back(&key);
  if (!law && name && name->kind == Value::Kind::text) {
    std::vector<std::string> laws;
    for (const LawDescription& known : soil_laws()) laws.emplace_back(known.name);
    const std::string near = nearest(name->text, laws);
    report(diagnostics, name->place, path + ".law", fmt::format("there is no soil law \"{}\"", name->text),
           near.empty() ? fmt::format("known: {}", fmt::join(laws, ", "))
                        : fmt::format("did you mean \"{}\"? Known: {}", near, fmt::join(laws, ", ")));
  }
  return read_fields(table, keys, path, diagnostics, ignored);
}

void need(const Fields& fields, std::string_view key, Diagnostics& diagnostics) {
  if (!fields.is_given(key))
    report(diagnostics, fields.place, fields.path_of(key), "missing", fmt::format("give {} its {}", fields.path, key));
}

std::string known_material(const Fields& fields, std::string_view key, const Model& model, Diagnostics& diagnostics) {
  std::string name = fields.text(key);
  const bool known = std::any_of(model.materials.begin(), model.materials.end(),
                                 [&](const MaterialInput& m) { return m.name == name; });
  if (!known && !name.empty())
    report(diagnostics, fields.place_of(key), fields.path_of(key), fmt::format("there is no material \"{}\"", name),
           "name one of the [[material]] sections");
  return name;
}

std::string material_named(const Fields& fields, const Model& model, Diagnostics& diagnostics) {
  need(fields, "material", diagnostics);
  return known_material(fields, "material", model, diagnostics);
}

Sections read_sections(const Value& document, Diagnostics& diagnostics) {
  Sections sections;
  refuse_unknown_sections(document, diagnostics);
  for (const Section& section : case_sections()) {
    const auto tables = tables_of(document, section, diagnostics);
    const auto one = [&]() {
      Value absent;
      absent.place = document.place;
      if (tables.empty() && section.required) return Fields{std::string(section.name), document.place, {}, {}};
      return read_fields(tables.empty() ? absent : *tables.front(), keys_of(section.name), std::string(section.name),
                         diagnostics);
    };
    const auto all = [&]() {
      std::vector<Fields> entries;
      for (std::size_t i = 0; i < tables.size(); ++i)
        entries.push_back(
            read_fields(*tables[i], keys_of(section.name), path_of_entry(section, *tables[i], i), diagnostics));
      refuse_duplicate_names(entries, diagnostics);
      return entries;
    };
    if (section.name == "model") sections.model = one();
    if (section.name == "refine") sections.refinements = all();
    if (section.name == "water") sections.water = one();
    if (section.name == "initial") sections.initial = one();
    if (section.name == "output") sections.output = one();
    if (section.name == "numerics") sections.numerics = one();
    if (section.name == "soil") sections.soils = all();
    if (section.name == "free_water") sections.free_water = all();
    if (section.name == "boundary") sections.boundaries = all();
    if (section.name == "wall") sections.walls = all();
    if (section.name == "stage") sections.stages = all();
    if (section.name == "monitor") sections.monitors = all();
    if (section.name == "stability") sections.stability = one();
    if (section.name == "strength") sections.strengths = all();
    if (section.name == "head_line") sections.head_lines = all();
    if (section.name == "line_load") sections.line_loads = all();
    if (section.name == "load") sections.loads = all();
    if (section.name == "change") sections.changes = all();
    if (section.name == "well") sections.wells = all();
    if (section.name == "rain") sections.rains = all();
    if (section.name == "dike_check") sections.dike_checks = all();
    if (section.name == "seepage") sections.seepage = one();
    if (section.name == "retention") sections.retentions = all();
    if (section.name == "seepage_boundary") sections.seepage_boundaries = all();
    if (section.name == "material") {
      for (std::size_t i = 0; i < tables.size(); ++i) {
        const LawDescription* law = nullptr;
        sections.materials.push_back(
            read_material_section(*tables[i], path_of_entry(section, *tables[i], i), law, diagnostics));
        sections.laws.push_back(law);
      }
      refuse_duplicate_names(sections.materials, diagnostics);
    }
  }
  return sections;
}

}  // namespace polder::case_file
