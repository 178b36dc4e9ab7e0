#include "polder/case/element_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "polder/case/sections.hpp"

namespace polder {

using namespace case_file;
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const Section material_section{"material", true, true, ""};
const Section test_section{"test", true, false, ""};

ElementMaterial read_material(const Fields& f, const LawDescription* law, Diagnostics& diagnostics) {
  ElementMaterial material;
  material.name = f.text("name");
  material.law = law;
  material.max_porosity = f.number("max_porosity", material.max_porosity);
  if (f.is_given("porosity")) {
    material.porosity = f.number("porosity", material.porosity);
  } else if (f.is_given("void_ratio")) {
    const double e = f.number("void_ratio", 1);
    material.porosity = e / (1 + e);
  } else {
    MaterialInput phases;
    phases.max_porosity = material.max_porosity;
    settle_phases(f, WaterProperties{}, phases, diagnostics);
    material.porosity = phases.porosity;
  }
  if (!law) return material;
  for (const Parameter& p : law->parameters) material.law_parameters.push_back(f.number(p.key, p.standard));
  const bool all_read = std::all_of(law->parameters.begin(), law->parameters.end(), [&](const Parameter& p) {
    return f.find(p.key) || (!f.is_given(p.key) && !p.required);
  });
  if (law->check && all_read)
    for (const Complaint& c : law->check(material.law_parameters, {0, material.porosity, material.max_porosity}))
      report(diagnostics, f.place_of(c.key), f.path_of(c.key), c.message);
  return material;
}

ElementPath read_path(const Fields& f, Diagnostics& diagnostics) {
  ElementPath path;
  if (const Entry* type = f.find("type")) path.test = element_test_from_name(type->text);
  path.vertical_stress = f.number("vertical_stress", path.vertical_stress);
  path.stress_ratio = f.number("stress_ratio", path.stress_ratio);
  path.strain = f.number("strain", path.strain);
  path.steps = static_cast<int>(f.number("steps", path.steps));
  if (const Entry* loads = f.find("loads")) path.loads = loads->numbers;
  const bool oedometer = path.test == ElementTest::oedometer;
  if (oedometer && path.loads.empty() && !f.is_given("loads"))
    report(diagnostics, f.place, f.path_of("loads"), "missing",
           "an oedometer test needs the vertical stresses to reach, such as loads = [\"400 kPa\", \"50 kPa\"]");
  if (!oedometer && f.is_given("loads"))
    report(diagnostics, f.place_of("loads"), f.path_of("loads"), "belongs to an oedometer test",
           "a test of this type is driven by its strain");
  return path;
}

/// The materials that a test runs on.
std::vector<int> materials_of(const Fields& f, const std::vector<ElementMaterial>& materials,
                              Diagnostics& diagnostics) {
  std::vector<int> chosen;
  const std::string wanted = f.text("material");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    names.push_back(materials[i].name);
    if (wanted.empty() || wanted == materials[i].name) chosen.push_back(static_cast<int>(i));
  }
  if (chosen.empty() && !wanted.empty()) {
    report(diagnostics, f.place_of("material"), f.path_of("material"),
           fmt::format("there is no material \"{}\"", wanted), suggestion(wanted, names));
  }
  return chosen;
}

std::vector<ElementRun> standard_runs(int material) {
  std::vector<ElementRun> runs;
  const auto add = [&](ElementTest test, double strain) {
    ElementPath path;
    path.test = test;
    path.strain = strain;
    runs.push_back({std::string(element_test_name(test)), material, path});
  };
  add(ElementTest::oedometer, 0);
  runs.back().path.vertical_stress = 10e3;
  runs.back().path.loads = {100e3, 400e3, 100e3};
  add(ElementTest::triaxial_drained, 0.2);
  add(ElementTest::triaxial_undrained, 0.1);
  add(ElementTest::simple_shear, 0.2);
  add(ElementTest::simple_shear_undrained, 0.2);
  return runs;
}

void refuse_unknown_sections(const Value& document, Diagnostics& diagnostics) {
  std::vector<std::string> names{"test"};
  for (const Section& section : case_sections()) names.emplace_back(section.name);
  for (const Member& member : document.members)
    if (std::find(names.begin(), names.end(), member.name) == names.end()) {
      const std::string near = nearest(member.name, names);
      report(diagnostics, member.place, member.name, "unknown section",
             near.empty() ? "a file for element tests has [[material]] and [[test]]"
                          : fmt::format("did you mean \"{}\"?", near));
    }
}

}  // namespace

const std::vector<Key>& element_test_keys() {
  static const std::vector<Key> keys = {
      {"test", "name", "", "name", false, "", -infinity, infinity, R"("CD 100 kPa")", "Heads its results."},
      {"test", "material", "", "name", false, "", -infinity, infinity, R"("sand")",
       "Name of a `[[material]]`; left out: all of them."},
      {"test", "type", "", "choice:oedometer|triaxial-drained|triaxial-undrained|simple-shear|simple-shear-undrained",
       true, "", -infinity, infinity, R"("triaxial-drained")", "Which laboratory test."},
      {"test", "vertical_stress", "σ'_v0", "pressure", false, "100 kPa", 0, 1e9, R"("100 kPa")",
       "Effective vertical stress at the start."},
      {"test", "stress_ratio", "K", "ratio", false, "1", 0, 20, "1",
       "Lateral over vertical effective stress at the start."},
      {"test", "strain", "ε", "ratio", false, "0.2", -10, 10, R"("20 %")",
       "Axial strain at the end (negative: extension); in simple shear γ."},
      {"test", "loads", "σ'_v", "list of pressure", false, "", 0, 1e9, R"(["400 kPa", "50 kPa"])",
       "Vertical stresses of the oedometer, one after the other."},
      {"test", "steps", "", "count", false, "500", 1, 1e6, "500", "Steps of the path; of each load in the oedometer."},
  };
  return keys;
}

ElementInput read_element_file(const std::string& path, const std::vector<std::string>& overrides) {
  ElementInput input;
  Diagnostics& diagnostics = input.diagnostics;
  const Value document = load_document(path, overrides, diagnostics);
  if (has_errors(diagnostics)) return input;
  refuse_unknown_sections(document, diagnostics);

  const auto materials = tables_of(document, material_section, diagnostics);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const LawDescription* law = nullptr;
    const Fields f =
        read_material_section(*materials[i], path_of_entry(material_section, *materials[i], i), law, diagnostics);
    input.materials.push_back(read_material(f, law, diagnostics));
  }

  std::vector<const Key*> keys;
  for (const Key& key : element_test_keys()) keys.push_back(&key);
  const auto tests = tables_of(document, test_section, diagnostics);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const Fields f = read_fields(*tests[i], keys, path_of_entry(test_section, *tests[i], i), diagnostics);
    const ElementPath element = read_path(f, diagnostics);
    const std::string name = f.text("name").empty() ? f.text("type") : f.text("name");
    for (const int material : materials_of(f, input.materials, diagnostics))
      input.runs.push_back({name, material, element});
  }
  if (tests.empty())
    for (std::size_t i = 0; i < input.materials.size(); ++i)
      for (ElementRun& run : standard_runs(static_cast<int>(i))) input.runs.push_back(std::move(run));
  sort_by_place(diagnostics);
  return input;
}

}  // namespace polder
