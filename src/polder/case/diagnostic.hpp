#pragma once
// What is wrong with a case file, where, and what to do about it, as a compiler would say it.
#include <string>
#include <string_view>
#include <vector>

namespace polder {

/// A place in a case file. `file` is "--set" for an override given on the command line; `line` 0: the file as a whole.
struct Place {
  std::string file;
  int line = 0, column = 0;  ///< from 1; columns count characters, not bytes
  std::string text;          ///< the source where it is not a file (an override)
};

enum class Severity { error, warning };

struct Diagnostic {
  Severity severity = Severity::error;
  Place place;
  std::string key;      ///< "material.sand.friction_angle"
  std::string message;  ///< what is wrong
  std::string help;     ///< the remedy; may be empty
};

using Diagnostics = std::vector<Diagnostic>;

void report(Diagnostics& out, const Place& place, std::string key, std::string message, std::string help = {});
void warn(Diagnostics& out, const Place& place, std::string key, std::string message, std::string help = {});
bool has_errors(const Diagnostics& diagnostics);

/// In the order of the files' lines, without repetitions.
void sort_by_place(Diagnostics& diagnostics);

/// "case.toml:12:8: error: model.cell: …", the line with a caret below it, and the help.
std::string format(const Diagnostic& diagnostic);
/// All of them, and a last line with their number.
std::string format(const Diagnostics& diagnostics);

/// The candidate nearest to `word` by edit distance, or "" where none is near enough to be a misspelling.
/// Of several that are equally near, the one that begins like it for longest.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The remedy for a name that is not one of those: the nearest, or all of them; "" where there are none.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace polder
