#pragma once
// Pieces of HTML. Text given to them is plain and is escaped here, except where a parameter is called `html`.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace polder::html {

std::string element(std::string_view tag, std::string_view html, std::string_view attributes = "");
std::string text_element(std::string_view tag, std::string_view text, std::string_view attributes = "");
std::string section(std::string_view id, std::string_view title, std::string_view html);

struct Table {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  ///< plain text
  std::vector<bool> numbers;                   ///< per column: set to the right
};
std::string table(const Table& table);

/// Any JSON for readers: objects as two columns, lists of numbers in one line, long ones folded.
std::string outline(const nlohmann::ordered_json& json);

/// A picture with its bytes inside the page.
std::string picture(std::string_view media_type, std::string_view bytes, std::string_view description);

}  // namespace polder::html
