#pragma once
// A study as data: one case, computed for several values of some of its keys.
//
//   title = "Overtopping: cohesion"
//   case  = "overtopping"            # a shipped case, or a path that counts from this file's folder
//   set   = ["stage.overtopping.duration=2 s"]          # for all members (optional)
//
//   [[vary]]                         # several [[vary]] make every combination
//   key    = "material.sand.cohesion"
//   label  = "c"                     # in names, tables and legends; left out: the last part of the key
//   values = ["0 kPa", "5 kPa"]      # a list, or a range:
//   from = "0 kPa", to = "10 kPa", count = 3
//
//   [[vary]]                         # or a table: several keys at once, a row for each member
//   keys = ["model.cell", "numerics.cfl"]
//   rows = [["0.01 m", 0.8], ["0.005 m", 0.8]]
//
//   [[measure]]                      # a column of the table; words as in a case's expected.toml
//   name    = "eroded area at 1.4 s"
//   monitor = "eroded area"          # column of history.csv; time, largest, smallest, reaches as there
//   time    = "1.4 s"
//   trend   = "falls"                # what it must do along the members ("rises", "falls"); optional
//   within  = 0.15                   # or: all members agree so well with the last, as a share of it; optional
//
//   [[curve]]                        # a chart with the column of every member over time
//   monitor = "eroded area"
//
//   [profiles]                       # a chart with the soil's surface of every member, one for each time
//   times = ["1.4 s", "3 s"]
//   span  = ["4.3 m", "5.6 m"]       # of x; left out: all
//   water = true                     # the water's surface, too
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polder/report/expected.hpp"

namespace polder::study {

struct Member {
  std::string name;                    ///< "c = 5 kPa"
  std::vector<std::string> values;     ///< one per column of Study::labels, as written
  std::vector<std::string> overrides;  ///< as of --set
  std::string folder;                  ///< name of its folder: letters, digits, '.', '-', '_'
};

enum class Trend { none, rises, falls };

struct Measure {
  Expectation what;  ///< monitor or result, and when
  Trend trend = Trend::none;
  std::optional<double> within;  ///< share of the last member's value
};

struct Profiles {
  std::vector<double> times;  ///< s
  std::optional<std::array<double, 2>> span;
  bool water = false;
};

struct Study {
  std::string name, title, note;
  std::string case_name;  ///< shipped, or a path
  std::vector<std::string> labels;
  std::vector<Member> members;
  std::vector<Measure> measures;
  std::vector<std::string> curves;  ///< columns of history.csv
  Profiles profiles;
};

/// Throws std::runtime_error with file and line, and the remedy, where an entry is wrong.
Study read_study(const std::filesystem::path& file);

/// The file that the user means by STUDY: a file, or the name of a shipped study (cases/studies/NAME.toml). Nothing if
/// there is none.
std::optional<std::filesystem::path> find_study(const std::string& name_or_path);

/// Names of the shipped studies, sorted.
std::vector<std::string> shipped_studies();

}  // namespace polder::study
