#include "polder/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "polder/report/audit.hpp"
#include "polder/report/html.hpp"
#include "polder/report/style.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/chart.hpp"
#include "polder/result/history.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/picture_files.hpp"
#include "polder/result/summary.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string text_of(const Json& json, const char* key, const std::string& otherwise = "") {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

struct Run {
  fs::path folder;
  Json summary;     ///< null while the run goes on
  History history;  ///< without columns where there is none
};

Run read_run(const fs::path& folder) {
  Run run{folder, {}, {}};
  if (fs::exists(folder / "summary.json")) run.summary = read_json(folder / "summary.json");
  if (fs::exists(folder / "history.csv")) run.history = read_history(folder / "history.csv");
  if (run.summary.is_null() && run.history.columns.empty())
    throw std::runtime_error(folder.string() + ": there is neither summary.json nor history.csv: no run wrote here");
  return run;
}

std::string title_of(const Run& run) {
  const fs::path whole = fs::absolute(run.folder).lexically_normal();
  const std::string folder = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  const Json inputs = run.summary.is_object() ? run.summary.value("case", Json()) : Json();
  if (!inputs.is_object()) return folder;
  const Json model = inputs.value("model", Json());
  for (const Json& place : {inputs, model})
    for (const char* key : {"title", "name"})
      if (place.is_object() && !text_of(place, key).empty()) return text_of(place, key);
  return folder;
}

std::string head_of(const Run& run) {
  const std::string status = run.summary.is_null() ? "running" : text_of(run.summary, "status", "running");
  std::string reason = text_of(run.summary, "reason");
  if (run.summary.is_null() && run.history.rows() > 0)
    reason = "The last row of its history is at t = " + time_text(run.history.values[0].back()) + ".";
  std::string html = html::text_element("h1", title_of(run));
  html += html::element("p", fmt::format("<span class=\"status {0}\">{0}</span>{1}", escaped(status), escaped(reason)));
  std::string facts;
  for (const Fact& fact : run_facts(run.summary))
    facts += html::element("div", html::text_element("dt", fact.label) + html::text_element("dd", fact.value));
  return html + (facts.empty() ? "" : html::element("dl", facts, "class=\"facts\""));
}

std::string model_of(const Run& run) {
  for (const char* file : {"model.svg", "pictures/model.svg", "pictures/model.png"}) {
    if (!fs::exists(run.folder / file)) continue;
    const std::string type = fs::path(file).extension() == ".svg" ? "image/svg+xml" : "image/png";
    return html::section("model", "Model",
                         html::picture(type, bytes_of(run.folder / file), "The model as it was computed"));
  }
  return "";
}

// The instants of one quantity, one shown at a time: radio buttons and style sheets do it without a script.
std::string instants(const std::string& field, const std::vector<fs::path>& pictures) {
  std::string buttons, figures, rules;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::string time = time_text(parse_picture_name(pictures[i].filename().string())->time);
    buttons += fmt::format("<input type=\"radio\" name=\"{0}\" id=\"{0}-{1}\"{2}><label for=\"{0}-{1}\">{3}</label>",
                           escaped(field), i, i + 1 == pictures.size() ? " checked" : "", time);
    figures += html::element(
        "figure", html::picture("image/png", bytes_of(pictures[i]), field_info(field).label + " at " + time));
  }
  return html::text_element("h3", field_info(field).label) +
         html::element("div", buttons + figures, "class=\"instants\"");
}

// "The n-th button shows the n-th figure", for as many instants as there are.
std::string instant_rules(std::size_t count) {
  std::string rules;
  for (std::size_t i = 1; i <= count; ++i)
    rules +=
        fmt::format(".instants > input:nth-of-type({0}):checked ~ figure:nth-of-type({0}) {{ display: block; }}\n", i);
  return html::element("style", rules);
}

std::string pictures_of(const Run& run) {
  const std::vector<fs::path> all = list_pictures(run.folder);
  std::string html;
  std::size_t most = 0;
  for (auto begin = all.begin(); begin != all.end();) {
    const auto field = [](const fs::path& path) { return parse_picture_name(path.filename().string())->field; };
    const auto end = std::find_if(begin, all.end(), [&](const fs::path& path) { return field(path) != field(*begin); });
    most = std::max(most, static_cast<std::size_t>(end - begin));
    html += instants(field(*begin), {begin, end});
    begin = end;
  }
  return html.empty() ? "" : html::section("pictures", "Pictures", instant_rules(most) + html);
}

std::string curves_of(const Run& run) {
  if (run.history.rows() == 0) return "";
  std::string html;
  for (const Chart& chart : history_charts(run.history)) html += html::element("figure", to_svg(draw_chart(chart)));
  return html.empty() ? "" : html::section("curves", "Histories", html::element("div", html, "class=\"curves\""));
}

std::string audit_of(const Run& run) {
  html::Table table{{"quantity", "value", "demand", "verdict", "meaning"}, {}, {false, true}};
  for (const AuditRow& row : audit(run.summary))
    table.rows.push_back({row.quantity, number_text(row.value), row.demand, row.verdict, row.meaning});
  return table.rows.empty() ? "" : html::section("audit", "Audit", html::table(table));
}

std::string numbers_of(const Run& run, const char* key, const char* title, const char* unit) {
  const Json numbers = run.summary.is_object() ? run.summary.value(key, Json()) : Json();
  html::Table table{{"", unit}, {}, {false, true}};
  for (const auto& [name, value] : numbers.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    table.rows.push_back({words, value.is_number() ? number_text(value.get<double>()) : "–"});
  }
  return table.rows.empty() ? "" : html::section(key, title, html::table(table));
}

std::string inputs_of(const Run& run) {
  const Json inputs = run.summary.is_object() ? run.summary.value("case", Json()) : Json();
  if (inputs.empty()) return "";
  return html::section(
      "inputs", "All inputs",
      html::text_element("p", "With every default filled in; SI units.", "class=\"soft\"") + html::outline(inputs));
}

std::string foot_of(const Run& run) {
  std::string links;
  for (const char* file : {"points.pvd", "history.csv", "summary.json", "log.txt"})
    if (fs::exists(run.folder / file)) links += fmt::format("<a href=\"{0}\">{0}</a> ", file);
  const std::string version = text_of(run.summary, "version"), hash = text_of(run.summary, "state_hash");
  std::string words = "Polder" + (version.empty() ? "" : " " + version);
  if (!hash.empty()) words += ", state " + hash;
  return html::element(
      "footer", html::text_element("p", words, "class=\"soft\"") + html::element("p", "Beside this page: " + links));
}

}  // namespace

std::string report_page(const fs::path& folder, const ReportOptions& options) {
  const Run run = read_run(folder);
  std::string head =
      "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  if (options.reload_seconds > 0 && run.summary.is_null())
    head += fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">\n", options.reload_seconds);
  head += html::text_element("title", title_of(run)) + html::element("style", report_style);
  const std::string body =
      head_of(run) + pictures_of(run) + curves_of(run) + audit_of(run) + numbers_of(run, "energy", "Energy", "J") +
      numbers_of(run, "maxima", "Largest values", "SI") +
      numbers_of(run, "kernel_seconds", "Where the time went", "s") + model_of(run) + inputs_of(run) + foot_of(run);
  return "<!doctype html>\n<html lang=\"en\">\n" + html::element("head", head) +
         html::element("body", html::element("main", body)) + "</html>\n";
}

void write_report(const fs::path& folder, const ReportOptions& options) {
  write_atomically(folder / "report.html", report_page(folder, options));
}

}  // namespace polder
