#include "polder/study/study_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>

#include "polder/case/diagnostic.hpp"
#include "polder/case/locate.hpp"
#include "polder/math/units.hpp"

namespace polder::study {
namespace {

namespace fs = std::filesystem;

/// One axis of the sweep: every row sets all of the keys.
struct Axis {
  std::vector<std::string> keys, labels;
  std::vector<std::vector<std::string>> rows;
};

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Byte at which the column-th character (from 1) of a line begins; columns count characters of UTF-8.
std::size_t byte_of(const std::string& line, std::size_t column) {
  std::size_t byte = 0;
  for (std::size_t at = 1; byte < line.size(); ++byte)
    if ((static_cast<unsigned char>(line[byte]) & 0xC0) != 0x80 && at++ == column) break;
  return byte;
}

struct Reader {
  const fs::path& file;
  std::vector<std::string> lines = lines_of(file);

  std::runtime_error wrong(const toml::node& where, const std::string& what) const {
    return std::runtime_error(fmt::format("{}:{}: {}", file.string(), where.source().begin.line, what));
  }

  void only(const toml::table& table, std::string_view section, std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : table)
      if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
        const std::vector<std::string> names(known.begin(), known.end());
        const std::string near = nearest(key.str(), names);
        throw wrong(value, fmt::format("'{}' is no key of {}{}", key.str(), section,
                                       near.empty() ? fmt::format("; there are: {}", fmt::join(names, ", "))
                                                    : fmt::format("; did you mean '{}'?", near)));
      }
  }

  /// A value as it would stand after the '=' of --set: as the file writes it, 1e-3 or 0.25.
  std::string text_of(const toml::node& node) const {
    if (const auto text = node.value<std::string>(); text && node.is_string()) return *text;
    const auto [begin, end, unnamed] = node.source();
    std::string text;
    for (auto number = begin.line; number <= end.line; ++number) {
      const std::string& line = lines.at(number - 1);
      const std::size_t first = number == begin.line ? byte_of(line, begin.column) : 0;
      text += line.substr(first, number == end.line ? byte_of(line, end.column) - first : std::string::npos);
      if (number != end.line) text += '\n';
    }
    return text;
  }

  std::vector<std::string> texts(const toml::node* node, const toml::table& owner, const char* key) const {
    std::vector<std::string> list;
    const toml::array* array = node ? node->as_array() : nullptr;
    if (!array || array->empty()) throw wrong(owner, fmt::format("'{}' is not a list with something in it", key));
    for (const toml::node& value : *array) list.push_back(text_of(value));
    return list;
  }

  double measure(const toml::node& node, const char* quantity) const {
    if (const auto number = node.value<double>(); number && !node.is_string()) return *number;
    const Measured value = read_measure(node.value_or(std::string()), *find_quantity(quantity));
    if (!value.ok()) throw wrong(node, value.error);
    return value.value;
  }

  /// `count` texts from "5 kPa" to "15 kPa": the ends are numbers with the same unit, or without one.
  std::vector<std::string> range(const toml::table& entry) const {
    const auto split = [&](const char* key) {
      const toml::node* node = entry.get(key);
      if (!node) throw wrong(entry, "a range needs from, to and count");
      const std::string text = text_of(*node);
      std::size_t used = 0;
      double number = 0;
      try {
        number = std::stod(text, &used);
      } catch (const std::logic_error&) {
        throw wrong(*node, fmt::format("'{}' does not begin with a number", text));
      }
      return std::pair{number, text.substr(used)};
    };
    const auto [from, unit] = split("from");
    const auto [to, same] = split("to");
    const long long count = entry["count"].value_or(0LL);
    if (unit != same) throw wrong(entry, fmt::format("from and to have different units, '{}' and '{}'", unit, same));
    if (count < 2 || count > 1000) throw wrong(entry, "a range has a count of 2 to 1000");
    std::vector<std::string> values;
    for (long long k = 0; k < count; ++k)
      values.push_back(
          fmt::format("{:.10g}{}", from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1), unit));
    return values;
  }

  Axis axis(const toml::table& entry) const {
    only(entry, "[[vary]]", {"key", "label", "values", "from", "to", "count", "keys", "labels", "rows"});
    Axis axis;
    if (entry.contains("keys")) {
      axis.keys = texts(entry.get("keys"), entry, "keys");
      const toml::array* rows = entry["rows"].as_array();
      if (!rows || rows->empty()) throw wrong(entry, "a table of keys needs rows");
      for (const toml::node& row : *rows) {
        axis.rows.push_back(texts(&row, entry, "rows"));
        if (axis.rows.back().size() != axis.keys.size())
          throw wrong(row, fmt::format("the row has {} values for {} keys", axis.rows.back().size(), axis.keys.size()));
      }
    } else {
      const std::string key = entry["key"].value_or(std::string());
      if (key.empty()) throw wrong(entry, "[[vary]] needs a key, or keys and rows");
      axis.keys = {key};
      for (std::string& value : entry.contains("values") ? texts(entry.get("values"), entry, "values") : range(entry))
        axis.rows.push_back({std::move(value)});
    }
    if (entry.contains("label")) axis.labels = {entry["label"].value_or(std::string())};
    if (entry.contains("labels")) axis.labels = texts(entry.get("labels"), entry, "labels");
    if (axis.labels.empty())
      for (const std::string& key : axis.keys) {
        std::string label = key.substr(key.rfind('.') + 1);
        std::replace(label.begin(), label.end(), '_', ' ');
        axis.labels.push_back(label);
      }
    if (axis.labels.size() != axis.keys.size()) throw wrong(entry, "there must be one label for each key");
    return axis;
  }

  Measure measure_of(const toml::table& entry) const {
    only(entry, "[[measure]]",
         {"name", "monitor", "result", "time", "largest", "smallest", "reaches", "trend", "within"});
    Measure measure;
    Expectation& e = measure.what;
    e.quantity = entry["name"].value_or(std::string());
    e.monitor = entry["monitor"].value_or(std::string());
    e.result = entry["result"].value_or(std::string());
    if (e.quantity.empty()) throw wrong(entry, "a [[measure]] needs a name");
    if (e.monitor.empty() == e.result.empty()) throw wrong(entry, "a [[measure]] needs a monitor or a result");
    if (const toml::node* time = entry.get("time")) e.time = this->measure(*time, "time");
    if (entry["largest"].value_or(false)) e.take = Expectation::Take::largest;
    if (entry["smallest"].value_or(false)) e.take = Expectation::Take::smallest;
    if (const auto level = entry["reaches"].value<double>()) e.take = Expectation::Take::time_of, e.reaches = *level;
    const std::string trend = entry["trend"].value_or(std::string());
    if (!trend.empty() && trend != "rises" && trend != "falls")
      throw wrong(entry, fmt::format("the trend '{}' is neither \"rises\" nor \"falls\"", trend));
    measure.trend = trend == "rises" ? Trend::rises : trend == "falls" ? Trend::falls : Trend::none;
    measure.within = entry["within"].value<double>();
    return measure;
  }
};

std::string folder_name(const std::string& name) {
  std::string folder;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '_')
      folder += c;
    else if (!folder.empty() && folder.back() != '_')
      folder += '_';
  return folder.empty() ? "member" : folder;
}

/// Every combination of the axes' rows.
void add_members(const std::vector<Axis>& axes, const std::vector<std::string>& common, Study& study) {
  std::vector<std::size_t> at(axes.size(), 0);
  std::set<std::string> folders;
  for (bool more = true; more;) {
    Member member;
    member.overrides = common;
    std::vector<std::string> words;
    for (std::size_t a = 0; a < axes.size(); ++a)
      for (std::size_t k = 0; k < axes[a].keys.size(); ++k) {
        const std::string& value = axes[a].rows[at[a]][k];
        member.values.push_back(value);
        member.overrides.push_back(axes[a].keys[k] + "=" + value);
        words.push_back(axes[a].labels[k] + " = " + value);
      }
    member.name = fmt::format("{}", fmt::join(words, ", "));
    member.folder = folder_name(member.name);
    for (int again = 2; !folders.insert(member.folder).second; ++again)
      member.folder = fmt::format("{}-{}", folder_name(member.name), again);
    study.members.push_back(std::move(member));
    more = false;
    for (std::size_t a = axes.size(); a-- > 0;) {
      if (++at[a] < axes[a].rows.size()) {
        more = true;
        break;
      }
      at[a] = 0;
    }
  }
}

}  // namespace

Study read_study(const fs::path& file) {
  toml::table table;
  try {
    table = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
  const Reader reader{file};
  reader.only(table, "a study", {"title", "note", "case", "set", "vary", "measure", "curve", "profiles"});
  Study study;
  study.name = file.stem().string();
  study.title = table["title"].value_or(study.name);
  study.note = table["note"].value_or(std::string());
  study.case_name = table["case"].value_or(std::string());
  if (study.case_name.empty())
    throw std::runtime_error(file.string() + ": the case is missing: write case = \"overtopping\"");
  if (std::error_code unknown; fs::exists(file.parent_path() / study.case_name, unknown))
    study.case_name = (file.parent_path() / study.case_name).string();
  std::vector<std::string> common;
  if (table.contains("set")) common = reader.texts(table.get("set"), table, "set");

  const auto each = [&](const char* key, auto&& body) {
    const toml::array* entries = table[key].as_array();
    if (table.contains(key) && !entries)
      throw reader.wrong(*table.get(key), fmt::format("'{0}' is a list of tables: write [[{0}]]", key));
    if (!entries) return;
    for (const toml::node& node : *entries)
      if (const toml::table* entry = node.as_table()) body(*entry);
  };
  std::vector<Axis> axes;
  each("vary", [&](const toml::table& entry) { axes.push_back(reader.axis(entry)); });
  if (axes.empty()) throw std::runtime_error(file.string() + ": nothing varies: add a [[vary]] with key and values");
  std::size_t count = 1;
  for (const Axis& axis : axes) {
    study.labels.insert(study.labels.end(), axis.labels.begin(), axis.labels.end());
    count *= axis.rows.size();
  }
  if (count > 1000)
    throw std::runtime_error(fmt::format("{}: the study has {} members; 1000 at most", file.string(), count));
  add_members(axes, common, study);
  each("measure", [&](const toml::table& entry) { study.measures.push_back(reader.measure_of(entry)); });
  each("curve", [&](const toml::table& entry) {
    reader.only(entry, "[[curve]]", {"monitor"});
    study.curves.push_back(entry["monitor"].value_or(std::string()));
    if (study.curves.back().empty()) throw reader.wrong(entry, "a [[curve]] needs a monitor, a column of history.csv");
  });
  if (const toml::table* profiles = table["profiles"].as_table()) {
    reader.only(*profiles, "[profiles]", {"times", "span", "water"});
    if (const toml::array* times = (*profiles)["times"].as_array())
      for (const toml::node& time : *times) study.profiles.times.push_back(reader.measure(time, "time"));
    if (study.profiles.times.empty()) throw reader.wrong(*profiles, "[profiles] needs times");
    if (const toml::array* span = (*profiles)["span"].as_array()) {
      if (span->size() != 2) throw reader.wrong(*span, "the span is [from, to]");
      study.profiles.span = {reader.measure(*span->get(0), "length"), reader.measure(*span->get(1), "length")};
    }
    study.profiles.water = (*profiles)["water"].value_or(false);
  }
  return study;
}

std::optional<fs::path> find_study(const std::string& name_or_path) {
  std::error_code unknown;
  if (fs::is_regular_file(name_or_path, unknown)) return fs::path(name_or_path);
  if (fs::path(name_or_path).filename() != fs::path(name_or_path)) return std::nullopt;
  for (const fs::path& folder : case_folders())
    if (const fs::path file = folder / "studies" / (name_or_path + ".toml"); fs::is_regular_file(file, unknown))
      return file;
  return std::nullopt;
}

std::vector<std::string> shipped_studies() {
  std::set<std::string> names;
  std::error_code unreadable;
  for (const fs::path& folder : case_folders())
    for (const auto& entry : fs::directory_iterator(folder / "studies", unreadable))
      if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
  return {names.begin(), names.end()};
}

}  // namespace polder::study
