#include "polder/report/encode.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace polder {
namespace {

constexpr unsigned seed = 20240611;

/// Points that appear, vanish and (one in ten) come back, in shuffled order within each frame.
PointSeries random_series(std::mt19937& random, std::size_t frames, std::uint64_t ids) {
  PointSeries series;
  series.name = "water";
  series.fields = {{{"x", "x", "x", "m"}, {}}, {{"y", "y", "y", "m"}, {}}, {{"pressure", "Pressure", "p", "Pa"}, {}}};
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::pair<std::size_t, std::size_t>> stay(ids);
  for (auto& s : stay) {
    s.first = static_cast<std::size_t>(unit(random) * static_cast<double>(frames));
    s.second = s.first + static_cast<std::size_t>(unit(random) * static_cast<double>(frames));
  }
  for (std::size_t frame = 0; frame < frames; ++frame) {
    std::vector<std::uint64_t> present;
    for (std::uint64_t id = 0; id < ids; ++id) {
      const bool blinks = id % 10 == 3 && frame % 4 == 2;
      if (stay[id].first <= frame && frame <= stay[id].second && !blinks) present.push_back(id << 33 | 7);
    }
    std::shuffle(present.begin(), present.end(), random);
    for (const std::uint64_t id : present) {
      series.id.push_back(id);
      const double t = static_cast<double>(frame), k = static_cast<double>(id >> 33);
      series.fields[0].values.push_back(static_cast<float>(0.1 * k + 0.01 * t));
      series.fields[1].values.push_back(static_cast<float>(std::sin(0.1 * k + 0.3 * t)));
      series.fields[2].values.push_back(static_cast<float>(9810 * unit(random)));
    }
    series.frame_start.push_back(series.id.size());
  }
  return series;
}

TEST(Tracks, FollowEveryPointFromFirstToLastSight) {
  std::mt19937 random(seed);
  const PointSeries series = random_series(random, 30, 200);
  const TrackedOrder order = order_by_track(series);
  ASSERT_EQ(order.track.size(), series.entries());
  std::size_t sightings = 0;
  for (const Track& t : order.tracks) sightings += t.last - t.first + 1;
  EXPECT_EQ(sightings, series.entries());
  for (std::size_t frame = 0; frame < series.frames(); ++frame)
    for (std::size_t place = order.frame_start[frame]; place < order.frame_start[frame + 1]; ++place) {
      const Track& t = order.tracks[order.track[place]];
      EXPECT_EQ(t.id, series.id[order.entry[place]]);
      EXPECT_LE(t.first, frame);
      EXPECT_GE(t.last, frame);
      if (place > order.frame_start[frame]) {
        EXPECT_LT(order.track[place - 1], order.track[place]);
      }
    }
}

TEST(Tracks, RefuseAnIdThatOccursTwiceInOneFrame) {
  PointSeries series;
  series.id = {4, 4};
  series.frame_start = {0, 2};
  EXPECT_THROW(order_by_track(series), std::invalid_argument);
}

TEST(Quantise, IsWrongByAtMostHalfAStep) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(3e4f, 2e3f);
  std::vector<float> values(5000);
  for (float& v : values) v = normal(random);
  values[17] = 9e5f;  // an outlier must not be cut off
  values[18] = std::numeric_limits<float>::quiet_NaN();
  const Quantised quantised = quantise(values, 4000);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 18) continue;
    const double back = quantised.low + quantised.step * quantised.q[i];
    EXPECT_NEAR(back, values[i], 0.5 * quantised.step + 0.01) << i;
  }
  EXPECT_EQ(quantised.q[18], no_value);
  EXPECT_LT(quantised.step, 20.0) << "one outlier coarsened the rest";
}

TEST(Quantise, TakesConstantsAndNothing) {
  const std::vector<float> same(10, 5.0f);
  EXPECT_EQ(quantise(same, 4000).q, std::vector<std::uint16_t>(10, 0));
  EXPECT_EQ(quantise(same, 4000).low, 5.0);
  EXPECT_TRUE(quantise({}, 4000).q.empty());
}

TEST(Predict, IsUndoneForEveryPredictionAndAnyNumbers) {
  std::mt19937 random(seed);
  for (int round = 0; round < 20; ++round) {
    const PointSeries series = random_series(random, 12, 60);
    const TrackedOrder order = order_by_track(series);
    std::vector<std::uint16_t> q(series.entries());
    for (auto& v : q) v = static_cast<std::uint16_t>(random());
    for (const Prediction kind : {Prediction::time, Prediction::neighbour, Prediction::linear})
      EXPECT_EQ(unpredict(predict(q, order, kind), order, kind), q) << "seed " << seed << ", " << name_of(kind);
  }
}

TEST(Deflate, IsAZlibStream) {
  std::vector<std::uint8_t> bytes(10000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i % 7 * i % 5);
  const std::vector<std::uint8_t> packed = deflate(bytes);
  EXPECT_LT(packed.size(), bytes.size() / 10);
  std::vector<std::uint8_t> back(bytes.size());
  uLongf size = back.size();
  ASSERT_EQ(uncompress(back.data(), &size, packed.data(), packed.size()), Z_OK);
  EXPECT_EQ(size, bytes.size());
  EXPECT_EQ(back, bytes);
}

TEST(Encode, KeepsCoordinatesToAFractionOfTheSection) {
  std::mt19937 random(seed);
  const PointSeries series = random_series(random, 20, 100);
  const EncodedSeries encoded = encode(series);
  ASSERT_EQ(encoded.fields.size(), 3u);
  EXPECT_EQ(encoded.fields[0].step, encoded.fields[1].step);
  EXPECT_LT(encoded.fields[0].step, 10.0 / 15000);
  EXPECT_EQ(encoded.entries, series.entries());
}

TEST(Encode, PacksMotionThatIsSmoothIntoLessThanAByteAPoint) {
  PointSeries series;
  series.name = "soil";
  series.fields = {{{"x", "x", "x", "m"}, {}}, {{"y", "y", "y", "m"}, {}}};
  for (std::size_t frame = 0; frame < 50; ++frame) {
    for (std::uint64_t id = 0; id < 2000; ++id) {
      const double x = 0.05 * static_cast<double>(id % 80), y = 0.05 * static_cast<double>(id / 80);
      series.id.push_back(id);
      series.fields[0].values.push_back(static_cast<float>(x + 0.004 * y * static_cast<double>(frame)));
      series.fields[1].values.push_back(static_cast<float>(y));
    }
    series.frame_start.push_back(series.id.size());
  }
  const EncodedSeries encoded = encode(series);
  EXPECT_LT(encoded.fields[0].text.size(), series.entries());
}

}  // namespace
}  // namespace polder
