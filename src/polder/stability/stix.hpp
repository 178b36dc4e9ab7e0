#pragma once
// D-Stability models: a .stix file is a zip of JSON files. Stages (geometry, soils, water nets, states, loads) become
// sections; calculations keep their slip surface or search area, and the factor of safety that is stored with them.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "polder/stability/section.hpp"

namespace polder::stability {

struct StixCalculation {
  std::string label;
  std::string analysis;  ///< "Bishop", "BishopBruteForce", "Spencer", "SpencerGenetic", "UpliftVan", …
  std::string stage;     ///< label of the stage that it computes
  bool design = false;   ///< with characteristic values of the soils that have scatter
  Section section;
  std::optional<double> stored_factor;
  /// The stored critical surface, else the one that the settings give.
  std::optional<Circle> circle;
  std::optional<UpliftVanPlane> plane;
  Line surface;
  std::optional<CircleGrid> grid;  ///< search settings
  std::optional<UpliftVanArea> area;
  std::optional<FreeSurfaceBand> band;
};

struct StixModel {
  std::vector<StixCalculation> calculations;
  std::vector<std::string> notes;  ///< what was left out, and where
};

/// Throws std::invalid_argument where the file is no D-Stability model.
StixModel read_stix(const std::filesystem::path& file);

/// The same from the files of the archive by their names; `name` stands for it in messages.
StixModel read_stix_files(const std::map<std::string, std::string>& members, const std::string& name);

}  // namespace polder::stability
