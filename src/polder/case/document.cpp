#include "polder/case/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace polder::case_file {
namespace {

namespace fs = std::filesystem;

Place place_of(const toml::source_region& source, const Place& like) {
  Place place = like;
  place.line = static_cast<int>(source.begin.line);
  place.column = static_cast<int>(source.begin.column);
  return place;
}

/// `like` names the file.
Value tree_of(const toml::node& node, const Place& like) {
  Value value;
  value.place = place_of(node.source(), like);
  switch (node.type()) {
    case toml::node_type::string:
      value.kind = Value::Kind::text;
      value.text = node.as_string()->get();
      break;
    case toml::node_type::integer:
      value.kind = Value::Kind::integer;
      value.number = static_cast<double>(node.as_integer()->get());
      break;
    case toml::node_type::floating_point:
      value.kind = Value::Kind::number;
      value.number = node.as_floating_point()->get();
      break;
    case toml::node_type::boolean:
      value.kind = Value::Kind::flag;
      value.flag = node.as_boolean()->get();
      break;
    case toml::node_type::array:
      value.kind = Value::Kind::list;
      for (const toml::node& item : *node.as_array()) value.items.push_back(tree_of(item, like));
      break;
    case toml::node_type::table:
      for (const auto& [key, member] : *node.as_table())
        value.members.push_back({std::string(key.str()), place_of(key.source(), like), tree_of(member, like)});
      break;
    default:
      value.kind = Value::Kind::date;
  }
  return value;
}

/// The last words of toml++'s messages are for its own developers.
std::string plain(std::string_view message) {
  std::string text(message);
  if (const auto cut = text.find("Error while parsing "); cut == 0) text = "in " + text.substr(20);
  return text;
}

Value parse(const std::string& path, Diagnostics& diagnostics) {
  std::ifstream file(path);
  std::ostringstream text;
  std::error_code unknown;
  if (!fs::is_directory(path, unknown) && file && (text << file.rdbuf()))
    return read_document(text.str(), path, diagnostics);
  Value nothing;
  nothing.place.file = path;
  report(diagnostics, nothing.place, {}, "cannot be read", "is the path right, and may the file be read?");
  return nothing;
}

const std::string* name_of_entry(const Value& entry) {
  const Value* name = entry.find("name");
  return name && name->kind == Value::Kind::text ? &name->text : nullptr;
}

bool is_list_of_named_tables(const Value& value) {
  return value.kind == Value::Kind::list && !value.items.empty() &&
         std::all_of(value.items.begin(), value.items.end(),
                     [](const Value& item) { return item.kind == Value::Kind::table && name_of_entry(item); });
}

Value* entry_named(Value& list, std::string_view name) {
  for (Value& item : list.items)
    if (const std::string* own = name_of_entry(item); own && *own == name) return &item;
  return nullptr;
}

void merge(Value& base, Value&& over) {
  if (base.kind == Value::Kind::table && over.kind == Value::Kind::table) {
    base.place = over.place;
    for (Member& member : over.members) {
      if (Value* known = base.find(member.name))
        merge(*known, std::move(member.value));
      else
        base.members.push_back(std::move(member));
    }
  } else if (is_list_of_named_tables(over) && base.kind == Value::Kind::list) {
    for (Value& entry : over.items) {
      if (Value* known = entry_named(base, *name_of_entry(entry)))
        merge(*known, std::move(entry));
      else
        base.items.push_back(std::move(entry));
    }
  } else {
    base = std::move(over);
  }
}

/// `chain`: the files that led here, to refuse a file that is based on itself.
Value load(const std::string& path, std::vector<fs::path> chain, Diagnostics& diagnostics) {
  Value own = parse(path, diagnostics);
  std::error_code unknown;  // of a path that cannot be one: then there is no such file either
  chain.push_back(fs::weakly_canonical(path, unknown));
  const auto base =
      std::find_if(own.members.begin(), own.members.end(), [](const Member& m) { return m.name == "base"; });
  if (base == own.members.end()) return own;
  const Member key = *base;
  own.members.erase(base);
  if (key.value.kind != Value::Kind::text) {
    report(diagnostics, key.value.place, "base", fmt::format("is {}; a path is needed", name_of(key.value.kind)),
           "write base = \"../other-case/case.toml\"");
    return own;
  }
  const fs::path below = fs::path(path).parent_path() / key.value.text;
  if (std::find(chain.begin(), chain.end(), fs::weakly_canonical(below, unknown)) != chain.end()) {
    report(diagnostics, key.value.place, "base", fmt::format("\"{}\" leads back to this file", key.value.text),
           "a case cannot be based on itself, directly or through others");
    return own;
  }
  if (!fs::is_regular_file(below, unknown)) {
    report(diagnostics, key.value.place, "base", fmt::format("there is no file \"{}\"", key.value.text),
           "the path counts from the folder of this file");
    return own;
  }
  Value merged = load(below.lexically_normal().string(), std::move(chain), diagnostics);
  merge(merged, std::move(own));
  return merged;
}

/// What stands after the '=' of an override: TOML where it is, else a text ("0.025 m" after the shell took the quotes).
Value override_value(const std::string& text, const Place& place) {
  try {
    const toml::table table = toml::parse("value = " + text);
    if (table.size() == 1 && table.contains("value")) {
      Value value = tree_of(*table.get("value"), place);
      const auto settle = [&](auto&& self, Value& v) -> void {
        v.place = place;
        for (Value& item : v.items) self(self, item);
        for (Member& member : v.members) {
          member.place = place;
          self(self, member.value);
        }
      };
      settle(settle, value);
      return value;
    }
  } catch (const toml::parse_error&) {
    // not TOML: the bare text that it looks like
  }
  Value value;
  value.kind = Value::Kind::text;
  value.text = text;
  value.place = place;
  return value;
}

void apply_override(Value& root, const std::string& text, Diagnostics& diagnostics) {
  const std::size_t equal = text.find('=');
  Place place{"--set", 1, 1, text};
  if (equal == std::string::npos || equal == 0) {
    report(diagnostics, place, {}, "is not of the form key=value", "write for example --set model.cell=\"0.025 m\"");
    return;
  }
  std::string path = text.substr(0, equal);
  while (!path.empty() && path.back() == ' ') path.pop_back();
  Value* at = &root;
  std::string walked;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    const std::string step = path.substr(from, to - from);
    const bool last = to == path.size();
    from = to + 1;
    if (at->kind == Value::Kind::list) {
      Value* entry = entry_named(*at, step);
      std::size_t number = 0;
      const auto [end, status] = std::from_chars(step.data(), step.data() + step.size(), number);
      if (!entry && status == std::errc() && end == step.data() + step.size() && number >= 1 &&
          number <= at->items.size())
        entry = &at->items[number - 1];
      if (!entry) {
        std::vector<std::string> names;
        for (const Value& item : at->items)
          if (const std::string* name = name_of_entry(item)) names.push_back(*name);
        report(diagnostics, place, path, fmt::format("{} has no entry \"{}\"", walked, step),
               names.empty()
                   ? fmt::format("name one by its number, from 1 to {}", at->items.size())
                   : fmt::format("known: {}; or a number from 1 to {}", fmt::join(names, ", "), at->items.size()));
        return;
      }
      at = entry;
    } else {
      if (at->kind != Value::Kind::table) {
        report(diagnostics, place, path, fmt::format("{} is {}, not a section", walked, name_of(at->kind)));
        return;
      }
      Value* next = at->find(step);
      if (!next) {
        at->members.push_back({step, place, {}});
        next = &at->members.back().value;
        next->place = place;
      }
      at = next;
    }
    walked += (walked.empty() ? "" : ".") + step;
    if (last) break;
  }
  std::string value = text.substr(equal + 1);
  while (!value.empty() && value.front() == ' ') value.erase(0, 1);
  place.column = static_cast<int>(text.size() - value.size()) + 1;
  *at = override_value(value, place);
}

}  // namespace

const Value* Value::find(std::string_view name) const {
  for (const Member& member : members)
    if (member.name == name) return &member.value;
  return nullptr;
}

Value* Value::find(std::string_view name) { return const_cast<Value*>(std::as_const(*this).find(name)); }

std::string_view name_of(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::text:
      return "a text";
    case Value::Kind::number:
      return "a number";
    case Value::Kind::integer:
      return "an integer";
    case Value::Kind::flag:
      return "true or false";
    case Value::Kind::date:
      return "a date or time of day";
    case Value::Kind::list:
      return "a list";
    case Value::Kind::table:
      return "a section";
  }
  return "";
}

Value read_document(const std::string& text, const std::string& name, Diagnostics& diagnostics) {
  const Place whole{name, 0, 0, {}};
  try {
    return tree_of(toml::parse(text, name), whole);
  } catch (const toml::parse_error& error) {
    report(diagnostics, place_of(error.source(), whole), {}, "not valid TOML: " + plain(error.description()),
           "see docs/case-file.md for how a case is written");
  }
  Value nothing;
  nothing.place = whole;
  return nothing;
}

Value load_document(const std::string& path, const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  Value root = load(path, {}, diagnostics);
  for (const std::string& text : overrides) apply_override(root, text, diagnostics);
  return root;
}

}  // namespace polder::case_file
