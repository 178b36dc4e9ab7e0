#pragma once
// One section of a case file, read against the schema: SI numbers, texts, points, with their places. What could not be
// read has been reported and is absent; defaults are filled in.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "polder/case/diagnostic.hpp"
#include "polder/case/document.hpp"
#include "polder/case/schema.hpp"
#include "polder/math/table.hpp"

namespace polder::case_file {

struct Entry {
  double number = 0;  ///< of a physical quantity, SI; of a count; of a choice: its number in the list
  bool flag = false;
  std::string text;                         ///< of a text, a name, a choice
  std::vector<double> numbers;              ///< of a list
  std::vector<std::vector<double>> points;  ///< of polygons, polylines, boxes, points: 2 or 3 coordinates each
  Table table;
  Place place;
};

struct Fields {
  std::string path;  ///< "model", "material.sand": what messages call the section
  Place place;
  std::map<std::string, Entry, std::less<>> valid;  ///< read or by default
  std::set<std::string, std::less<>> given;         ///< written in the file, rightly or wrongly

  const Entry* find(std::string_view name) const;
  bool is_given(std::string_view name) const { return given.contains(name); }
  /// The value; of an absent one `otherwise`.
  double number(std::string_view name, double otherwise = 0) const;
  bool flag(std::string_view name) const;
  std::string text(std::string_view name) const;
  /// Of a key, or of the section where the key is absent.
  Place place_of(std::string_view name) const;
  std::string path_of(std::string_view name) const { return path + "." + std::string(name); }
};

/// Reads `table` against `keys`. Keys in `ignored` are left alone.
Fields read_fields(const Value& table, const std::vector<const Key*>& keys, std::string path, Diagnostics& diagnostics,
                   const std::set<std::string>& ignored = {});

}  // namespace polder::case_file
