#include "polder/case/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "polder/math/units.hpp"

namespace polder::case_file {
namespace {

/// What one value of a section is read with.
struct Reading {
  const Key& key;
  const std::string& path;
  Diagnostics& diagnostics;

  void fail(const Value& value, std::string message, std::string help = {}) const {
    report(diagnostics, value.place, path, std::move(message),
           help.empty() ? "write " + expected(key) : std::move(help));
  }
};

std::string quoted(const Value& value) {
  switch (value.kind) {
    case Value::Kind::text:
      return "\"" + value.text + "\"";
    case Value::Kind::number:
      return fmt::format("{:g}", value.number);
    case Value::Kind::integer:
      return fmt::format("{:.0f}", value.number);
    case Value::Kind::flag:
      return value.flag ? "true" : "false";
    default:
      return "";
  }
}

std::optional<double> in_range(const Reading& r, const Value& value, double number) {
  if (number >= r.key.low && number <= r.key.high && std::isfinite(number)) return number;
  const std::string range = range_of(r.key);
  r.fail(value, fmt::format("{} is out of range", quoted(value)), "it must be " + (range.empty() ? "finite" : range));
  return {};
}

/// A number with a unit, or a plain one in SI.
std::optional<double> read_physical(const Reading& r, const Value& value, const Quantity& quantity) {
  if (value.kind == Value::Kind::text) {
    const Measured measured = read_measure(value.text, quantity);
    if (measured.ok()) return measured.value;
    r.fail(value, fmt::format("\"{}\" {}", value.text, measured.error),
           fmt::format("write {} such as \"{}\"{}", quantity.article, quantity.example,
                       quantity.name == "angle" ? ""
                                                : fmt::format(", or a plain number in SI ({})",
                                                              quantity.unit.empty() ? "1 = 100 %" : quantity.unit)));
    return {};
  }
  if (value.kind == Value::Kind::number || value.kind == Value::Kind::integer) {
    if (quantity.name == "angle" && value.number != 0) {
      r.fail(value, fmt::format("the angle {} has no unit", quoted(value)),
             fmt::format("write \"{0} deg\" (or \"{0} rad\"): plain numbers are SI, and radians are seldom meant",
                         quoted(value)));
      return {};
    }
    return value.number;
  }
  r.fail(value, fmt::format("is {}; {} is needed", name_of(value.kind), quantity.article));
  return {};
}

std::optional<double> read_number(const Reading& r, const Value& value, const Quantity& quantity) {
  const auto number = read_physical(r, value, quantity);
  return number ? in_range(r, value, *number) : number;
}

/// One value or a list of them.
bool read_numbers(const Reading& r, const Value& value, const Quantity& quantity, std::vector<double>& numbers) {
  if (value.kind != Value::Kind::list) {
    const auto number = read_number(r, value, quantity);
    if (number) numbers.push_back(*number);
    return number.has_value();
  }
  bool good = true;
  for (const Value& item : value.items) {
    const auto number = read_number(r, item, quantity);
    if (number) numbers.push_back(*number);
    good = good && number;
  }
  return good;
}

bool read_points(const Reading& r, const Value& value, std::size_t least, std::size_t most, bool solid, Entry& field) {
  const Quantity& length = *find_quantity("length");
  if (value.kind != Value::Kind::list) {
    r.fail(value, fmt::format("is {}; a list of points is needed", name_of(value.kind)));
    return false;
  }
  bool good = true;
  for (const Value& item : value.items) {
    const bool right_size =
        item.kind == Value::Kind::list && (item.items.size() == 2 || (solid && item.items.size() == 3));
    if (!right_size) {
      r.fail(item,
             item.kind == Value::Kind::list
                 ? fmt::format("a point with {} coordinate{}", item.items.size(), item.items.size() == 1 ? "" : "s")
                 : fmt::format("is {}; a point is needed", name_of(item.kind)),
             solid ? "a point is [x, height], in 3d [x, y, height]" : "a point is [x, height]");
      good = false;
      continue;
    }
    std::vector<double> point;
    for (const Value& coordinate : item.items) {
      const auto number = read_physical(r, coordinate, length);
      if (number && !std::isfinite(*number)) r.fail(coordinate, "is not a finite length");
      if (number && std::isfinite(*number)) point.push_back(*number);
    }
    good = good && point.size() == item.items.size();
    field.points.push_back(std::move(point));
  }
  if (value.items.size() < least || value.items.size() > most) {
    r.fail(value, fmt::format("has {} point{}", value.items.size(), value.items.size() == 1 ? "" : "s"),
           least == most ? fmt::format("give {} points", least) : fmt::format("give at least {} points", least));
    return false;
  }
  if (good && std::any_of(field.points.begin(), field.points.end(),
                          [&](const auto& p) { return p.size() != field.points.front().size(); })) {
    r.fail(value, "mixes points of 2 and of 3 coordinates");
    return false;
  }
  return good;
}

bool check_increasing(const Reading& r, const Value& value, const Quantity& by, const Table& table) {
  const bool time = by.name == "time";
  for (std::size_t i = 1; i < table.x.size(); ++i)
    if (!(table.x[i] > table.x[i - 1])) {
      r.fail(value,
             fmt::format("{}s do not increase: {} is followed by {}", by.name, show_measure(table.x[i - 1], by),
                         show_measure(table.x[i], by)),
             time ? "list the points in the order of time, each instant once"
                  : fmt::format("list the points by rising {}, each once", by.name));
      return false;
    }
  return true;
}

/// Two columns, time in s (or what else it is by, in SI) and value in SI, separated by commas, semicolons or blanks;
/// lines that start with a letter or
/// '#' are headings.
bool read_csv(const Reading& r, const Value& value, const Quantity& by, Entry& field) {
  const auto path = std::filesystem::path(value.place.file).parent_path() / value.text;
  std::ifstream file(path);
  std::error_code unknown;
  if (!file || !std::filesystem::is_regular_file(path, unknown)) {
    r.fail(value, fmt::format("there is no file \"{}\"", value.text), "the path counts from the folder of this file");
    return false;
  }
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
    const auto first = line.find_first_not_of(' ');
    if (first == std::string::npos || line[first] == '#' || std::isalpha(static_cast<unsigned char>(line[first])))
      continue;
    double column[2] = {};
    const char *at = line.data() + first, *end = line.data() + line.size();
    bool good = true;
    for (double& c : column) {
      while (at < end && *at == ' ') ++at;
      const auto result = std::from_chars(at, end, c);
      good = good && result.ec == std::errc() && std::isfinite(c);
      at = result.ptr;
    }
    while (at < end && *at == ' ') ++at;
    if (!good || at != end) {
      report(r.diagnostics, {path.string(), number, 1, {}}, r.path, "is not a line of two numbers",
             by.name == "time" ? "each line has a time in s and a value in SI, such as 60, 0.8"
                               : fmt::format("each line has a {} and a value, both in SI", by.name));
      return false;
    }
    field.table.x.push_back(column[0]);
    field.table.y.push_back(column[1]);
  }
  if (field.table.x.empty()) r.fail(value, fmt::format("the file \"{}\" has no lines of numbers", value.text));
  return !field.table.x.empty() && check_increasing(r, value, by, field.table);
}

bool read_table(const Reading& r, const Value& value, const TableKind& kind, Entry& field) {
  const Quantity& quantity = *kind.of;
  if (value.kind == Value::Kind::text && value.text.ends_with(".csv")) {
    if (!read_csv(r, value, *kind.by, field)) return false;
    return std::all_of(field.table.y.begin(), field.table.y.end(),
                       [&](double y) { return in_range(r, value, y).has_value(); });
  }
  if (value.kind != Value::Kind::list && kind.by_time()) {
    const auto number = read_number(r, value, quantity);
    if (number) field.table = Table::constant(*number);
    return number.has_value();
  }
  if (value.kind != Value::Kind::list) {
    r.fail(value, fmt::format("is {}; a list is needed", name_of(value.kind)));
    return false;
  }
  bool good = !value.items.empty();
  if (value.items.empty()) r.fail(value, "is an empty list");
  for (const Value& item : value.items) {
    if (item.kind != Value::Kind::list || item.items.size() != 2) {
      r.fail(item, fmt::format("is not a pair [{}, value]", kind.by->name));
      good = false;
      continue;
    }
    const auto at = read_physical(r, item.items[0], *kind.by);
    const auto number = read_number(r, item.items[1], quantity);
    if (at && !std::isfinite(*at)) r.fail(item.items[0], fmt::format("is not a finite {}", kind.by->name));
    good = good && at && number && std::isfinite(*at);
    field.table.x.push_back(at.value_or(0));
    field.table.y.push_back(number.value_or(0));
  }
  return good && check_increasing(r, value, *kind.by, field.table);
}

bool read_choice(const Reading& r, const Value& value, const std::vector<std::string>& words, Entry& field) {
  if (value.kind != Value::Kind::text) {
    r.fail(value, fmt::format("is {}; a word is needed", name_of(value.kind)));
    return false;
  }
  const auto word = std::find(words.begin(), words.end(), value.text);
  field.text = value.text;
  field.number = static_cast<double>(word - words.begin());
  if (word != words.end()) return true;
  const std::string near = nearest(value.text, words);
  r.fail(value, fmt::format("\"{}\" is not known here", value.text),
         near.empty() ? "write " + expected(r.key)
                      : fmt::format("did you mean \"{}\"? Known: {}", near, fmt::join(words, ", ")));
  return false;
}

bool is_name(std::string_view text) {
  return !text.empty() && text.find_first_of(".=\"\n\t,") == std::string_view::npos && text.front() != ' ' &&
         text.back() != ' ' && !std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool read_text(const Reading& r, const Value& value, Entry& field) {
  if (value.kind != Value::Kind::text) {
    r.fail(value, fmt::format("is {}; a text is needed", name_of(value.kind)));
    return false;
  }
  field.text = value.text;
  if (r.key.quantity != "name" || is_name(value.text)) return true;
  r.fail(value, fmt::format("\"{}\" cannot be a name", value.text),
         "a name has a letter in it, and no dots, commas, equal signs or quotes");
  return false;
}

/// The file's path, from the folder of the case file that names it.
bool read_file(const Reading& r, const Value& value, Entry& field) {
  if (!read_text(r, value, field)) return false;
  const auto path = std::filesystem::path(value.place.file).parent_path() / value.text;
  std::error_code unknown;
  field.text = path.string();
  if (std::filesystem::is_regular_file(path, unknown)) return true;
  r.fail(value, fmt::format("there is no file \"{}\"", value.text), "the path counts from the folder of this file");
  return false;
}

bool read_count(const Reading& r, const Value& value, Entry& field) {
  if (value.kind != Value::Kind::integer) {
    r.fail(value, value.kind == Value::Kind::number
                      ? fmt::format("{} is not a whole number", quoted(value))
                      : fmt::format("is {}; a whole number is needed", name_of(value.kind)));
    return false;
  }
  field.number = value.number;
  return in_range(r, value, value.number).has_value();
}

bool read_field(const Reading& r, const Value& value, Entry& field) {
  constexpr std::size_t many = static_cast<std::size_t>(-1);
  const std::string& kind = r.key.quantity;
  field.place = value.place;
  if (const Quantity* quantity = find_quantity(kind)) {
    const auto number = read_number(r, value, *quantity);
    field.number = number.value_or(0);
    return number.has_value();
  }
  if (const auto words = choices_of(kind); !words.empty()) return read_choice(r, value, words, field);
  if (kind == "flag") {
    field.flag = value.flag;
    if (value.kind != Value::Kind::flag)
      r.fail(value, fmt::format("is {}; true or false is needed", name_of(value.kind)));
    return value.kind == Value::Kind::flag;
  }
  if (kind == "count") return read_count(r, value, field);
  if (kind == "polygon") return read_points(r, value, 3, many, false, field);
  if (kind == "polyline") return read_points(r, value, 2, many, false, field);
  if (kind == "box") return read_points(r, value, 2, 2, true, field);
  if (kind == "points") return read_points(r, value, 1, many, true, field);
  if (kind.starts_with("list of ")) return read_numbers(r, value, *find_quantity(kind.substr(8)), field.numbers);
  if (const auto table = table_kind(kind)) return read_table(r, value, *table, field);
  return kind == "file" ? read_file(r, value, field) : read_text(r, value, field);
}

/// The default of a key as the file would have it.
Value standard_value(const Key& key, const Place& place) {
  Value value;
  value.place = place;
  value.kind = Value::Kind::text;
  value.text = key.standard;
  if (key.quantity == "flag") {
    value.kind = Value::Kind::flag;
    value.flag = key.standard == "true";
  } else if (key.quantity == "count") {
    value.kind = Value::Kind::integer;
    std::from_chars(key.standard.data(), key.standard.data() + key.standard.size(), value.number);
  }
  return value;
}

std::string remedy_for_unknown(const std::string& name, const std::vector<const Key*>& keys) {
  std::vector<std::string_view> laws;
  for (const LawDescription& law : soil_laws())
    for (const Parameter& parameter : law.parameters)
      if (parameter.key == name) laws.push_back(law.name);
  if (!laws.empty()) return fmt::format("\"{}\" is a parameter of the soil laws {}", name, fmt::join(laws, ", "));
  for (const Section& section : case_sections())
    if (find_key(section.name, name))
      return fmt::format(fmt::runtime(section.list ? "\"{}\" is a key of [[{}]]" : "\"{}\" is a key of [{}]"), name,
                         section.name);
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const Key* key : keys) names.push_back(key->name);
  if (const std::string near = nearest(name, names); !near.empty()) return fmt::format("did you mean \"{}\"?", near);
  return fmt::format("known here: {}", fmt::join(names, ", "));
}

}  // namespace

const Entry* Fields::find(std::string_view name) const {
  const auto found = valid.find(name);
  return found == valid.end() ? nullptr : &found->second;
}

double Fields::number(std::string_view name, double otherwise) const {
  const Entry* field = find(name);
  return field ? field->number : otherwise;
}

bool Fields::flag(std::string_view name) const {
  const Entry* field = find(name);
  return field && field->flag;
}

std::string Fields::text(std::string_view name) const {
  const Entry* field = find(name);
  return field ? field->text : std::string();
}

Place Fields::place_of(std::string_view name) const {
  const Entry* field = find(name);
  return field ? field->place : place;
}

Fields read_fields(const Value& table, const std::vector<const Key*>& keys, std::string path, Diagnostics& diagnostics,
                   const std::set<std::string>& ignored) {
  Fields fields{std::move(path), table.place, {}, {}};
  for (const Member& member : table.members) {
    if (ignored.contains(member.name)) continue;
    const std::string whole = fields.path_of(member.name);
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key* k) { return k->name == member.name; });
    if (key == keys.end()) {
      report(diagnostics, member.place, whole, "unknown key", remedy_for_unknown(member.name, keys));
      continue;
    }
    fields.given.insert(member.name);
    Entry field;
    if (read_field({**key, whole, diagnostics}, member.value, field))
      fields.valid.emplace(member.name, std::move(field));
  }
  for (const Key* key : keys) {
    if (fields.is_given(key->name)) continue;
    const std::string whole = fields.path_of(key->name);
    if (key->required) {
      report(diagnostics, table.place, whole, "missing", "write " + expected(*key));
    } else if (key->preset) {
      Entry field;
      field.place = table.place;
      field.number = *key->preset;
      if (const auto words = choices_of(key->quantity); !words.empty()) field.text = key->standard;
      fields.valid.emplace(key->name, std::move(field));
    } else if (!key->standard.empty()) {
      Entry field;
      const Value value = standard_value(*key, table.place);
      if (read_field({*key, whole, diagnostics}, value, field)) fields.valid.emplace(key->name, std::move(field));
    }
  }
  return fields;
}

}  // namespace polder::case_file
