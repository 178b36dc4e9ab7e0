#include "polder/verify/expected.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <stdexcept>

namespace polder::verify {

std::vector<Expected> expected_tolerances(const std::filesystem::path& file) {
  toml::table table;
  try {
    table = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
  std::vector<Expected> list;
  if (const toml::array* entries = table["verify"].as_array())
    for (const toml::node& node : *entries) {
      const toml::table* entry = node.as_table();
      Expected expected;
      if (entry) {
        expected.quantity = (*entry)["quantity"].value_or(std::string());
        expected.tolerance = (*entry)["tolerance"].value_or(0.0);
        expected.source = (*entry)["source"].value_or(std::string());
      }
      if (expected.quantity.empty() || expected.tolerance <= 0 || expected.source.empty())
        throw std::runtime_error(fmt::format("{}:{}: a [[verify]] needs a quantity, a tolerance and a source",
                                             file.string(), node.source().begin.line));
      list.push_back(expected);
    }
  return list;
}

}  // namespace polder::verify
