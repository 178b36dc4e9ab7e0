#include "polder/verify/validation_pages.hpp"

#include <fmt/format.h>

#include <cmath>

#include "polder/report/page.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/ticks.hpp"
#include "polder/verify/paper_figures.hpp"

namespace polder::validate {
namespace {

using Json = nlohmann::ordered_json;

Json number_json(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::optional<double> number_of(const Json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

std::string reference_text(const Row& row) {
  if (!row.words.empty()) return row.words;
  std::string text = value_text(row.reference, row.unit);
  if (row.tolerance) text += " ± " + value_text(row.tolerance, row.unit);
  return text;
}

std::string state_of(const std::map<std::string, Result>& results, std::string_view name) {
  const auto found = results.find(std::string(name));
  if (found == results.end()) return "not computed";
  if (!found->second.trouble.empty()) return found->second.trouble;
  return found->second.pass() ? "within" : "short";
}

}  // namespace

std::string value_text(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "–";
  const DisplayUnit shown = display_unit(unit, std::abs(*value));
  std::string name = shown.name == "m2" ? "m²" : shown.name == "m3" ? "m³" : shown.name;
  return number_text(*value / shown.factor) + (name.empty() ? "" : " " + name);
}

std::string verdict_text(const Row& row) {
  switch (row.verdict) {
    case Verdict::within:
      return "within";
    case Verdict::outside:
      return "OUTSIDE";
    case Verdict::shown:
      return "shown";
    case Verdict::other_runs:
      return "takes other runs";
    case Verdict::not_reached:
      return "NOT REACHED";
  }
  return "";
}

Json json_of(const Result& result) {
  Json rows = Json::array();
  for (const Row& row : result.rows)
    rows.push_back({{"quantity", row.quantity},
                    {"at", row.at},
                    {"unit", row.unit},
                    {"reference", number_json(row.reference)},
                    {"computed", number_json(row.computed)},
                    {"tolerance", number_json(row.tolerance)},
                    {"verdict", static_cast<int>(row.verdict)},
                    {"words", row.words},
                    {"source", row.source}});
  return {{"points", result.points},
          {"steps", result.steps},
          {"seconds", result.seconds},
          {"trouble", result.trouble},
          {"rows", rows}};
}

Result result_of(const Json& json) {
  Result result;
  result.points = json.at("points").get<double>();
  result.steps = json.at("steps").get<double>();
  result.seconds = json.at("seconds").get<double>();
  result.trouble = json.at("trouble").get<std::string>();
  for (const Json& row : json.at("rows"))
    result.rows.push_back({row.at("quantity").get<std::string>(), row.at("at").get<std::string>(),
                           row.at("unit").get<std::string>(), number_of(row.at("reference")),
                           number_of(row.at("computed")), number_of(row.at("tolerance")),
                           static_cast<Verdict>(row.at("verdict").get<int>()), row.at("words").get<std::string>(),
                           row.at("source").get<std::string>()});
  return result;
}

std::string validation_page(const std::map<std::string, Result>& results) {
  std::string text =
      "# Validation\n\n<!-- Written by `polder validate --docs`; do not edit. -->\n\n"
      "Shipped cases against experiments and against the numbers that the studies state. `polder validate` recomputes "
      "them; what\na case is held against stands in its `expected.toml`, why a number is missed in its `README.md`. "
      "Measurements are not part\nof Polder: it looks for them in the folder that `POLDER_SHARED` names, or in "
      "`shared` "
      "beside the checkout.\n\n"
      "| case | quantity | at | computed | reference | | source |\n|-|-|-|-|-|-|-|\n";
  for (const Validation& validation : validations()) {
    const auto found = results.find(std::string(validation.name));
    if (found == results.end()) {
      text += fmt::format("| {} | | | not computed | | | {} |\n", validation.name, validation.against);
      continue;
    }
    if (!found->second.trouble.empty())
      text += fmt::format("| {} | | | {} | | | {} |\n", validation.name, found->second.trouble, validation.against);
    for (const Row& row : found->second.rows)
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", validation.name, row.quantity, row.at,
                          value_text(row.computed, row.unit), reference_text(row), verdict_text(row), row.source);
  }
  text +=
      "\n## Cost\n\nPoints at the end, steps, and processor seconds of one thread.\n\n"
      "| case | points | steps | seconds |\n|-|-:|-:|-:|\n";
  for (const Validation& validation : validations())
    if (const auto found = results.find(std::string(validation.name)); found != results.end())
      text += fmt::format("| {} | {:.0f} | {:.0f} | {:.0f} |\n", validation.name, found->second.points,
                          found->second.steps, found->second.seconds);
  text += "\n## The figures of the five studies\n\n| study | figure | shows | here |\n|-|-|-|-|\n";
  for (const PaperFigure& figure : paper_figures())
    text += fmt::format("| {} | {} | {} | {} |\n", figure.study, figure.figure, figure.shows, figure.here);
  return text;
}

std::string validation_report(const std::map<std::string, Result>& results) {
  std::string body = "<h1>Validation</h1>\n";
  for (const Validation& validation : validations()) {
    const auto found = results.find(std::string(validation.name));
    if (found == results.end()) continue;
    const Result& result = found->second;
    body += fmt::format("<section class=\"block\" id=\"{0}\"><h2>{0}</h2>\n<p class=\"lead\">Against {1}: {2}.</p>\n",
                        validation.name, escaped(validation.against), escaped(state_of(results, validation.name)));
    if (result.figure) body += svg_figure(to_svg(draw_chart(*result.figure)), result.figure->title);
    body +=
        "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th>quantity</th><th>at</th><th "
        "class=\"number\">computed</th>"
        "<th class=\"number\">reference</th><th>verdict</th><th>source</th></tr></thead><tbody>\n";
    for (const Row& row : result.rows) {
      const bool bad = row.verdict == Verdict::outside || row.verdict == Verdict::not_reached;
      body += fmt::format(
          "<tr><td>{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"{}\">{}</td>"
          "<td>{}</td></tr>\n",
          escaped(row.quantity), escaped(row.at), escaped(value_text(row.computed, row.unit)),
          escaped(reference_text(row)), bad ? "fail" : "pass", verdict_text(row), escaped(row.source));
    }
    body += fmt::format("</tbody></table></div>\n<p>{:.0f} points, {:.0f} steps, {:.0f} s.</p></section>\n",
                        result.points, result.steps, result.seconds);
  }
  return render_plain_page("Validation", body);
}

}  // namespace polder::validate
