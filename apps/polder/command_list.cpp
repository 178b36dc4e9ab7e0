// polder list: the shipped cases and what they are.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "polder/case/locate.hpp"
#include "polder/case/reader.hpp"

namespace polder::cli {
namespace {

int list(bool as_json) {
  const auto cases = shipped_cases();
  std::size_t width = 0;
  for (const ShippedCase& shipped : cases) width = std::max(width, shipped.name.size());
  auto json = nlohmann::ordered_json::array();
  for (const ShippedCase& shipped : cases) {
    const std::string title = read_case(shipped.file.string()).model.title;
    if (as_json)
      json.push_back({{"case", shipped.name}, {"title", title}, {"file", shipped.file.string()}});
    else
      std::cout << fmt::format("{:{}}  {}\n", shipped.name, width, title);
  }
  if (as_json) std::cout << json.dump(2) << '\n';
  return std::cout.flush() ? status_done : status_not_written;
}

}  // namespace

void add_list(CLI::App& polder, Action& action) {
  CLI::App* command =
      add_command(polder, "list", "List the cases that come with Polder", "polder list\npolder list --json");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print a JSON list instead of text");
  command->callback([&action, json] { action = [json] { return list(*json); }; });
}

}  // namespace polder::cli
