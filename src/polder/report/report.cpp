#include "polder/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "polder/report/audit.hpp"
#include "polder/report/case_tables.hpp"
#include "polder/report/comparison.hpp"
#include "polder/report/run_points.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/history.hpp"
#include "polder/result/paint.hpp"
#include "polder/result/summary.hpp"
#include "polder/result/ticks.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string text_of(const Json& json, const char* key, const std::string& otherwise = "") {
  if (!json.is_object()) return otherwise;
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

double number_of(const Json& json, const char* key) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_number()) return std::nan("");
  return json[key].get<double>();
}

std::string title_of(const fs::path& folder, const Json& inputs, const RunPoints& points) {
  const Json model = inputs.is_object() ? inputs.value("model", Json()) : Json();
  for (const std::string& title :
       {text_of(model, "title"), text_of(inputs, "title"), points.title, text_of(inputs, "name")})
    if (!title.empty()) return title;
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// Value and unit apart: "0.881", "m".
PageFact length_fact(const char* label, double metres, double largest, std::string note) {
  const DisplayUnit unit = display_unit("m", largest);
  return {label, number_text(metres / unit.factor), unit.name, std::move(note)};
}

std::string metres_text(double metres) { return number_text(metres) + " m"; }

/// The residual crest height and the run-out, where soil has moved by more than half a point's spacing; else how far it
/// has moved at most.
void add_shape_facts(Page& page, const RunPoints& points) {
  const SoilShape &first = points.first, &last = points.last;
  if (!first.any || !last.any) return;
  const double half = 0.5 * points.soil_spacing;
  const double reach = run_out(first, last);
  const bool still = std::abs(last.crest - first.crest) < half && reach < half && last.moved < half;
  if (still && last.moved > 1e-3 * half)
    page.facts.push_back(length_fact("Largest displacement", last.moved, last.moved, "of the soil"));
  if (still) return;
  page.facts.push_back(
      length_fact("Residual crest height", last.crest, last.crest, "of " + metres_text(first.crest) + " at the start"));
  page.facts.push_back(reach < half ? PageFact{"Run-out", "none", "", "the soil keeps its first extent"}
                                    : length_fact("Run-out", reach, reach, "beyond the soil's first extent"));
  if (last.moved > 0) page.facts.push_back(length_fact("Largest displacement", last.moved, last.moved, "of the soil"));
}

void add_run_facts(Page& page, const Json& summary) {
  const double simulated = number_of(summary, "simulated_time"), wall = number_of(summary, "wall_seconds");
  if (!std::isnan(simulated)) {
    const std::string text = time_text(simulated);
    const std::size_t gap = text.rfind(' ');
    std::string note = std::isnan(wall) ? "" : "in " + time_text(wall);
    const double threads = number_of(summary, "threads");
    if (!note.empty() && threads >= 1) note += fmt::format(" on {:.0f} thread{}", threads, threads > 1 ? "s" : "");
    page.facts.push_back(
        {"Simulated", text.substr(0, gap), gap == std::string::npos ? "" : text.substr(gap + 1), note});
  }
  if (const double error = number_of(summary, "water_balance_error"); !std::isnan(error))
    page.facts.push_back({"Water balance error", number_text(error), "", "of the water at the start"});
}

std::string summary_sentence(const Json& summary, const RunPoints& points, const History& history) {
  std::vector<std::string> parts;
  if (!points.times.empty())
    parts.push_back(fmt::format("{}, {} × {} m", points.dimension == 3 ? "Three dimensions, section" : "Plane strain",
                                number_text(points.size[0]), number_text(points.size[1])));
  for (const Fact& fact : run_facts(summary))
    if ((fact.label == "soil points" || fact.label == "water points") && fact.value != "0")
      parts.push_back(fact.value + " " + fact.label);
  std::string text = fmt::format("{}", fmt::join(parts, ", "));
  if (!text.empty()) text += ". ";
  std::string reason = text_of(summary, "reason");
  if (summary.is_null() && history.rows() > 0)
    reason = "The run goes on; its last row is at t = " + time_text(history.values[0].back());
  const bool symbol = reason.size() > 1 && reason[1] == ' ';  // "t = 3 s is reached" begins with one
  if (!symbol && !reason.empty() && reason[0] >= 'a' && reason[0] <= 'z')
    reason[0] = static_cast<char>(reason[0] - 'a' + 'A');
  if (!reason.empty() && reason.back() != '.') reason += '.';
  return text + reason;
}

PageTable audit_table(const Json& summary) {
  PageTable table{"audit", "Audit", "", {"Quantity", "Value", "Demand", "Verdict", "Meaning"}, {false, true}, {}};
  table.numeric.resize(table.columns.size(), false);
  for (const AuditRow& row : audit(summary)) {
    const auto state = row.verdict == "kept"       ? PageCell::State::pass
                       : row.verdict == "not kept" ? PageCell::State::fail
                                                   : PageCell::State::none;
    table.rows.push_back({{row.quantity}, {number_text(row.value)}, {row.demand}, {row.verdict, state}, {row.meaning}});
  }
  return table;
}

PageTable cost_table(const Json& summary) {
  PageTable table{"cost", "Cost", "", {"Quantity", "Value"}, {false, true}, {}};
  for (const Fact& fact : run_facts(summary)) table.rows.push_back({{fact.label}, {fact.value}});
  return table;
}

PageTable numbers_table(const Json& summary, const char* key, const char* title, const char* unit) {
  PageTable table{key, title, "", {"Quantity", unit}, {false, true}, {}};
  const Json numbers = summary.is_object() ? summary.value(key, Json::object()) : Json::object();
  for (const auto& [name, value] : numbers.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (std::string_view(key) == "kernel_seconds" && value == 0) continue;  // what this formulation does not use
    table.rows.push_back({{words}, {value.is_number() ? number_text(value.get<double>()) : "–"}});
  }
  return table;
}

std::string any_text(const Json& row, const char* key) {
  if (!row.contains(key) || row[key].is_null()) return "–";
  return row[key].is_number()   ? number_text(row[key].get<double>())
         : row[key].is_string() ? row[key].get<std::string>()
                                : row[key].dump();
}

PageTable validation_table(const fs::path& folder) {
  PageTable table{
      "validation", "Validation", "", {"Quantity", "At", "Reference", "Computed", "Error", "Tolerance"}, {}, {}};
  table.numeric = {false, false, true, true, true, true};
  if (!fs::exists(folder / "comparison.json")) return table;
  for (const Json& row : read_json(folder / "comparison.json")) {
    const bool pass = row.value("pass", false);
    table.rows.push_back({{any_text(row, "quantity")},
                          {any_text(row, "at")},
                          {any_text(row, "reference")},
                          {any_text(row, "computed")},
                          {any_text(row, "error"), pass ? PageCell::State::pass : PageCell::State::fail},
                          {any_text(row, "tolerance")}});
  }
  return table;
}

/// expected.toml in the folder, where a run puts a copy of it, or else beside the case file.
void add_comparison(Page& page, const fs::path& folder, const RunPoints& points) {
  fs::path file = folder / "expected.toml";
  if (const std::string origin = text_of(page.inputs, "file"); !fs::exists(file) && !origin.empty())
    file = fs::path(origin).parent_path() / "expected.toml";
  try {
    const auto compared = compare(read_expectations(file), page.history, points.first, points.last);
    if (compared.empty()) return;
    page.tables.push_back(comparison_table(compared));
    if (const std::optional<PageFact> fact = comparison_fact(compared)) page.facts.push_back(*fact);
  } catch (const std::runtime_error& error) {  // a slip in that file must not cost the page of a long run
    page.notes.push_back(fmt::format("No comparison: {}.", error.what()));
  }
}

void add_model_drawing(Page& page, const fs::path& folder) {
  for (const char* name : {"model.svg", "pictures/model.svg", "pictures/model.png"}) {
    std::ifstream file(folder / name, std::ios::binary);
    if (!file) continue;
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::string type = fs::path(name).extension() == ".svg" ? "image/svg+xml" : "image/png";
    page.figures.push_back({"The model as it was computed", "data:" + type + ";base64," + base64(bytes)});
    return;
  }
}

}  // namespace

Page run_page(const fs::path& folder, const ReportOptions& options) {
  Json summary;
  Page page;
  if (fs::exists(folder / "summary.json")) summary = read_json(folder / "summary.json");
  if (fs::exists(folder / "history.csv")) page.history = read_history(folder / "history.csv");
  if (summary.is_null() && page.history.columns.empty())
    throw std::runtime_error(folder.string() + ": there is neither summary.json nor history.csv: no run wrote here");
  if (summary.is_object()) page.inputs = summary.value("case", Json());

  RunPoints points = read_run_points(folder, material_names(page.inputs));
  page.title = title_of(folder, page.inputs, points);
  page.summary = summary_sentence(summary, points, page.history);
  page.status = summary.is_null() ? "running" : text_of(summary, "status", "running");
  page.reason = text_of(summary, "reason");
  page.version = text_of(summary, "version");
  if (const std::string hash = text_of(summary, "state_hash"); !hash.empty()) page.version += ", state " + hash;
  page.reload_seconds = page.status == "running" ? options.reload_seconds : 0;
  page.size = points.size;
  add_shape_facts(page, points);
  add_run_facts(page, summary);
  page.notes = points.notes;
  page.times = points.times;
  page.outlines = points.outlines;
  page.walls = points.walls;
  page.monitors = page_monitors(page.inputs, points.dimension == 3 ? 2 : 1);
  if (points.dimension == 2) page.levels = page_levels(page.inputs);
  if (points.soil.entries() > 0) page.points.push_back({encode(points.soil), points.soil_spacing});
  if (points.water.entries() > 0) page.points.push_back({encode(points.water), points.water_spacing});

  add_comparison(page, folder, points);
  page.tables.push_back(validation_table(folder));
  add_model_drawing(page, folder);
  for (PageTable& table : case_tables(page.inputs)) page.tables.push_back(std::move(table));
  page.tables.push_back(audit_table(summary));
  page.tables.push_back(numbers_table(summary, "energy", "Energy", "J"));
  page.tables.push_back(numbers_table(summary, "maxima", "Largest values", "SI"));
  page.tables.push_back(cost_table(summary));
  page.tables.push_back(numbers_table(summary, "kernel_seconds", "Where the time went", "s"));
  return page;
}

void write_report(const fs::path& folder, const ReportOptions& options) {
  write_atomically(folder / "report.html", render_page(run_page(folder, options)));
}

}  // namespace polder
