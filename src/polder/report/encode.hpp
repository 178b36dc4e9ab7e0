#pragma once
// Point series as compressed text inside a page. `docs/report-format.md` describes the same for readers of pages.
//
// A field is quantised to whole steps above its lowest value over the run, at most 65 534 of them, so that a value is
// wrong by at most half a step; 65 535 says "no value". The step is the larger of full range / 65 534 and
// (range without the outermost 0.5 % on either side) / `levels`, so one outlier does not coarsen the rest.
// The numbers are then predicted and the differences (modulo 65 536, zigzag: 0 −1 1 −2 2 → 0 1 2 3 4) stored as all
// high bytes followed by all low bytes, deflated in zlib's format, in base64. Predictions of value q of a track at t:
//   time      q(t−1); where the track is new, the value of the track before it in this frame (0 for the first)
//   neighbour q(t−1) + [q'(t) − q'(t−1)] with q' the track before it in this frame where both have a past
//   linear    2 q(t−1) − q(t−2) where there are two
// The one that packs best is kept.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polder/report/series.hpp"
#include "polder/report/tracks.hpp"

namespace polder {

inline constexpr std::uint16_t no_value = 65535;

struct Quantised {
  double low = 0;   ///< value of step 0
  double step = 1;  ///< value of one step
  std::vector<std::uint16_t> q;
};

/// `values` in the order wanted; `levels` as above. Values that are not finite become `no_value`.
Quantised quantise(std::span<const float> values, double levels);

enum class Prediction { time, neighbour, linear };
std::string_view name_of(Prediction prediction);

/// Differences to the prediction, zigzag, high bytes then low bytes. `q` in the order of `order`.
std::vector<std::uint8_t> predict(std::span<const std::uint16_t> q, const TrackedOrder& order, Prediction prediction);
/// The inverse of `predict`.
std::vector<std::uint16_t> unpredict(std::span<const std::uint8_t> bytes, const TrackedOrder& order,
                                     Prediction prediction);

/// zlib stream (RFC 1950); `level` 1 is quick, 12 small.
std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes, int level = 7);

struct EncodedField {
  PlayerField info;
  double low = 0, step = 1;
  Prediction prediction = Prediction::time;
  std::string text;  ///< base64
};

struct EncodedSeries {
  std::string name;
  std::size_t tracks = 0, entries = 0;
  /// base64 of the deflated tracks: all ids (64 bit, little endian), all first frames, all last frames (16 bit).
  std::string track_text;
  std::vector<EncodedField> fields;
};

struct Precision {
  double coordinate_levels = 16000;  ///< steps over the model's extent: 0.3 mm in 5 m
  double field_levels = 2000;        ///< steps over a field's range: 0.05 %
  double velocity_levels = 1000;     ///< of fields that are not coloured by themselves
};

/// Coordinates x and y share one step. At most 65 535 frames.
EncodedSeries encode(const PointSeries& series, const Precision& precision = {});

}  // namespace polder
