#pragma once
// The report as one HTML file: words and tables as JSON, points as compressed blobs, and the viewer that shows them.
// Nothing is fetched: the page's own content policy forbids it.
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "polder/report/encode.hpp"
#include "polder/result/frame.hpp"
#include "polder/result/history.hpp"

namespace polder {

struct PageCell {
  enum class State { none, pass, fail };
  std::string text;
  State state = State::none;
  std::string title{};  ///< explanation shown as a tooltip
};

struct PageTable {
  std::string id;  ///< anchor
  std::string title;
  std::string note;
  std::vector<std::string> columns;
  std::vector<bool> numeric;  ///< per column: right-aligned
  std::vector<std::vector<PageCell>> rows;
};

/// A figure at the head of the report.
struct PageFact {
  std::string label, value, unit, note;
};

struct PageMonitor {
  std::string name;
  Line2 points;  ///< m, in the section
};

/// Still water over the part of the ground that lies on a line.
struct PageLevel {
  std::string name;
  Line2 line;  ///< m, in the section
  Line2 head;  ///< (s, m)
};

/// A picture with its bytes inside the page.
struct PageFigure {
  std::string title;
  std::string source;  ///< a data: address
};

/// Points of one phase, ready to be written.
struct PagePoints {
  EncodedSeries series;
  double spacing = 0;  ///< m, side of the square that a shown point stands for
};

struct Page {
  std::string title;
  std::string summary;              ///< one or two sentences below the title
  std::string status = "finished";  ///< running, finished, failed, interrupted
  std::string reason;
  std::string version;
  double reload_seconds = 0;  ///< of a page whose run goes on; 0: never
  Point2 size{1, 1};          ///< m, the section shown
  std::vector<PageFact> facts;
  std::vector<std::string> notes;  ///< what the reader must know: thinning, the section of a 3D run
  std::vector<double> times;       ///< s, of the frames
  std::vector<PagePoints> points;
  std::vector<Line2> outlines, walls;
  std::vector<PageMonitor> monitors;
  std::vector<PageLevel> levels;
  History history;
  std::vector<PageFigure> figures;
  std::vector<PageTable> tables;
  nlohmann::ordered_json inputs;  ///< the case with every default filled in
};

std::string render_page(const Page& page);

/// The same head, style and foot around other content, for pages without a player (studies, verification).
/// `body` is HTML; `title` is text.
std::string render_plain_page(std::string_view title, std::string_view body);

/// A drawing in the text of such a page; on a narrow screen it scrolls. `name` says what it shows.
std::string svg_figure(const std::string& svg, std::string_view name);

}  // namespace polder
