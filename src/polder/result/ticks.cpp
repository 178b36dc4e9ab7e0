#include "polder/result/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace polder {
namespace {

double nice_step(double extent, int count) {
  const double rough = extent / std::max(count, 1);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

Range widened(Range range) {
  if (range.high > range.low) return range;
  const double margin = range.low == 0 ? 1 : 0.1 * std::abs(range.low);
  return {range.low - margin, range.high + margin};
}

std::string with_minus(std::string text) { return !text.empty() && text[0] == '-' ? "−" + text.substr(1) : text; }

std::string superscript(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

std::string tick_text(double value, double step, double largest) {
  if (value == 0) return "0";
  if (largest >= 1e5 || largest < 1e-3) return number_text(value);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return with_minus(fmt::format("{:.{}f}", value, decimals));
}

}  // namespace

Ticks nice_ticks(Range range, int count) {
  range = widened(range);
  Ticks ticks;
  ticks.step = nice_step(range.high - range.low, count);
  // A thousandth of a step of slack keeps the ends of a round range, which rounding may have pushed outside.
  const double first = std::ceil(range.low / ticks.step - 1e-3), last = std::floor(range.high / ticks.step + 1e-3);
  const double largest = std::max(std::abs(first), std::abs(last)) * ticks.step;
  const auto steps = static_cast<int>(last - first);
  for (int i = 0; i <= steps; ++i) {
    const double k = first + i;
    ticks.at.push_back(k * ticks.step);
    ticks.labels.push_back(tick_text(k * ticks.step, ticks.step, largest));
  }
  return ticks;
}

Range nice_range(Range range, int count) {
  range = widened(range);
  const double step = nice_step(range.high - range.low, count);
  return {std::floor(range.low / step + 1e-9) * step, std::ceil(range.high / step - 1e-9) * step};
}

Range range_of(const std::vector<double>& values) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range.low <= range.high ? range : Range{0, 1};
}

DisplayUnit display_unit(std::string_view unit, double largest) {
  if (unit == "Pa" && largest >= 2e6) return {1e6, "MPa"};
  if (unit == "Pa" && largest >= 500) return {1e3, "kPa"};
  if ((unit == "m" || unit == "m/s") && largest > 0 && largest < 0.02) return {1e-3, "m" + std::string(unit)};
  if (unit == "s" && largest >= 2 * 86400) return {86400, "d"};
  if (unit == "s" && largest >= 7200) return {3600, "h"};
  if (unit == "s" && largest >= 600) return {60, "min"};
  return {1, std::string(unit)};
}

std::string number_text(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  if (exponent >= -3 && exponent < 5) {
    std::string text = fmt::format("{:.{}f}", value, std::max(0, 2 - exponent));
    if (text.find('.') != std::string::npos) {
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
    }
    return with_minus(text);
  }
  std::string mantissa = fmt::format("{:.3g}", value / std::pow(10, exponent));
  return (mantissa == "1" ? "" : mantissa == "-1" ? "−" : with_minus(mantissa) + "·") + "10" + superscript(exponent);
}

std::string time_text(double seconds) {
  const double size = std::abs(seconds);
  if (size < 120) return fmt::format("{:.{}f} s", seconds, size < 10 ? 2 : 1);
  if (size < 7200) return fmt::format("{:.1f} min", seconds / 60);
  if (size < 2 * 86400) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.1f} d", seconds / 86400);
}

}  // namespace polder
