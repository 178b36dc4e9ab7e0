// Gates: walls that hold until their time or their stage, and are gone from then on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_text.hpp"
#include "polder/stage/checkpoint.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// Water of 0.4 m × 0.3 m behind `gate`, in a dry channel; two stages of 0.25 s.
std::string channel(const std::string& gate) {
  return R"(
[model]
size = ["1.2 m", "0.5 m"]
cell = "0.025 m"
[[free_water]]
box = [["0 m", "0 m"], ["0.4 m", "0.3 m"]]
[[stage]]
name = "hold"
duration = "0.25 s"
[[stage]]
name = "flow"
duration = "0.25 s"
)" + gate;
}

/// m, the foremost point of water.
double front(const Simulation<PlaneStrain>& run) {
  const auto& x = run.state().water.position[0];
  return *std::max_element(x.begin(), x.end());
}

struct Opening {
  double opened = -1;     // s, end of the step before the first in which the gate is gone
  double held_front = 0;  // m, while it stood
  double front = 0;       // m, at the end
};

Opening open_gate(const std::string& gate, double opens) {
  Simulation<PlaneStrain> run(read_text(channel(gate)), 1);
  Opening result;
  while (!run.finished()) {
    const bool stands = run.time() < opens - 1e-9;
    const double before = run.time();
    run.advance();
    if (stands)
      result.held_front = front(run);
    else if (result.opened < 0)
      result.opened = before;
  }
  result.front = front(run);
  return result;
}

TEST(Gate, HoldsWaterUntilItsTimeAndIsGoneThen) {
  const Opening thin =
      open_gate("[[wall]]\nline = [[\"0.4 m\", \"0 m\"], [\"0.4 m\", \"0.5 m\"]]\nuntil = \"0.2 s\"\n", 0.2);
  EXPECT_EQ(thin.opened, 0.2);  // a step ends there
  EXPECT_LT(thin.held_front, 0.4);
  // as far as without a gate in the time that is left
  Simulation<PlaneStrain> free(read_text(channel("")), 1);
  while (free.time() < 0.3 - 1e-9) free.advance();
  EXPECT_GT(thin.front, 0.8);
  EXPECT_NEAR(thin.front, front(free), 0.05);
}

TEST(Gate, HoldsWaterUntilItsStageAndIsGoneThen) {
  const Opening thin =
      open_gate("[[wall]]\nline = [[\"0.4 m\", \"0 m\"], [\"0.4 m\", \"0.5 m\"]]\nuntil_stage = \"flow\"\n", 0.25);
  EXPECT_NEAR(thin.opened, 0.25, 1e-12);
  EXPECT_LT(thin.held_front, 0.4);
  EXPECT_GT(thin.front, 0.7);
}

TEST(Gate, OfABodyVanishesToo) {
  const Opening body =
      open_gate("[[wall]]\nbox = [[\"0.4 m\", \"0 m\"], [\"0.46 m\", \"0.5 m\"]]\nuntil_stage = \"flow\"\n", 0.25);
  EXPECT_NEAR(body.opened, 0.25, 1e-12);
  EXPECT_LT(body.held_front, 0.401);
  EXPECT_GT(body.front, 0.7);
}

TEST(Gate, HoldsDrySandInPlace) {
  const Model model = read_text(R"(
[model]
size = ["1 m", "0.4 m"]
cell = "0.05 m"
[[material]]
name = "sand"
law = "mohr-coulomb"
young_modulus = "1 MPa"
poisson_ratio = 0.3
friction_angle = "30 deg"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-3 m/s"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["0.4 m", "0.3 m"]]
[[wall]]
line = [["0.4 m", "0 m"], ["0.4 m", "0.4 m"]]
until = "0.3 s"
[[boundary]]
side = "base"
soil = "rough"
[[stage]]
name = "hold and fall"
duration = "0.8 s"
)");
  Simulation<PlaneStrain> run(model, 1);
  const auto& soil = run.state().soil;
  const auto farthest = [&] {
    double most = 0;
    for (std::size_t p = 0; p < soil.size(); ++p)
      most = std::max(most, std::abs(soil.position[0][p] - soil.reference[0][p]));
    return most;
  };
  while (run.time() < 0.3 - 1e-9) run.advance();
  EXPECT_LT(farthest(), 1e-4);
  for (const double x : soil.position[0]) ASSERT_LT(x, 0.4);
  while (!run.finished()) run.advance();
  EXPECT_GT(farthest(), 0.05);
  EXPECT_GT(*std::max_element(soil.position[0].begin(), soil.position[0].end()), 0.5);
}

TEST(Gate, IsAsItWasAfterResuming) {
  const Model model =
      read_text(channel("[[wall]]\nline = [[\"0.4 m\", \"0 m\"], [\"0.4 m\", \"0.5 m\"]]\nuntil = \"0.2 s\"\n"));
  for (const double at : {0.1, 0.2, 0.3}) {
    Simulation<PlaneStrain> through(model, 1), resumed(model, 1);
    while (through.time() < at - 1e-9) through.advance();
    restore_checkpoint(checkpoint_bytes(through, {}, "gate"), resumed, "gate");
    for (int step = 0; step < 20; ++step) {
      through.advance();
      resumed.advance();
    }
    for (int a = 0; a < 2; ++a)
      EXPECT_EQ(through.state().water.position[a], resumed.state().water.position[a]) << "resumed at " << at;
  }
}

}  // namespace
}  // namespace polder
