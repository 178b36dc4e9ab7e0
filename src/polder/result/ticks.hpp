#pragma once
// Round numbers for axes and colour bars, and how to write them.
#include <string>
#include <string_view>
#include <vector>

namespace polder {

struct Range {
  double low = 0, high = 1;
};

struct Ticks {
  std::vector<double> at;
  std::vector<std::string> labels;
  double step = 1;
};

/// Multiples of 1, 2 or 5 times a power of ten inside the range, about `count` of them, labelled with no more decimals
/// than the step needs, with a true minus sign.
Ticks nice_ticks(Range range, int count);

/// The smallest range with round ends (multiples of the step of `nice_ticks`) that holds the given one. A range without
/// extent is widened.
Range nice_range(Range range, int count);

/// Smallest and largest finite value; {0, 1} where there is none.
Range range_of(const std::vector<double>& values);

/// A unit fit for numbers of a size: divide by `factor` and write `name`.
struct DisplayUnit {
  double factor = 1;
  std::string name;
};

/// kPa or MPa for Pa, mm for m, mm/s for m/s, minutes, hours or days for s where the largest magnitude asks for it.
DisplayUnit display_unit(std::string_view unit, double largest);

/// "t = 4.00 s", "3.2 min", "5.4 h", "12 d": three significant digits in the unit that suits.
std::string time_text(double seconds);

/// A number for readers: three significant digits, true minus sign, powers of ten written out as ×10ⁿ.
std::string number_text(double value);

}  // namespace polder
