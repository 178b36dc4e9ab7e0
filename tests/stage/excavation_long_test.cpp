// Hydraulic heave at a sheet pile in level ground (cases/excavation-onset): it begins between Terzaghi's difference of
// head, 5.6 m, and that at which the exit gradient is critical, 6.3 m, each ± 8 %.
#include <gtest/gtest.h>

#include <cmath>

#include "polder/case/reader.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

TEST(ExcavationOnset, LiesBetweenTerzaghiAndTheExitGradient) {
  const ReadResult result = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/excavation-onset/case.toml");
  ASSERT_TRUE(result.ok()) << format(result.diagnostics);
  Simulation<PlaneStrain> run(result.model, 1);
  const auto uplift = [&] {  // mean of the prism of half the embedment's width beside the wall
    const auto& soil = run.state().soil;
    double sum = 0, mass = 0;
    for (std::size_t p = 0; p < soil.size(); ++p) {
      const double x = soil.reference[0][p], y = soil.reference[1][p];
      if (x < 12 || x > 13 || y < 8) continue;
      sum += soil.mass[p] * (soil.position[1][p] - y);
      mass += soil.mass[p];
    }
    return sum / mass;
  };
  // the level outside rises by 0.1 m/s from 15.5 m at 5 s, that inside stays at 11 m
  const auto uplift_at = [&](double head) {
    while (run.time() < 5 + (head - 4.5) / 0.1) run.advance();
    return uplift();
  };
  const double early = uplift_at(5.0), terzaghi = uplift_at(5.2), late = uplift_at(6.8), later = uplift_at(7.0);
  const double before = (terzaghi - early) / 0.2, after = (later - late) / 0.2;  // m of uplift per m of head
  EXPECT_LT(before, 0.003);
  EXPECT_GT(after, 0.03);
  // where the two straight branches meet
  const double onset = (late - after * 6.8 - terzaghi + before * 5.2) / (before - after);
  EXPECT_GT(onset, 5.6 * 0.92);
  EXPECT_LT(onset, 6.3 * 1.08);
  RecordProperty("onset_m", std::to_string(onset));
}

}  // namespace
}  // namespace polder
