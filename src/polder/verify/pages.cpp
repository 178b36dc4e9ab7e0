#include "polder/verify/pages.hpp"

#include <fmt/format.h>

#include "polder/report/page.hpp"
#include "polder/result/paint.hpp"

namespace polder::verify {

namespace {

std::string number(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}g}", *value, digits) : "";
}

std::string verdict(const Row& row) { return !row.pass ? "short" : row.tolerance ? "ok" : ""; }

std::string html_rows(const Outcome& outcome) {
  std::string text;
  for (const Row& row : outcome.rows)
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{:.5g}</td>"
        "<td class=\"number\">{}</td><td class=\"number\" title=\"{}\">{}</td><td class=\"{}\">{}</td></tr>\n",
        escaped(row.quantity), escaped(row.at), number(row.reference, 5), row.computed, number(row.error, 2),
        escaped(row.source), number(row.tolerance, 2), row.pass ? "pass" : "fail", verdict(row));
  return text;
}

}  // namespace

std::string report_page(const std::vector<const Problem*>& problems, const std::vector<Outcome>& outcomes) {
  std::string body = "<h1>Verification</h1>\n";
  int passed = 0;
  double seconds = 0;
  for (const Outcome& outcome : outcomes) {
    passed += outcome.pass();
    if (!outcome.rows.empty()) seconds += outcome.rows.front().seconds;
  }
  body += fmt::format("<p>{} of {} problems are within their tolerances; computed in {:.0f} s.</p>\n", passed,
                      outcomes.size(), seconds);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const Problem& problem = *problems[i];
    body += fmt::format("<section class=\"block\" id=\"{0}\"><h2>{0}</h2>\n<p class=\"lead\">{1}. Exact: {2}.</p>\n",
                        problem.name, escaped(problem.title), escaped(problem.theory));
    if (!outcomes[i].trouble.empty()) body += fmt::format("<p class=\"fail\">{}</p>\n", escaped(outcomes[i].trouble));
    if (outcomes[i].figure) body += svg_figure(to_svg(draw_chart(*outcomes[i].figure)), outcomes[i].figure->title);
    body += "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + escaped(problem.name) +
            "\"><table><thead><tr><th>quantity</th><th>place</th><th class=\"number\">reference</th>"
            "<th class=\"number\">computed</th><th class=\"number\">error</th><th class=\"number\">tolerance</th>"
            "<th>verdict</th></tr></thead><tbody>\n" +
            html_rows(outcomes[i]) + "</tbody></table></div></section>\n";
  }
  return render_plain_page("Verification", body);
}

std::string verification_page(const std::vector<const Problem*>& problems, const std::vector<Outcome>& outcomes) {
  std::string text =
      "# Verification\n\n<!-- Written by `polder verify --docs`; do not edit. -->\n\n"
      "Each problem is a case under `cases/` (most in `cases/verify/`) that `polder run` takes too, and an exact "
      "answer "
      "coded in\n`src/polder/verify/`. `polder verify` recomputes this table; tolerances and their sources stand in "
      "the "
      "`expected.toml`\nbeside each case. Errors are relative to the reference unless the place says of what. An "
      "observed order of convergence\ncompares the default grid with a coarser one (`ergun-column`: the step with one "
      "of "
      "twice its length). Rows without a\ntolerance are reported only.\n\n"
      "| problem | quantity | place | reference | computed | error | tolerance | |\n|-|-|-|-|-|-|-|-|\n";
  for (const Outcome& outcome : outcomes)
    for (const Row& row : outcome.rows)
      text += fmt::format("| {} | {} | {} | {} | {:.5g} | {} | {} | {} |\n", row.problem, row.quantity, row.at,
                          number(row.reference, 5), row.computed, number(row.error, 2), number(row.tolerance, 2),
                          verdict(row));
  text += "\n## The problems\n\n";
  for (const Problem* problem : problems)
    text += fmt::format("- **{}**: {}. Exact: {}.\n", problem->name, problem->title, problem->theory);
  return text;
}

}  // namespace polder::verify
