#include "polder/stability/stix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "polder/stability/stix_stage.hpp"
#include "polder/stability/zip_archive.hpp"

namespace polder::stability {
namespace {

std::string id_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

StixFiles parse(const std::map<std::string, std::string>& members, const std::string& archive,
                std::vector<Json>& scenarios) {
  StixFiles files;
  for (const auto& [name, text] : members) {
    if (!name.ends_with(".json")) continue;
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) throw std::invalid_argument(fmt::format("{}: '{}' is not JSON", archive, name));
    const std::string folder = name.substr(0, name.find('/'));
    if (name == "soils.json")
      files.soils = std::move(json);
    else if (folder == "scenarios")
      scenarios.push_back(std::move(json));
    else if (const std::string id = json.is_object() ? id_of(json, "Id") : ""; !id.empty())
      files.by_folder[folder][id] = std::move(json);
  }
  if (files.soils.is_null() || scenarios.empty())
    throw std::invalid_argument(fmt::format("{}: is not a D-Stability model: {} is missing in it", archive,
                                            scenarios.empty() ? "scenarios/" : "soils.json"));
  return files;
}

// The calculation's own stage where one has its name (files from versions that computed every stage), else the last.
std::size_t stage_of(const Json& stages, const std::string& label) {
  for (std::size_t i = 0; i < stages.size(); ++i)
    if (id_of(stages[i], "Label") == label) return i;
  return stages.size() - 1;
}

Box box(const Json& area) {
  const Point top_left = stix_point(area.at("TopLeft"));
  return {{top_left[0], top_left[1] - stix_number(area, "Height")},
          {top_left[0] + stix_number(area, "Width"), top_left[1]}};
}

void read_limits(const Json& constraints, SlipLimits& limits, bool& zones) {
  const auto on = [&](const char* key) {
    const auto found = constraints.find(key);
    return found != constraints.end() && found->is_boolean() && found->get<bool>();
  };
  if (on("IsSizeConstraintsEnabled")) {
    limits.minimum_depth = stix_number(constraints, "MinimumSlipPlaneDepth");
    limits.minimum_length = stix_number(constraints, "MinimumSlipPlaneLength");
  }
  const auto zone = [&](const char* enabled, const char* left, const char* width, std::optional<Range>& range) {
    const double span = stix_number(constraints, width);
    if (!on(enabled) || span <= 0) return;
    range = Range{stix_number(constraints, left), stix_number(constraints, left) + span};
    zones = true;
  };
  zone("IsZoneAConstraintsEnabled", "XLeftZoneA", "WidthZoneA", limits.entry);
  zone("IsZoneBConstraintsEnabled", "XLeftZoneB", "WidthZoneB", limits.exit);
}

void read_settings(const Json& settings, StixCalculation& calculation) {
  calculation.analysis = id_of(settings, "AnalysisType");
  calculation.design = id_of(settings, "CalculationType") == "Design";
  const auto found = settings.find(calculation.analysis);
  if (found == settings.end() || !found->is_object()) return;
  const Json& own = *found;
  if (const auto circle = own.find("Circle"); circle != own.end())
    calculation.circle = Circle{stix_point(circle->at("Center")), stix_number(*circle, "Radius")};
  if (const auto grid = own.find("SearchGrid"); grid != own.end()) {
    const Json& tangents = own.at("TangentLines");
    const double space = stix_number(*grid, "Space", 1);
    calculation.grid = CircleGrid{stix_point(grid->at("BottomLeft")),
                                  space,
                                  space,
                                  static_cast<int>(stix_number(*grid, "NumberOfPointsInX")),
                                  static_cast<int>(stix_number(*grid, "NumberOfPointsInZ")),
                                  stix_number(tangents, "BottomTangentLineZ"),
                                  stix_number(tangents, "Space", 1),
                                  static_cast<int>(stix_number(tangents, "NumberOfTangentLines"))};
  }
  if (const auto plane = own.find("SlipPlane"); plane != own.end()) {
    if (plane->is_array()) calculation.surface = stix_points(*plane);
    if (plane->is_object() && plane->contains("FirstCircleCenter")) {
      const Point first = stix_point(plane->at("FirstCircleCenter"));
      calculation.plane = UpliftVanPlane{first, stix_point(plane->at("SecondCircleCenter")),
                                         first[1] - stix_number(*plane, "FirstCircleRadius")};
    }
  }
  if (own.contains("SlipPlaneA") && own.contains("SlipPlaneB"))
    calculation.band = FreeSurfaceBand{stix_points(own.at("SlipPlaneB")), stix_points(own.at("SlipPlaneA"))};
  if (own.contains("SearchAreaA") && own.contains("SearchAreaB")) {
    const Json& tangent = own.at("TangentArea");
    const double top = stix_number(tangent, "TopZ");
    calculation.area = UpliftVanArea{
        box(own.at("SearchAreaA")), box(own.at("SearchAreaB")), {top - stix_number(tangent, "Height"), top}};
  }
  if (const auto constraints = own.find("SlipPlaneConstraints"); constraints != own.end()) {
    bool zones = false;
    read_limits(*constraints, calculation.section.limits, zones);
  }
}

// Results are the folders' files with the calculation's result id; the stored surface replaces that of the settings.
void read_result(const StixFiles& files, const std::string& id, StixCalculation& calculation) {
  const auto results = files.by_folder.find("results");
  if (results == files.by_folder.end()) return;
  const auto found = results->second.find(id);
  if (found == results->second.end()) return;
  const Json& result = found->second;
  if (result.contains("FactorOfSafety") && result.at("FactorOfSafety").is_number())
    calculation.stored_factor = result.at("FactorOfSafety").get<double>();
  if (result.contains("Circle"))
    calculation.circle =
        Circle{stix_point(result.at("Circle").at("Center")), stix_number(result.at("Circle"), "Radius")};
  if (result.contains("SlipPlane")) calculation.surface = stix_points(result.at("SlipPlane"));
  if (result.contains("TangentLine"))
    calculation.plane = UpliftVanPlane{stix_point(result.at("LeftCenter")), stix_point(result.at("RightCenter")),
                                       stix_number(result, "TangentLine")};
}

StixModel model_of(const std::map<std::string, std::string>& members, const std::string& name) {
  StixModel model;
  std::vector<Json> scenarios;
  const StixFiles files = parse(members, name, scenarios);
  for (const Json& scenario : scenarios) {
    const auto stages = scenario.find("Stages"), calculations = scenario.find("Calculations");
    if (stages == scenario.end() || stages->empty() || calculations == scenario.end()) continue;
    for (const Json& entry : *calculations) {
      StixCalculation calculation;
      calculation.label = id_of(entry, "Label");
      read_settings(files.get("calculationsettings", id_of(entry, "CalculationSettingsId")), calculation);
      read_result(files, id_of(entry, "ResultId"), calculation);
      const std::size_t at = stage_of(*stages, calculation.label);
      calculation.stage = id_of((*stages)[at], "Label");
      SlipLimits limits = calculation.section.limits;
      calculation.section = read_stage(files, (*stages)[at], calculation.design, model.notes);
      limits.forbidden_lines = calculation.section.limits.forbidden_lines;
      calculation.section.limits = limits;
      // Preconsolidation is measured in the last stage, up to this one, that states it.
      for (std::size_t i = at + 1; i-- > 0;) {
        if (!has_states(files, (*stages)[i])) continue;
        read_states(files, (*stages)[i], calculation.design, calculation.section);
        if (i != at) calculation.section.before = {read_stage(files, (*stages)[i], calculation.design, model.notes)};
        break;
      }
      model.calculations.push_back(std::move(calculation));
    }
  }
  std::sort(model.notes.begin(), model.notes.end());
  model.notes.erase(std::unique(model.notes.begin(), model.notes.end()), model.notes.end());
  return model;
}

}  // namespace

StixModel read_stix_files(const std::map<std::string, std::string>& members, const std::string& name) {
  try {
    return model_of(members, name);
  } catch (const Json::exception& error) {  // something is not of the kind that it has in such models
    throw std::invalid_argument(fmt::format("{}: is not a D-Stability model: {}", name, error.what()));
  }
}

StixModel read_stix(const std::filesystem::path& file) { return read_stix_files(read_zip(file), file.string()); }

}  // namespace polder::stability
