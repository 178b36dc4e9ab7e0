#include "polder/report/stability_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "polder/report/page.hpp"
#include "polder/report/section_drawing.hpp"
#include "polder/result/chart.hpp"
#include "polder/result/paint.hpp"

namespace polder {
namespace {

using namespace stability;

std::string figure(const Drawing& drawing, const std::string& caption, bool as_svg) {
  const std::string bytes = as_svg ? to_svg(drawing) : to_png(drawing);
  return fmt::format(
      "<figure class=\"drawing\"><img alt=\"{0}\" src=\"data:{1};base64,{2}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(caption), as_svg ? "image/svg+xml" : "image/png", base64(bytes));
}

std::string block(const std::string& title, const std::string& lead, const std::string& body) {
  std::string html = fmt::format("<section class=\"block\"><h2>{}</h2>\n", escaped(title));
  if (!lead.empty()) html += fmt::format("<p class=\"lead\">{}</p>\n", escaped(lead));
  return html + body + "</section>\n";
}

std::string table(const std::vector<std::string>& columns, const std::vector<std::vector<std::string>>& rows,
                  std::size_t texts) {
  std::string html = "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>";
  for (std::size_t i = 0; i < columns.size(); ++i)
    html += fmt::format("<th{}>{}</th>", i < texts ? "" : " class=\"number\"", escaped(columns[i]));
  html += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      html += fmt::format("<td{}>{}</td>", i < texts ? "" : " class=\"number\"", row[i]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string factor_text(const Factor& row) { return row.outcome ? fmt::format("{:.3f}", row.factor) : "–"; }

std::string factor_table(const Assessment& all) {
  std::vector<std::vector<std::string>> rows;
  for (const Factor& row : all.factors) {
    std::string verdict;
    if (row.expected)
      verdict = row.pass() ? "<span class=\"pass\">within</span>" : "<span class=\"fail\">outside</span>";
    rows.push_back(
        {escaped(row.label), escaped(row.outcome ? row.outcome.remark : row.outcome.problem),
         fmt::format("<b>{}</b>", factor_text(row)),
         row.expected ? fmt::format("{:.3f} ± {:.1f} %", row.expected->reference, 100 * row.expected->tolerance) : "",
         verdict, fmt::format("{:.2f}", row.seconds)});
  }
  return table({"Method", "Surface", "Factor of safety", "Reference", "Verdict", "Seconds"}, rows, 2);
}

std::string checks_block(const Assessment& all) {
  std::vector<std::vector<std::string>> rows;
  for (const DikeCheck& check : all.checks) {
    const bool safe = check.problem.empty() && check.factor >= 1;
    const std::string factor = !check.problem.empty()     ? "–"
                               : std::isinf(check.factor) ? "nothing drives"
                                                          : fmt::format("{:.3f}", check.factor);
    rows.push_back({escaped(check.label), escaped(check.problem.empty() ? check.remark : check.problem),
                    escaped(check.water), "<b>" + factor + "</b>",
                    fmt::format("<span class=\"{}\">{}</span>", safe ? "pass" : "fail", safe ? "holds" : "fails"),
                    check.expected
                        ? fmt::format("{:.3f} ± {:.1f} %", check.expected->reference, 100 * check.expected->tolerance)
                        : ""});
  }
  return block("Dike checks", "A dike fails by piping only where uplift, heave and piping all go wrong.",
               table({"Check", "Numbers", "Water", "Factor", "", "Reference"}, rows, 3));
}

std::string references(const Assessment& all) {
  std::string html;
  for (const Factor& row : all.factors)
    if (row.expected && !row.expected->source.empty())
      html += fmt::format("<li>{}: {}</li>\n", escaped(row.label), escaped(row.expected->source));
  return html.empty() ? html : "<ul class=\"notes\">\n" + html + "</ul>\n";
}

std::string slice_table(const Slices& slices) {
  std::vector<std::vector<std::string>> rows;
  for (const Slice& s : slices.list)
    rows.push_back({fmt::format("{:.2f} to {:.2f}", s.left, s.right), fmt::format("{:.2f}", s.base()),
                    fmt::format("{:.2f}", s.top() - s.base()), fmt::format("{:.1f}", s.angle * 57.29577951308232),
                    fmt::format("{:.1f}", s.weight / 1e3), fmt::format("{:.1f}", s.pore_pressure / 1e3),
                    fmt::format("{:.1f}", s.effective_stress / 1e3), fmt::format("{:.1f}", s.cohesion / 1e3),
                    fmt::format("{:.3f}", s.tan_friction)});
  return table({"x (m)", "Base (m)", "Height (m)", "Angle (°)", "Weight (kN/m)", "Pore pressure (kPa)", "σ'v (kPa)",
                "c or s_u (kPa)", "tan φ"},
               rows, 1);
}

std::string slices_block(const Factor& row, const StudySection& section) {
  const SearchResult& found = *row.outcome.search;
  std::string body = figure(draw_slip(section.prepared, &found, fmt::format("{}: F = {:.3f}", row.label, row.factor)),
                            fmt::format("{}; {} surfaces tried", row.outcome.remark, found.trials), true);
  if (!found.contours.empty())
    body += figure(draw_centres(section.prepared, found),
                   "Each square is a centre, its colour the least factor with it", false);
  body += fmt::format("<details class=\"inputs\"><summary>{} slices</summary>{}</details>\n", found.slices.list.size(),
                      slice_table(found.slices));
  return block(row.label, "", body);
}

std::string reduction_block(const Factor& row, const StudySection& section) {
  const SectionReduction& reduction = *row.outcome.reduction;
  const StrengthReductionResult& result = reduction.result;
  TriangleField shear = gauss_field(reduction.mesh, result.shear);
  shear.title = fmt::format("{}: F = {:.3f}, shear of the mechanism", row.label, row.factor);
  shear.map = ColourMap::strain;
  shear.from_zero = true;
  // Arrows of the mechanism on every so many nodes, the longest a twentieth of the section.
  double most = 0, width = section.prepared.right() - section.prepared.left();
  const std::size_t nodes = reduction.mesh.nodes.size();
  for (std::size_t n = 0; n < nodes && 2 * n + 1 < result.mechanism.size(); ++n)
    most = std::max(most, std::hypot(result.mechanism[2 * n], result.mechanism[2 * n + 1]));
  const std::size_t every = std::max<std::size_t>(1, nodes / 500);
  for (std::size_t n = 0; n < nodes && most > 0; n += every) {
    const Point2& p = reduction.mesh.nodes[n];
    const double scale = width / 20 / most;
    shear.arrows.push_back({p, {p[0] + scale * result.mechanism[2 * n], p[1] + scale * result.mechanism[2 * n + 1]}});
  }
  Chart chart;
  chart.title = "Displacement as the strength is reduced";
  chart.horizontal = "strength reduction factor F";
  chart.vertical = "largest displacement";
  chart.vertical_unit = "m";
  Curve stable{"in equilibrium", {}, {}, false}, failed{"no equilibrium", {}, {}, true};
  for (const auto& p : result.curve) {
    Curve& curve = p.converged && !p.runs_away ? stable : failed;
    curve.x.push_back(p.factor), curve.y.push_back(p.displacement);
  }
  chart.curves = {stable, failed};
  return block(
      row.label, row.outcome.remark,
      figure(draw_field(reduction.mesh, shear), "Increments of displacement at failure, their shear in colour", false) +
          figure(draw_chart(chart), "Each point is one equilibrium sought", true));
}

std::string probability_block(const Assessment& all) {
  std::string body;
  for (const Probability& p : all.probabilities) {
    const Reliability& r = p.reliability;
    std::vector<std::vector<std::string>> rows{{"Reliability index β", fmt::format("{:.2f}", r.index)},
                                               {"Probability of failure", fmt::format("{:.3g}", r.probability)},
                                               {"Factors computed", fmt::format("{}", r.evaluations)}};
    if (p.kind != "FORM") rows.push_back({"Standard error of the probability", fmt::format("{:.2g}", r.deviation)});
    if (!r.converged) rows.push_back({"Converged", "<span class=\"fail\">no</span>"});
    body += fmt::format("<h3>{} with {}</h3>\n", p.kind, escaped(p.method));
    body += table({"Quantity", "Value"}, rows, 1);
    if (r.influence.empty()) continue;
    rows.clear();
    for (std::size_t i = 0; i < r.influence.size(); ++i)
      rows.push_back(
          {escaped(p.uncertain[i]), fmt::format("{:.2f}", r.influence[i]), fmt::format("{:+.2f}", r.design_point[i])});
    body += table({"Uncertain", "Influence α²", "At failure (standard deviations)"}, rows, 1);
  }
  return block("Probability of failure",
               "Strengths are lognormal and independent between soils, heads rise together and are normal.", body);
}

std::string facts(const Assessment& all) {
  const Factor* least = nullptr;
  std::string html = "<dl class=\"facts\">\n";
  const auto fact = [&](const std::string& label, const std::string& value, const std::string& note) {
    html += fmt::format(
        "<div class=\"fact\"><dt>{}</dt><dd><span class=\"value\">{}</span><span "
        "class=\"fact-note\">{}</span></dd></div>\n",
        escaped(label), escaped(value), escaped(note));
  };
  for (const Factor& row : all.factors)
    if (row.outcome && row.strengths == Strengths::given && (least == nullptr || row.factor < least->factor))
      least = &row;
  if (least != nullptr) fact("Least factor of safety", factor_text(*least), "by " + least->label);
  for (const Factor& row : all.factors)
    if (row.strengths == Strengths::given) fact(row.label, factor_text(row), row.water);
  for (const Probability& p : all.probabilities)
    fact("β by " + p.kind, fmt::format("{:.2f}", p.reliability.index),
         fmt::format("probability of failure {:.2g}", p.reliability.probability));
  return html + "</dl>\n";
}

}  // namespace

std::string stability_page(const Assessment& all, const std::string& version) {
  const std::string title = all.title.empty() ? all.name : all.title;
  std::string body = fmt::format(
      "<header class=\"title\"><h1>{}</h1>\n"
      "<p class=\"summary\">Factors of safety of {}. By how much the strength may fall before the section slides; not "
      "how far it then goes.</p></header>\n",
      escaped(title), escaped(all.name));
  body += facts(all);
  for (const std::string& note : all.notes) body += fmt::format("<p class=\"lead\">{}</p>\n", escaped(note));
  body += block("Factors of safety", "", factor_table(all) + references(all));
  if (!all.checks.empty()) body += checks_block(all);
  if (!all.probabilities.empty()) body += probability_block(all);
  for (const Factor& row : all.factors) {
    if (row.strengths != Strengths::given || !row.outcome) continue;
    if (row.outcome.search && *row.outcome.search) body += slices_block(row, all.sections[row.section]);
    if (row.outcome.reduction) body += reduction_block(row, all.sections[row.section]);
  }
  body += fmt::format(
      "<footer><p>Polder {}. What each method assumes, and where it must not be used: docs/limits.md.</p></footer>\n",
      escaped(version));
  return render_plain_page(title, body);
}

}  // namespace polder
