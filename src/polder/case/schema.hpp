#pragma once
// The one table of everything a case file may say. Parsing, checking, docs/case-file.md, docs/case.schema.json and the
// comments of `polder new` are made from it, and from the tables of the soil laws.
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polder/material/law.hpp"
#include "polder/math/units.hpp"

/// What reading a case file needs inside this room; other rooms see the model, the reader and its diagnostics.
namespace polder::case_file {

struct Section {
  std::string_view name;
  bool list;      ///< written `[[name]]`, any number of times
  bool required;  ///< at least one
  std::string_view doc;
};

/// What a key takes is `quantity`: the name of a physical one (math/units.hpp), or one of
///   "text", "name", "flag", "count" (a whole number),
///   "choice:a|b|c",
///   "list of length", "list of time", "list of pressure" (one or several),
///   "polygon" (≥ 3 points), "polyline" (≥ 2), "box" (two corners), "points" (≥ 1),
///   "table of length" (one value, a list of [time, value], or the name of a CSV file with those two columns),
///   "table of ratio by pressure" (likewise with pairs [pressure, ratio], never one value).
struct Key {
  std::string section;
  std::string name;
  std::string symbol;  ///< as in docs/theory.md; may be empty
  std::string quantity;
  bool required = false;
  std::string standard;  ///< the default as one writes it; empty: none
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity();  ///< SI, inclusive
  std::string example;                                    ///< TOML, as `polder new` writes it
  std::string doc;
  std::optional<double> preset = {};  ///< the default where it comes as a number (a law's parameter): SI
};

const std::vector<Section>& case_sections();
const std::vector<Key>& case_keys();
std::vector<const Key*> keys_of(std::string_view section);
const Key* find_key(std::string_view section, std::string_view name);

/// A law's parameter as a key of `[[material]]`.
Key law_key(const Parameter& parameter);

/// The words of a "choice:…" quantity; empty for any other.
std::vector<std::string> choices_of(std::string_view quantity);

/// What a "table of …" gives, and by what: time where it does not say.
struct TableKind {
  const Quantity* of;
  const Quantity* by;
  bool by_time() const { return by->name == "time"; }
};
std::optional<TableKind> table_kind(std::string_view quantity);

/// How a value of this quantity is written, for messages and the documentation: `a length such as "0.05 m"`.
std::string expected(const Key& key);
/// "between 0.1 and 0.9", "at least 0 Pa", "" where everything goes.
std::string range_of(const Key& key);

}  // namespace polder::case_file
