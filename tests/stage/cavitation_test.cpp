// A column of water that is thrown away from the closed end of a pipe (water hammer with separation of the column): the
// void at that end holds the cavitation pressure p_c, which slows it down by |p_c|/(ρL), stops it after ρ v L/|p_c| and
// brings it back with the speed it left with.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

constexpr double length = 10, speed = 1, density = 1000;  // SI

struct Column {
  double displacement, velocity, pressure;  // means, m, m/s; and the least, Pa
};

class Pipe {
 public:
  Pipe(double limit, int threads)
      : run_(read_text(fmt::format(R"(
[model]
size = ["12 m", "0.0625 m"]
cell = "0.0625 m"
gravity = "0 m/s2"
[water]
cavitation_pressure = "{} Pa"
[[free_water]]
box = [["0 m", "0 m"], ["{} m", "0.0625 m"]]
[[stage]]
name = "hammer"
duration = "0.4 s"
[numerics]
max_step = "1 ms"
)",
                                   limit, length)),
             threads) {
    auto& water = run_.state().water;
    std::fill(water.velocity[0].begin(), water.velocity[0].end(), speed);
    run_.begin_anew();
    start_ = mean(water.position[0]);
  }

  Column at(double time) {
    double lowest = 0;
    while (run_.time() < time && !run_.finished()) {
      run_.advance();
      const auto& p = run_.state().grid.pressure;
      lowest = std::min(lowest, *std::min_element(p.begin(), p.end()));
    }
    const auto& water = run_.state().water;
    return {mean(water.position[0]) - start_, mean(water.velocity[0]), lowest};
  }

 private:
  double mean(const Array& of) const {
    const Array& volume = run_.state().water.volume;
    return std::inner_product(of.begin(), of.end(), volume.begin(), 0.0) /
           std::accumulate(volume.begin(), volume.end(), 0.0);
  }

  Simulation<PlaneStrain> run_;
  double start_ = 0;
};

TEST(Cavitation, OpensAVoidThatClosesAgain) {
  constexpr double limit = -98e3;
  const double stops = density * speed * length / -limit, farthest = 0.5 * speed * stops;  // 0.102 s, 51 mm
  for (const int threads : {1, 2}) {
    Pipe pipe(limit, threads);
    const Column turned = pipe.at(stops);
    EXPECT_NEAR(turned.displacement, farthest, 0.05 * farthest);
    EXPECT_NEAR(turned.velocity, 0, 0.05 * speed);
    EXPECT_GE(turned.pressure, 1.001 * limit);
    const Column back = pipe.at(1.7 * stops);
    EXPECT_NEAR(back.velocity, -0.7 * speed, 0.05 * speed);
    const Column closed = pipe.at(3 * stops);
    EXPECT_NEAR(closed.displacement, 0, 0.3 * farthest) << "a void of a twentieth of a cell counts as none";
    EXPECT_NEAR(closed.velocity, 0, 0.05 * speed);
    EXPECT_GE(closed.pressure, 1.001 * limit);
  }
}

TEST(Cavitation, IsNoneWithoutALimit) {
  const Column held = Pipe(-1e12, 1).at(0.1);
  EXPECT_NEAR(held.displacement, 0, 1e-3);
  EXPECT_LT(held.pressure, -1e6);
}

}  // namespace
}  // namespace polder
