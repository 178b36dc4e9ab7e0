// docs/case-file.md from the schema.
#include <fmt/format.h>

#include <cmath>

#include "polder/case/schema.hpp"
#include "polder/case/schema_pages.hpp"
#include "polder/math/units.hpp"

namespace polder {
namespace {

using namespace case_file;

constexpr std::string_view introduction = R"(# The case file

<!-- Written by `polder schema --docs` from the table in src/polder/case/schema.cpp; do not edit. -->

A case is one [TOML](https://toml.io) file in the words and units of soil mechanics. `polder new my-dike.toml` writes one
to start from, `polder check my-dike.toml` says everything that is wrong with it, at once.

**Numbers** are texts with a unit, `"27 kN/m3"`, `"5.3 cm/s"`, `"8.905e-4 Pa s"`, `"30 min"`, `"2 %"`, or plain numbers,
which are SI: `0.05` is 0.05 m where a length is asked for. An angle must name its unit, `"35 deg"`: a plain number would be
radians, which is seldom meant. Units combine with blanks, `/` and exponents (`kN/m3`, `kN/m^3`, `kN m-3`, `1/kPa`).

**Points** are `[x, height]`, in three dimensions `[x, y, height]`; the origin is the lower left corner of the model:
`[["2 m", "0 m"], [2.14, 1]]`.

**Signs**: up is positive; water pressure is positive in compression, stress in tension.

**Variants.** `base = "../dike-seepage/case.toml"` in the first line takes over another case, and the rest of the file
overrides it key by key. Entries of lists (`[[material]]`, `[[stage]]`…) are matched by their `name`, and new names are
added; a list in which an entry has no name replaces the base's as a whole. On the command line,
`--set model.cell="0.025 m"` does the same for one key; `--set material.sand.friction_angle="36 deg"` names an entry, and
`--set stage.2.duration="5 s"` counts from 1.
)";

/// Bars would end a cell of a Markdown table.
std::string cell(std::string text) {
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) text.insert(i, "\\");
  return text;
}

std::string takes(const Key& key) {
  std::string text;
  if (const auto words = choices_of(key.quantity); !words.empty())
    text = fmt::format("`\"{}\"`", fmt::join(words, "\"`, `\""));
  else if (key.quantity == "flag")
    text = "`true`, `false`";
  else if (key.quantity == "count")
    text = "whole number";
  else if (key.quantity == "list of length")
    text = "length, or list of them";
  else if (key.quantity == "list of time")
    text = "list of times";
  else if (key.quantity == "table of length")
    text = "length, list of `[time, length]`, or CSV file";
  else
    text = key.quantity;
  if (const std::string range = range_of(key); !range.empty()) text += ", " + range;
  return text;
}

std::string row(const Key& key) {
  const std::string standard = key.required ? "**required**" : key.standard.empty() ? "" : "`" + key.standard + "`";
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.symbol, cell(takes(key)), standard, cell(key.doc));
}

constexpr std::string_view heading = "\n| key | symbol | takes | default | meaning |\n|-|-|-|-|-|\n";

std::string laws() {
  std::string text = "\n## Soil laws\n\nThe `law` of a `[[material]]`, and the keys that it adds to that section.\n";
  for (const LawDescription& law : soil_laws()) {
    text += fmt::format("\n### `law = \"{}\"`\n\n{}.\n{}", law.name, law.doc, heading);
    for (const Parameter& parameter : law.parameters) text += row(law_key(parameter));
  }
  return text;
}

std::string units() {
  std::string text = "\n## Quantities\n\n| quantity | SI unit | for example |\n|-|-|-|\n";
  for (const Quantity& q : quantities())
    text += fmt::format("| {} | {} | `{}` |\n", q.name, q.unit.empty() ? "1" : q.unit, q.example);
  return text +
         fmt::format(
             "\nDensities may be written as unit weights and unit weights as densities, with g = {} m/s2.\n"
             "Units: m, km, dm, cm, mm, um; s, ms, us, min, h, day, week, year; kg, g, t; N, kN, MN; Pa, mPa, hPa, "
             "kPa, MPa, GPa, bar, mbar; Hz; l; deg, rad; %.\n",
             standard_gravity);
}

}  // namespace

std::string case_file_page() {
  std::string text(introduction);
  for (const Section& section : case_sections()) {
    text += fmt::format(fmt::runtime(section.list ? "\n## `[[{}]]`\n\n{}\n" : "\n## `[{}]`\n\n{}\n"), section.name,
                        section.doc);
    text += heading;
    for (const Key* key : keys_of(section.name)) text += row(*key);
  }
  return text + laws() + units();
}

}  // namespace polder
