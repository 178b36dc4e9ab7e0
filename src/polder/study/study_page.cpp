#include "polder/study/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polder/report/page.hpp"
#include "polder/result/chart.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/ticks.hpp"
#include "polder/result/vtk_reader.hpp"
#include "polder/study/profile.hpp"

namespace polder::study {
namespace {

std::string block(const std::string& title, const std::string& body) {
  return fmt::format("<section class=\"block\"><h2>{}</h2>\n{}</section>\n", escaped(title), body);
}

std::string figure(const Chart& chart) { return svg_figure(to_svg(draw_chart(chart)), chart.title); }

/// Side by side where there is room.
std::string figures(const std::string& list) { return "<div class=\"figures\">\n" + list + "</div>\n"; }

std::string value_text(const Comparison& c) {
  if (!c.computed) return "–";
  const DisplayUnit unit = display_unit(c.unit, std::abs(*c.computed));
  std::string name = unit.name == "m2" ? "m²" : unit.name == "m3" ? "m³" : unit.name;
  return number_text(*c.computed / unit.factor) + (name.empty() ? "" : "\u202f" + name);
}

std::string member_table(const Study& study, const std::vector<MemberResult>& results) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Members\"><table><thead><tr><th>page</th>";
  for (const std::string& label : study.labels) html += fmt::format("<th class=\"number\">{}</th>", escaped(label));
  for (const Measure& measure : study.measures)
    html += fmt::format("<th class=\"number\">{}</th>", escaped(measure.what.quantity));
  html +=
      "<th class=\"number\">points</th><th class=\"number\">steps</th><th class=\"number\">seconds</th></tr></thead>"
      "<tbody>\n";
  for (std::size_t i = 0; i < study.members.size(); ++i) {
    const Member& member = study.members[i];
    const MemberResult& result = results[i];
    const bool done = result.status == "finished";
    html += done ? fmt::format("<tr><td><a href=\"{}/report.html\">report</a></td>", escaped(member.folder))
                 : fmt::format("<tr><td class=\"fail\">{}</td>", escaped(result.status));
    for (const std::string& value : member.values) html += fmt::format("<td class=\"number\">{}</td>", escaped(value));
    for (std::size_t m = 0; m < study.measures.size(); ++m)
      html += fmt::format("<td class=\"number\">{}</td>",
                          m < result.measures.size() ? escaped(value_text(result.measures[m])) : "–");
    html += fmt::format(
        "<td class=\"number\">{:.0f}</td><td class=\"number\">{:.0f}</td><td class=\"number\">{:.0f}</td></tr>\n",
        result.points, result.steps, result.seconds);
  }
  return html + "</tbody></table></div>\n";
}

Chart curve_chart(const Study& study, const std::vector<MemberResult>& results, const std::string& column) {
  Chart chart{column, "time", column, "s", "", {}, {}};
  for (std::size_t i = 0; i < study.members.size(); ++i) {
    const History& history = results[i].history;
    if (history.columns.empty()) continue;
    const auto found = std::find_if(history.columns.begin(), history.columns.end(),
                                    [&](const HistoryColumn& c) { return c.name == column; });
    if (found == history.columns.end())
      throw std::runtime_error(
          fmt::format("the study asks for the curve '{}', which history.csv does not have", column));
    chart.vertical_unit = found->unit;
    const auto k = static_cast<std::size_t>(found - history.columns.begin());
    chart.curves.push_back(thinned({study.members[i].name, history.values[0], history.values[k], false}, 800));
  }
  return chart;
}

/// The snapshot nearest to a time, if one is there.
std::optional<Frame> snapshot(const std::filesystem::path& folder, double time) {
  const VtkSeries series = read_pvd(folder / "points.pvd");
  std::optional<std::size_t> best;
  for (std::size_t k = 0; 2 * k < series.size(); ++k)
    if (!best || std::abs(series[2 * k].time - time) < std::abs(series[2 * *best].time - time)) best = k;
  if (!best) return {};
  return read_snapshot(folder, series, *best);
}

void add_profile(Chart& chart, const std::string& name, const Profile& profile, const Profiles& wanted) {
  Curve curve{name, {}, {}, false};
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    if (wanted.span && (profile.x[i] < (*wanted.span)[0] || profile.x[i] > (*wanted.span)[1])) continue;
    curve.x.push_back(profile.x[i]);
    curve.y.push_back(profile.height[i]);
  }
  if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
}

Chart profile_chart(const Study& study, const std::filesystem::path& folder, double time, bool water) {
  Chart chart{fmt::format("{} at {}", water ? "Water surface" : "Soil surface", time_text(time)),
              "x",
              "height",
              "m",
              "m",
              {},
              {}};
  chart.width = 760;
  for (const Member& member : study.members) {
    const auto frame = snapshot(folder / member.folder, time);
    if (!frame) continue;
    const int up = frame->dimension == 3 ? 2 : 1;
    add_profile(chart, member.name, surface(water ? frame->water : frame->soil, up, !water), study.profiles);
  }
  return chart;
}

}  // namespace

std::string study_page(const Study& study, const std::vector<MemberResult>& results,
                       const std::filesystem::path& folder) {
  std::string body = fmt::format("<h1>{}</h1>\n", escaped(study.title));
  if (!study.note.empty()) body += fmt::format("<p class=\"lead\">{}</p>\n", escaped(study.note));
  const auto verdicts = judge(study, results);
  if (!verdicts.empty()) {
    std::string list = "<ul>\n";
    for (const Verdict& verdict : verdicts)
      list += fmt::format("<li>{}: <span class=\"{}\">{}</span></li>\n", escaped(verdict.text),
                          verdict.kept ? "pass" : "fail", verdict.kept ? "yes" : "no");
    body += block("What it must show", list + "</ul>\n");
  }
  body += block("Members", member_table(study, results));
  std::string curves, profiles;
  for (const std::string& column : study.curves)
    if (const Chart chart = curve_chart(study, results, column); !chart.curves.empty()) curves += figure(chart);
  if (!curves.empty()) body += block("Curves", figures(curves));
  for (const double time : study.profiles.times) {
    if (const Chart chart = profile_chart(study, folder, time, false); !chart.curves.empty()) profiles += figure(chart);
    if (!study.profiles.water) continue;
    if (const Chart chart = profile_chart(study, folder, time, true); !chart.curves.empty()) profiles += figure(chart);
  }
  if (!profiles.empty()) body += block("Profiles", figures(profiles));
  return render_plain_page(study.title, body);
}

}  // namespace polder::study
