#pragma once
// Results of validations: kept as JSON, shown as docs/validation.md and as an HTML page.
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "polder/verify/validation.hpp"

namespace polder::validate {

nlohmann::ordered_json json_of(const Result& result);
/// The inverse; without the figure.
Result result_of(const nlohmann::ordered_json& json);

/// docs/validation.md: every row and cost, and the case that answers each figure of the studies. A validation without a
/// result is said to be not computed.
std::string validation_page(const std::map<std::string, Result>& results);

/// One self-contained HTML page with the figures.
std::string validation_report(const std::map<std::string, Result>& results);

/// A value with its unit, three significant digits.
std::string value_text(const std::optional<double>& value, const std::string& unit);
/// "within", "OUTSIDE", "shown", …
std::string verdict_text(const Row& row);

}  // namespace polder::validate
