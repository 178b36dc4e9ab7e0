#pragma once
// What a case is held against: the [[compare]] and [[show]] entries of its expected.toml, answered from one run.
//
//   [[compare]]
//   quantity  = "settlement of the crest"   # words
//   at        = "14 s"                      # where and when, words
//   monitor   = "crest settlement"          # column of history.csv, or
//   result    = "run-out"                   # residual crest height, run-out, largest displacement (at the end)
//   time      = "14 s"                      # a monitor's value then; without it, at the end
//   largest   = true                        # a monitor's largest value until then instead (smallest likewise)
//   reaches   = 0.1                         # the time at which a monitor first reaches this value (SI), s
//   reference = 0.172                       # SI, as history.csv
//   tolerance = 0.02                        # in the same unit
//   source    = "…"
//
// A [[show]] has a reference in words and no tolerance: it is printed beside what was computed and not judged. An entry
// that names neither monitor nor result takes more than one run; a report says so and does not judge it either.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "polder/report/soil_shape.hpp"
#include "polder/result/history.hpp"

namespace polder {

struct Expectation {
  std::string quantity, at, source;
  std::string monitor, result;  ///< at most one of them
  std::optional<double> time;   ///< s
  enum class Take { value, largest, smallest, time_of } take = Take::value;
  double reaches = 0;               ///< SI, for `time_of`
  std::optional<double> reference;  ///< SI; absent: `words`
  std::string words;
  double tolerance = 0;  ///< SI, absolute
};

/// Empty where the file does not exist. Other tables ([[stability]]) are left to those who know them. Throws
/// std::runtime_error with file and line where an entry cannot be read.
std::vector<Expectation> read_expectations(const std::filesystem::path& file);

enum class Verdict { within, outside, shown, other_runs, not_reached };

struct Comparison {
  Expectation expected;
  std::string unit;                ///< SI unit of the computed value
  std::optional<double> computed;  ///< absent: see the verdict
  Verdict verdict = Verdict::other_runs;
};

/// `first` and `last` are the soil's shapes at the ends of the run; a run that was stopped before its history began has
/// reached nothing. Throws std::runtime_error where an entry names a
/// monitor or a result that there is none of.
std::vector<Comparison> compare(const std::vector<Expectation>& expectations, const History& history,
                                const SoilShape& first, const SoilShape& last);

}  // namespace polder
