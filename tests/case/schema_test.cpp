// Every key of the schema, of the sections and of the soil laws, against every way of getting it wrong.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "polder/case/document.hpp"
#include "polder/case/estimate.hpp"
#include "polder/case/model_json.hpp"
#include "polder/case/reader.hpp"
#include "polder/case/schema.hpp"
#include "polder/case/schema_pages.hpp"
#include "polder/math/units.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;
using namespace case_file;

const fs::path source = POLDER_SOURCE_DIR;
const std::string sound = (source / "tests/case/golden/sound.toml").string();

std::string contents(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A key, the name that messages give it, and the overrides that make its section sound but for it.
struct Subject {
  Key key;
  std::string path;
  std::vector<std::string> context;
};

std::vector<Subject> subjects() {
  std::vector<Subject> list;
  for (const Key& key : case_keys()) {
    const auto section = std::find_if(case_sections().begin(), case_sections().end(),
                                      [&](const Section& s) { return s.name == key.section; });
    std::string entry = key.section;
    static const std::map<std::string, std::string> names = {
        {"material", "sand"}, {"soil", "bed"},   {"free_water", "pond"}, {"boundary", "floor"},
        {"wall", "screen"},   {"stage", "rest"}, {"monitor", "middle"},  {"strength", "1"},
        {"head_line", "1"},   {"load", "1"},     {"retention", "1"},     {"seepage_boundary", "1"},
        {"change", "1"},      {"well", "1"},     {"rain", "1"},          {"refine", "1"},
        {"dike_check", "1"},  {"line_load", "1"}};
    if (section->list) entry += "." + (key.name == "name" ? "1" : names.at(key.section));
    list.push_back({key, entry + "." + key.name, {}});
  }
  for (const LawDescription& law : soil_laws()) {
    std::vector<std::string> context{"material.sand.law=" + std::string(law.name)};
    for (const Parameter& p : law.parameters)
      if (p.required) {
        const double middle = std::isfinite(p.high) ? 0.5 * (p.low + p.high) : std::max(p.low, 1.0);
        context.push_back(
            "material.sand." + std::string(p.key) + "=" +
            (p.quantity == "angle" ? show_measure(middle, *find_quantity("angle")) : std::to_string(middle)));
      }
    for (const Parameter& p : law.parameters)
      list.push_back({law_key(p), "material.sand." + std::string(p.key), context});
  }
  return list;
}

Diagnostics with(const Subject& subject, const std::string& value) {
  std::vector<std::string> overrides = subject.context;
  overrides.push_back(subject.path + "=" + value);
  return read_case(sound, overrides).diagnostics;
}

/// The first error about the key, in its section.
const Diagnostic* about(const Diagnostics& diagnostics, const Subject& subject) {
  const std::string end = "." + subject.key.name, begin = subject.key.section;
  for (const Diagnostic& d : diagnostics)
    if (d.severity == Severity::error && d.key.starts_with(begin) && d.key.ends_with(end)) return &d;
  return nullptr;
}

TEST(Schema, HasASoundExampleCase) {
  const ReadResult result = read_case(sound);
  EXPECT_TRUE(result.diagnostics.empty()) << format(result.diagnostics);
}

TEST(Schema, NamesEachKeyOnceWithDocumentation) {
  std::set<std::string> names;
  for (const Key& key : case_keys()) {
    EXPECT_TRUE(names.insert(key.section + "." + key.name).second) << key.section << "." << key.name;
    EXPECT_FALSE(key.doc.empty() || key.example.empty()) << key.name;
    EXPECT_FALSE(key.required && !key.standard.empty()) << key.name;
    EXPECT_TRUE(std::any_of(case_sections().begin(), case_sections().end(),
                            [&](const Section& s) { return s.name == key.section; }));
  }
  for (const LawDescription& law : soil_laws())
    for (const Parameter& p : law.parameters) {
      EXPECT_FALSE(find_key("material", p.key)) << law.name << ": " << p.key << " is a key of the section itself";
      EXPECT_TRUE(find_quantity(p.quantity) || !choices_of(p.quantity).empty()) << law.name << ": " << p.quantity;
    }
}

TEST(Schema, AcceptsTheExampleOfEveryKey) {
  for (const Subject& s : subjects()) {
    if (s.key.example.empty()) continue;
    const Diagnostics diagnostics = with(s, s.key.example);
    const Diagnostic* error = about(diagnostics, s);
    // Values that are sound by themselves but clash with the rest of this case are told apart by their message.
    for (const char* wrong : {"is not known here", "out of range", "needed", "no unit", "cannot be a name", "points"})
      EXPECT_FALSE(error && error->message.find(wrong) != std::string::npos) << s.path << ": " << error->message;
  }
}

TEST(Schema, RefusesAWrongType) {
  for (const Subject& s : subjects()) {
    const Diagnostics diagnostics = with(s, s.key.quantity == "flag" ? "1" : "true");
    const Diagnostic* error = about(diagnostics, s);
    ASSERT_TRUE(error) << s.path;
    EXPECT_NE(error->message.find("needed"), std::string::npos) << s.path << ": " << error->message;
    EXPECT_FALSE(error->help.empty()) << s.path;
    EXPECT_EQ(error->place.file, "--set");
  }
}

TEST(Schema, RefusesAWrongUnitWithAnExampleOfTheRightOne) {
  for (const Subject& s : subjects()) {
    const std::string of =
        s.key.quantity.substr(s.key.quantity.find(" of ") == std::string::npos ? 0 : s.key.quantity.find(" of ") + 4);
    const Quantity* quantity = find_quantity(of);
    if (!quantity) continue;
    const Diagnostics diagnostics = with(s, "1 kg");
    const Diagnostic* error = about(diagnostics, s);
    ASSERT_TRUE(error) << s.path;
    EXPECT_NE(error->message.find("is a mass; " + std::string(quantity->article)), std::string::npos) << error->message;
    EXPECT_NE(error->help.find(quantity->example), std::string::npos) << error->help;
  }
}

TEST(Schema, RefusesWhatIsOutOfRange) {
  const auto written = [](const Key& key, double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    const auto table = table_kind(key.quantity);
    if (table && !table->by_time()) return "[[0, " + text.str() + "]]";
    return key.quantity == "angle" ? text.str() + " rad" : text.str();
  };
  for (const Subject& s : subjects()) {
    std::vector<std::string> values;
    if (std::isfinite(s.key.low))
      values.push_back(written(s.key, std::floor(s.key.low - std::max(1.0, std::abs(s.key.low)))));
    if (std::isfinite(s.key.high)) values.push_back(written(s.key, std::ceil(2 * std::abs(s.key.high) + 1)));
    if (s.key.quantity.starts_with("choice:")) values.push_back("nonsense");
    for (const std::string& value : values) {
      const Diagnostics diagnostics = with(s, value);
      const Diagnostic* error = about(diagnostics, s);
      ASSERT_TRUE(error) << s.path << " = " << value;
      if (s.key.quantity.starts_with("choice:"))
        for (const std::string& word : choices_of(s.key.quantity))
          EXPECT_NE(error->help.find(word), std::string::npos) << error->help;
      else
        EXPECT_NE((error->message + error->help).find(range_of(s.key)), std::string::npos)
            << s.path << ": " << format(*error);
    }
  }
}

TEST(Schema, RefusesAnglesThatArePlainNumbers) {
  int angles = 0;
  for (const Subject& s : subjects()) {
    if (s.key.quantity != "angle") continue;
    ++angles;
    const Diagnostics diagnostics = with(s, "35");
    const Diagnostic* error = about(diagnostics, s);
    ASSERT_TRUE(error) << s.path;
    EXPECT_NE(error->help.find("\"35 deg\""), std::string::npos) << error->help;
  }
  EXPECT_GE(angles, 2);
}

TEST(Schema, FindsTheNearestKeyOfAMisspeltOne) {
  for (const Subject& s : subjects()) {
    if (s.key.name.size() < 4) continue;
    std::string path = s.path;
    path.erase(path.size() - 2, 1);  // one letter is missing
    std::vector<std::string> overrides = s.context;
    overrides.push_back(path + "=1");
    const Diagnostics diagnostics = read_case(sound, overrides).diagnostics;
    const auto unknown = std::find_if(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& d) {
      return d.message == "unknown key" && d.key.ends_with(path.substr(path.rfind('.')));
    });
    ASSERT_NE(unknown, diagnostics.end()) << path << "\n" << format(diagnostics);
    EXPECT_EQ(unknown->help, "did you mean \"" + s.key.name + "\"?") << path;
  }
}

TEST(Schema, ReportsRequiredKeysThatAreMissing) {
  const std::string text = contents(sound);
  int required = 0;
  for (const Key& key : case_keys()) {
    if (!key.required) continue;
    ++required;
    const std::string single = "[" + key.section + "]";
    const std::size_t section = text.find(single), line = text.find("\n" + key.name + " = ", section);
    ASSERT_NE(line, std::string::npos) << key.section << "." << key.name;
    std::string without = text;
    without.erase(line + 1, text.find('\n', line + 1) - line);
    const fs::path file = fs::temp_directory_path() / ("polder-missing-" + std::to_string(getpid()) + ".toml");
    std::ofstream(file) << without;
    const Diagnostics diagnostics = read_case(file.string()).diagnostics;
    fs::remove(file);
    const auto missing = std::find_if(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& d) {
      return d.message == "missing" && d.key.starts_with(key.section + ".") && d.key.ends_with("." + key.name);
    });
    ASSERT_NE(missing, diagnostics.end()) << key.section << "." << key.name << "\n" << format(diagnostics);
    EXPECT_GT(missing->place.line, 0);
    EXPECT_FALSE(missing->help.empty());
  }
  EXPECT_GE(required, 8);
}

TEST(SchemaPages, InTheDocumentationAreCurrent) {
  if (std::getenv("POLDER_RENEW_GOLDEN")) {
    std::ofstream(source / "docs/case-file.md") << case_file_page();
    std::ofstream(source / "docs/case.schema.json") << case_json_schema();
  }
  EXPECT_EQ(contents(source / "docs/case-file.md"), case_file_page())
      << "run: polder schema --docs > docs/case-file.md";
  EXPECT_EQ(contents(source / "docs/case.schema.json"), case_json_schema())
      << "run: polder schema --json > docs/case.schema.json";
}

TEST(SchemaPages, NameEveryKey) {
  const std::string page = case_file_page();
  const auto schema = nlohmann::json::parse(case_json_schema());
  for (const Subject& s : subjects()) {
    EXPECT_NE(page.find("| `" + s.key.name + "` |"), std::string::npos) << s.key.name;
    const auto& section = schema["properties"][s.key.section];
    const auto& table = section.contains("items") ? section["items"] : section;
    EXPECT_TRUE(table["properties"].contains(s.key.name)) << s.path;
  }
}

/// Writes `text` to a file that is gone afterwards, and reads it as a case.
ReadResult read_text(const std::string& text) {
  const fs::path file = fs::temp_directory_path() / ("polder-new-" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << text;
  ReadResult result = read_case(file.string());
  fs::remove(file);
  return result;
}

TEST(NewCase, IsSound) {
  const ReadResult result = read_text(new_case());
  EXPECT_TRUE(result.diagnostics.empty()) << format(result.diagnostics);
}

TEST(NewCase, FromAShippedOneIsTheSameModel) {
  for (const char* name : {"dike-seepage", "dike-paper-darcy", "hydrostatic-3d"}) {
    const std::string file = (source / "cases" / name / "case.toml").string();
    Diagnostics diagnostics;
    const ReadResult copy = read_text(new_case_from(file, ".", diagnostics));
    EXPECT_TRUE(copy.ok()) << format(copy.diagnostics);
    auto original_json = case_json(read_case(file).model), copy_json = case_json(copy.model);
    for (auto* json : {&original_json, &copy_json}) {
      json->erase("file");
      json->erase("name");
    }
    EXPECT_EQ(original_json, copy_json);
  }
}

TEST(CaseJson, SaysWhatTheFileSays) {
  const auto json = case_json(read_case((source / "cases/dike-paper-darcy/case.toml").string()).model);
  EXPECT_EQ(json["material"][0]["drag"], "darcy");
  EXPECT_EQ(json["material"][0]["dilatancy"], "constant");
  EXPECT_EQ(json["boundary"][0]["soil"], "rough");
  EXPECT_EQ(json["boundary"][1]["water"], "open");
  EXPECT_EQ(json["boundary"][4]["side"], "top");
  EXPECT_EQ(json["initial"]["stress"], "none");
  EXPECT_EQ(json["model"]["size"].size(), 2u);
}

TEST(Estimate, OfTheDikeIsItsDrainedPWave) {
  const Model model = read_case((source / "cases/dike-seepage/case.toml").string()).model;
  EXPECT_EQ(cell_count(model), 102u * 24u);
  // M = E (1 − ν) / ((1 + ν)(1 − 2ν)) = 1.0559 MPa, (1 − n) ρs = 1620 kg/m3, c = 25.53 m/s
  EXPECT_NEAR(estimated_step(model), 0.8 * 0.05 / 25.53, 2e-6);
  const StepCount steps = estimated_steps(model);
  EXPECT_NEAR(steps.moving, 24 / estimated_step(model), 1e-6 * steps.moving);
  EXPECT_EQ(steps.at_rest, steps.moving);
}

TEST(Estimate, OfALongEventKnowsThatStepsGrowAtRest) {
  const auto file = (source / "cases/levee-uplift/case.toml").string();
  const Model model = read_case(file, {"numerics.step_stretch=1000", "numerics.mass_scaling=4"}).model;
  const StepCount steps = estimated_steps(model);
  double stretched = 0, whole = 0;  // s, of the stages with the model's own stretch and of all
  for (const Stage& stage : model.stages) {
    EXPECT_FALSE(stage.mass_scaling);
    whole += stage.duration;
    if (!stage.step_stretch) stretched += stage.duration;
  }
  EXPECT_GT(stretched, 0);
  EXPECT_NEAR(steps.moving, whole / (2 * estimated_step(model)), 1e-6 * steps.moving);
  EXPECT_LE(steps.at_rest, (whole - 0.999 * stretched) / (2 * estimated_step(model)) * (1 + 1e-9));
}

}  // namespace
}  // namespace polder
