#include "polder/stability/expected.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <stdexcept>

namespace polder::stability {

std::vector<ExpectedFactor> expected_factors(const std::filesystem::path& file) {
  std::vector<ExpectedFactor> factors;
  if (!std::filesystem::exists(file)) return factors;
  toml::table table;
  try {
    table = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(
        fmt::format("{}:{}: {}", file.string(), error.source().begin.line, error.description()));
  }
  const toml::array* entries = table["stability"].as_array();
  if (entries == nullptr) return factors;
  for (const toml::node& node : *entries) {
    const toml::table* entry = node.as_table();
    if (entry == nullptr) continue;
    ExpectedFactor factor;
    factor.method = (*entry)["method"].value_or(std::string());
    factor.reference = (*entry)["reference"].value_or(0.0);
    factor.tolerance = (*entry)["tolerance"].value_or(0.0);
    factor.source = (*entry)["source"].value_or(std::string());
    if (factor.method.empty() || factor.reference <= 0 || factor.tolerance <= 0)
      throw std::invalid_argument(fmt::format("{}:{}: a [[stability]] needs a method, a reference and a tolerance",
                                              file.string(), entry->source().begin.line));
    factors.push_back(factor);
  }
  return factors;
}

}  // namespace polder::stability
