#include "polder/case/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <tuple>

namespace polder {
namespace {

/// Edits (insert, delete, replace, swap neighbours) that turn `a` into `b`; case does not count.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto low = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = low(a[i - 1]) == low(b[j - 1]);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && low(a[i - 1]) == low(b[j - 2]) && low(a[i - 2]) == low(b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string source_line(const Place& place) {
  if (!place.text.empty()) return place.text;
  std::ifstream file(place.file);
  std::string line;
  for (int i = 0; i < place.line && file; ++i) std::getline(file, line);
  if (!file && line.empty()) return {};
  std::replace(line.begin(), line.end(), '\t', ' ');
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

std::string count(std::size_t n, std::string_view noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

}  // namespace

void report(Diagnostics& out, const Place& place, std::string key, std::string message, std::string help) {
  out.push_back({Severity::error, place, std::move(key), std::move(message), std::move(help)});
}

void warn(Diagnostics& out, const Place& place, std::string key, std::string message, std::string help) {
  out.push_back({Severity::warning, place, std::move(key), std::move(message), std::move(help)});
}

bool has_errors(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::error; });
}

void sort_by_place(Diagnostics& diagnostics) {
  const auto order = [](const Diagnostic& d) { return std::tie(d.place.file, d.place.line, d.place.column, d.key); };
  const auto before = [&](const Diagnostic& a, const Diagnostic& b) { return order(a) < order(b); };
  const auto same = [&](const Diagnostic& a, const Diagnostic& b) {
    return order(a) == order(b) && a.message == b.message;
  };
  std::stable_sort(diagnostics.begin(), diagnostics.end(), before);
  diagnostics.erase(std::unique(diagnostics.begin(), diagnostics.end(), same), diagnostics.end());
}

std::string format(const Diagnostic& d) {
  std::string text = d.place.file;
  if (d.place.line > 0) text += fmt::format(":{}:{}", d.place.line, d.place.column);
  text += d.severity == Severity::error ? ": error: " : ": warning: ";
  if (!d.key.empty()) text += d.key + ": ";
  text += d.message + "\n";
  if (d.place.line > 0) {
    const std::string line = source_line(d.place);
    if (!line.empty())
      text += fmt::format("{:5} | {}\n      | {:>{}}\n", d.place.line, line, "^", std::max(d.place.column, 1));
  }
  if (!d.help.empty()) text += "      help: " + d.help + "\n";
  return text;
}

std::string format(const Diagnostics& diagnostics) {
  std::string text;
  std::size_t errors = 0;
  for (const Diagnostic& d : diagnostics) {
    text += format(d);
    errors += d.severity == Severity::error;
  }
  const std::size_t warnings = diagnostics.size() - errors;
  if (errors > 0) text += count(errors, "error");
  if (errors > 0 && warnings > 0) text += ", ";
  if (warnings > 0) text += count(warnings, "warning");
  return diagnostics.empty() ? text : text + "\n";
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3), alike = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    const auto same = static_cast<std::size_t>(
        std::mismatch(word.begin(), word.end(), candidate.begin(), candidate.end()).first - word.begin());
    if (distance > least || distance >= std::max(word.size(), candidate.size())) continue;
    if (!best.empty() && distance == least && same <= alike) continue;
    least = distance;
    alike = same;
    best = candidate;
  }
  return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  if (known.empty()) return "";
  const std::string near = nearest(name, known);
  return near.empty() ? fmt::format("known: {}", fmt::join(known, ", ")) : fmt::format("did you mean \"{}\"?", near);
}

}  // namespace polder
