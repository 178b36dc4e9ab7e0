#include "polder/report/encode.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

#include "polder/result/paint.hpp"

namespace polder {
namespace {

constexpr double most_steps = no_value - 1;

struct Spread {
  double low = 0, high = 0;  ///< all values
  double bulk = 0;           ///< range of the values without the outermost 0.5 % on either side
};

Spread spread_of(std::span<const float> values) {
  std::vector<float> finite;
  finite.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](float v) { return std::isfinite(v); });
  if (finite.empty()) return {};
  const auto at = [&](std::size_t k) {
    std::nth_element(finite.begin(), finite.begin() + static_cast<std::ptrdiff_t>(k), finite.end());
    return static_cast<double>(finite[k]);
  };
  const std::size_t last = finite.size() - 1, tail = finite.size() / 200;
  const auto [low, high] = std::minmax_element(finite.begin(), finite.end());
  Spread spread{*low, *high, 0};
  spread.bulk = at(last - tail) - at(tail);
  return spread;
}

std::vector<std::uint16_t> to_steps(std::span<const float> values, double low, double step) {
  std::vector<std::uint16_t> q(values.size());
  std::transform(values.begin(), values.end(), q.begin(), [&](float v) {
    if (!std::isfinite(v)) return no_value;
    return static_cast<std::uint16_t>(std::clamp(std::round((v - low) / step), 0.0, most_steps));
  });
  return q;
}

/// Calls visit(place, prediction) in storage order; visit returns the true value, which later predictions use.
template <class Visit>
void walk(const TrackedOrder& order, Prediction kind, Visit visit) {
  const std::size_t tracks = order.tracks.size();
  std::vector<std::uint16_t> last(tracks), before_last(tracks);
  for (std::size_t frame = 0; frame + 1 < order.frame_start.size(); ++frame) {
    std::uint16_t left = 0, left_change = 0;
    for (std::size_t place = order.frame_start[frame]; place < order.frame_start[frame + 1]; ++place) {
      const std::uint32_t t = order.track[place];
      const auto age = frame - order.tracks[t].first;
      std::uint16_t guess = left;
      if (age > 0) guess = last[t];
      if (age > 0 && kind == Prediction::neighbour) guess = static_cast<std::uint16_t>(guess + left_change);
      if (age > 1 && kind == Prediction::linear) guess = static_cast<std::uint16_t>(2 * last[t] - before_last[t]);
      const std::uint16_t value = visit(place, guess);
      left_change = age > 0 ? static_cast<std::uint16_t>(value - last[t]) : std::uint16_t{0};
      left = value;
      before_last[t] = last[t];
      last[t] = value;
    }
  }
}

std::uint16_t zigzag(std::uint16_t difference) {
  const auto d = static_cast<std::int16_t>(difference);
  return static_cast<std::uint16_t>((d << 1) ^ (d >> 15));
}

std::uint16_t unzigzag(std::uint16_t z) { return static_cast<std::uint16_t>((z >> 1) ^ -(z & 1)); }

void append_little_endian(std::vector<std::uint8_t>& out, std::uint64_t value, int bytes) {
  for (int b = 0; b < bytes; ++b) out.push_back(static_cast<std::uint8_t>(value >> (8 * b)));
}

std::vector<std::uint8_t> track_bytes(const std::vector<Track>& tracks) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(tracks.size() * 12);
  for (const Track& t : tracks) append_little_endian(bytes, t.id, 8);
  for (const Track& t : tracks) append_little_endian(bytes, t.first, 2);
  for (const Track& t : tracks) append_little_endian(bytes, t.last, 2);
  return bytes;
}

std::string text_of(const std::vector<std::uint8_t>& bytes) {
  return base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

constexpr int quick = 1;

/// The prediction whose bytes pack best, judged by a quick pass.
Prediction best_prediction(const Quantised& quantised, const TrackedOrder& order) {
  Prediction best = Prediction::time;
  std::size_t smallest = std::numeric_limits<std::size_t>::max();
  for (const Prediction kind : {Prediction::time, Prediction::neighbour, Prediction::linear}) {
    const std::size_t size = deflate(predict(quantised.q, order, kind), quick).size();
    if (size >= smallest) continue;
    smallest = size;
    best = kind;
  }
  return best;
}

EncodedField encode_field(const PlayerField& info, const Quantised& quantised, const TrackedOrder& order) {
  const Prediction prediction = best_prediction(quantised, order);
  return {info, quantised.low, quantised.step, prediction, text_of(deflate(predict(quantised.q, order, prediction)))};
}

}  // namespace

Quantised quantise(std::span<const float> values, double levels) {
  const Spread spread = spread_of(values);
  Quantised result;
  result.low = spread.low;
  result.step = std::max((spread.high - spread.low) / most_steps, spread.bulk / levels);
  if (!(result.step > 0)) result.step = 1;
  result.q = to_steps(values, result.low, result.step);
  return result;
}

std::string_view name_of(Prediction prediction) {
  switch (prediction) {
    case Prediction::time:
      return "time";
    case Prediction::neighbour:
      return "neighbour";
    case Prediction::linear:
      return "linear";
  }
  throw std::invalid_argument("unknown prediction");
}

std::vector<std::uint8_t> predict(std::span<const std::uint16_t> q, const TrackedOrder& order, Prediction prediction) {
  std::vector<std::uint8_t> bytes(2 * q.size());
  walk(order, prediction, [&](std::size_t place, std::uint16_t guess) {
    const std::uint16_t z = zigzag(static_cast<std::uint16_t>(q[place] - guess));
    bytes[place] = static_cast<std::uint8_t>(z >> 8);
    bytes[q.size() + place] = static_cast<std::uint8_t>(z & 255);
    return q[place];
  });
  return bytes;
}

std::vector<std::uint16_t> unpredict(std::span<const std::uint8_t> bytes, const TrackedOrder& order,
                                     Prediction prediction) {
  std::vector<std::uint16_t> q(bytes.size() / 2);
  walk(order, prediction, [&](std::size_t place, std::uint16_t guess) {
    const auto z = static_cast<std::uint16_t>(bytes[place] << 8 | bytes[q.size() + place]);
    return q[place] = static_cast<std::uint16_t>(guess + unzigzag(z));
  });
  return q;
}

std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::vector<std::uint8_t> packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return packed;
}

EncodedSeries encode(const PointSeries& series, const Precision& precision) {
  if (series.frames() > 65535)
    throw std::invalid_argument(fmt::format("{} frames are more than a page can hold (65535)", series.frames()));
  const TrackedOrder order = order_by_track(series);
  EncodedSeries encoded;
  encoded.name = series.name;
  encoded.tracks = order.tracks.size();
  encoded.entries = series.entries();
  encoded.track_text = text_of(deflate(track_bytes(order.tracks)));

  std::array<Spread, 2> extent;
  for (std::size_t axis = 0; axis < 2; ++axis) extent[axis] = spread_of(series.fields.at(axis).values);
  const double longest = std::max(extent[0].high - extent[0].low, extent[1].high - extent[1].low);
  const double coordinate_step = longest > 0 ? longest / precision.coordinate_levels : 1;

  std::vector<float> sorted(series.entries());
  for (std::size_t f = 0; f < series.fields.size(); ++f) {
    const SeriesField& field = series.fields[f];
    for (std::size_t place = 0; place < sorted.size(); ++place) sorted[place] = field.values[order.entry[place]];
    Quantised quantised;
    if (f < 2)
      quantised = {extent[f].low, coordinate_step, to_steps(sorted, extent[f].low, coordinate_step)};
    else if (field.info.scale == FieldScale::category)
      quantised = {0, 1, to_steps(sorted, 0, 1)};
    else
      quantised = quantise(sorted, field.info.shown ? precision.field_levels : precision.velocity_levels);
    encoded.fields.push_back(encode_field(field.info, quantised, order));
  }
  return encoded;
}

}  // namespace polder
