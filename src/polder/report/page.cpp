#include "polder/report/page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "polder/report/viewer.hpp"
#include "polder/result/paint.hpp"

namespace polder {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format_version = 1;

std::string_view name_of(FieldScale scale) {
  switch (scale) {
    case FieldScale::sequential:
      return "sequential";
    case FieldScale::diverging:
      return "diverging";
    case FieldScale::category:
      return "category";
  }
  throw std::logic_error("report: unknown scale");
}

Json json_of(const PageCell& cell) {
  Json json{{"text", cell.text}};
  if (!cell.title.empty()) json["title"] = cell.title;
  if (cell.state != PageCell::State::none) json["state"] = cell.state == PageCell::State::pass ? "pass" : "fail";
  return json;
}

Json json_of(const PageTable& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const PageCell& cell : row) cells.push_back(json_of(cell));
    rows.push_back(cells);
  }
  return {{"id", table.id},           {"title", table.title},     {"note", table.note},
          {"columns", table.columns}, {"numeric", table.numeric}, {"rows", rows}};
}

Json json_of(const History& history) {
  Json columns = Json::array(), values = Json::array();
  for (const HistoryColumn& column : history.columns) columns.push_back({{"name", column.name}, {"unit", column.unit}});
  for (const std::vector<double>& column : history.values) {
    Json list = Json::array();
    // Six digits draw any curve; all of them are in history.csv.
    for (const double v : column) list.push_back(std::isfinite(v) ? Json(std::stod(fmt::format("{:.6g}", v))) : Json());
    values.push_back(list);
  }
  return {{"columns", columns}, {"values", values}};
}

std::string blob_name(const std::string& set, std::size_t number) { return fmt::format("polder-{}-{}", set, number); }

Json json_of(const PagePoints& points) {
  const EncodedSeries& series = points.series;
  Json fields = Json::array();
  for (std::size_t f = 0; f < series.fields.size(); ++f) {
    const EncodedField& field = series.fields[f];
    fields.push_back({{"key", field.info.key},
                      {"label", field.info.label},
                      {"symbol", field.info.symbol},
                      {"unit", field.info.unit},
                      {"note", field.info.note},
                      {"scale", name_of(field.info.scale)},
                      {"shown", field.info.shown},
                      {"categories", field.info.categories},
                      {"colours", field.info.colours},
                      {"low", field.low},
                      {"step", field.step},
                      {"prediction", name_of(field.prediction)},
                      {"blob", blob_name(series.name, f + 1)}});
  }
  return {{"name", series.name},       {"tracks", series.tracks},           {"entries", series.entries},
          {"spacing", points.spacing}, {"blob", blob_name(series.name, 0)}, {"fields", fields}};
}

Json json_of(const Page& page) {
  Json json{{"format", format_version},
            {"title", page.title},
            {"summary", page.summary},
            {"status", page.status},
            {"reason", page.reason},
            {"version", page.version},
            {"reload", page.reload_seconds},
            {"size", page.size},
            {"facts", Json::array()},
            {"notes", page.notes},
            {"times", page.times},
            {"sets", Json::array()},
            {"outlines", page.outlines},
            {"walls", page.walls},
            {"monitors", Json::array()},
            {"levels", Json::array()},
            {"history", json_of(page.history)},
            {"figures", Json::array()},
            {"tables", Json::array()},
            {"inputs", page.inputs}};
  for (const PageFact& f : page.facts)
    json["facts"].push_back({{"label", f.label}, {"value", f.value}, {"unit", f.unit}, {"note", f.note}});
  for (const PagePoints& points : page.points) json["sets"].push_back(json_of(points));
  for (const PageMonitor& m : page.monitors) json["monitors"].push_back({{"name", m.name}, {"points", m.points}});
  for (const PageLevel& l : page.levels)
    json["levels"].push_back({{"name", l.name}, {"line", l.line}, {"head", l.head}});
  for (const PageFigure& f : page.figures) json["figures"].push_back({{"title", f.title}, {"source", f.source}});
  for (const PageTable& table : page.tables) json["tables"].push_back(json_of(table));
  return json;
}

/// JSON inside a script element: no "<" may stand in it, or a title could end the element.
std::string script_json(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

void append_blob(std::string& html, const std::string& id, const std::string& text) {
  html += fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>\n", id, text);
}

std::string head(std::string_view title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; font-src data:; img-src data: blob:; media-src blob:\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"polder\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n",
      escaped(title), viewer_style);
}

}  // namespace

std::string render_page(const Page& page) {
  std::string html = head(page.title);
  html += fmt::format(
      "<main id=\"polder\"><noscript><h1>{}</h1><p>{}</p><p>This report needs JavaScript to show the run. The numbers "
      "are in summary.json and history.csv beside it.</p></noscript></main>\n",
      escaped(page.title), escaped(page.summary));
  html += fmt::format("<script type=\"application/json\" id=\"polder-page\">{}</script>\n", script_json(json_of(page)));
  for (const PagePoints& points : page.points) {
    append_blob(html, blob_name(points.series.name, 0), points.series.track_text);
    for (std::size_t f = 0; f < points.series.fields.size(); ++f)
      append_blob(html, blob_name(points.series.name, f + 1), points.series.fields[f].text);
  }
  html += fmt::format("<script>{}</script>\n</body>\n</html>\n", viewer_script);
  return html;
}

std::string render_plain_page(std::string_view title, std::string_view body) {
  return head(title) +
         fmt::format(
             "<main id=\"polder\" class=\"plain-page\"><p class=\"brand\">Polder</p>\n{}</main>\n</body>\n</html>\n",
             body);
}

std::string svg_figure(const std::string& svg, std::string_view name) {
  return fmt::format("<figure class=\"drawing\" tabindex=\"0\" role=\"group\" aria-label=\"{}\">{}</figure>\n",
                     escaped(name), svg);
}

}  // namespace polder
