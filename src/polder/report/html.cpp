#include "polder/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "polder/result/paint.hpp"

namespace polder::html {
namespace {

using Json = nlohmann::ordered_json;

bool is_plain(const Json& json) { return !json.is_structured(); }

bool is_plain_list(const Json& json) {
  return json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& item) { return is_plain(item); });
}

std::string plain_text(const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  if (json.is_null()) return "–";
  return json.dump();
}

std::string list_text(const Json& list) {
  std::string text;
  for (const Json& item : list)
    text += (text.empty() ? "" : ", ") + (is_plain(item) ? plain_text(item) : "(" + list_text(item) + ")");
  return text;
}

std::string folded(const std::string& summary, const std::string& html) {
  return element("details", text_element("summary", summary) + html);
}

std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

}  // namespace

std::string element(std::string_view tag, std::string_view html, std::string_view attributes) {
  return fmt::format("<{}{}{}>{}</{}>\n", tag, attributes.empty() ? "" : " ", attributes, html, tag);
}

std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes) {
  return element(tag, escaped(text), attributes);
}

std::string section(std::string_view id, std::string_view title, std::string_view html) {
  return element("section", text_element("h2", title) + std::string(html), fmt::format("id=\"{}\"", id));
}

std::string table(const Table& table) {
  const auto cell = [&](const char* tag, const std::string& text, std::size_t column) {
    return text_element(tag, text, column < table.numbers.size() && table.numbers[column] ? "class=\"number\"" : "");
  };
  std::string head, body;
  for (std::size_t c = 0; c < table.headings.size(); ++c) head += cell("th", table.headings[c], c);
  for (const std::vector<std::string>& row : table.rows) {
    std::string cells;
    for (std::size_t c = 0; c < row.size(); ++c) cells += cell("td", row[c], c);
    body += element("tr", cells);
  }
  return element("div", element("table", element("thead", element("tr", head)) + element("tbody", body)),
                 "class=\"scroll\"");
}

std::string outline(const Json& json) {
  if (json.is_object()) {
    std::string rows;
    for (const auto& [key, value] : json.items())
      rows += element("tr", text_element("th", words(key)) + element("td", outline(value)));
    return rows.empty() ? "–" : element("table", rows, "class=\"outline\"");
  }
  if (is_plain(json)) return escaped(plain_text(json));
  const bool lines = std::all_of(json.begin(), json.end(), [](const Json& item) { return is_plain_list(item); });
  if (is_plain_list(json) || lines) {
    const std::string text = escaped(list_text(json));
    return text.size() < 160 ? (text.empty() ? "–" : text) : folded(fmt::format("{} values", json.size()), text);
  }
  std::string items;
  for (const Json& item : json) {
    const bool named = item.is_object() && item.contains("name") && item["name"].is_string();
    items += named ? folded(item["name"].get<std::string>(), outline(item)) : outline(item);
  }
  return items;
}

std::string picture(std::string_view media_type, std::string_view bytes, std::string_view description) {
  return fmt::format("<img alt=\"{}\" src=\"data:{};base64,{}\">", escaped(description), media_type, base64(bytes));
}

}  // namespace polder::html
