#pragma once
// A case file as a tree that remembers where each value was written: TOML, with `base` files merged in and the command
// line's overrides applied. What the keys mean is the reader's business.
#include <string>
#include <string_view>
#include <vector>

#include "polder/case/diagnostic.hpp"

namespace polder::case_file {

struct Member;

struct Value {
  enum class Kind { text, number, integer, flag, date, list, table };
  Kind kind = Kind::table;
  std::string text;   ///< of a text
  double number = 0;  ///< of a number or an integer
  bool flag = false;
  std::vector<Value> items;     ///< of a list
  std::vector<Member> members;  ///< of a table, in no particular order
  Place place;

  const Value* find(std::string_view name) const;
  Value* find(std::string_view name);
};

struct Member {
  std::string name;
  Place place;  ///< of the key
  Value value;
};

/// "a text", "a number", "a list"…, for messages.
std::string_view name_of(Value::Kind kind);

/// A text that is not in a file; `name` stands for the file in messages.
Value read_document(const std::string& text, const std::string& name, Diagnostics& diagnostics);

/// Reads `path` and the files that it is based on, and applies `overrides` ("model.cell=0.025 m"). A table of the file
/// overrides its base's key by key; a list of tables (`[[material]]`) entry by entry where every entry has a `name`,
/// else as a whole. An override's path names an entry by its name or by its number, counted from 1.
Value load_document(const std::string& path, const std::vector<std::string>& overrides, Diagnostics& diagnostics);

}  // namespace polder::case_file
