// What seeps out of a failing dike runs on as a film between grains: no water is ever faster than if it had fallen from
// the reservoir's level.
#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

TEST(FilmOfSeepage, IsNoFasterThanItsHeadAllows) {
  Simulation<PlaneStrain> run(read_text(R"(
[model]
title = "Seepage failure of a small dike"
size  = ["1.6 m", "0.3 m"]
cell  = "0.0125 m"
[[material]]
name = "sand"
law  = "mohr-coulomb"
grain_density   = "2700 kg/m3"
porosity        = 0.4
max_porosity    = 0.5
grain_diameter  = "2 mm"
young_modulus   = "1000 kPa"
poisson_ratio   = 0.15
friction_angle  = "35 deg"
[[soil]]
material = "sand"
polygon = [["0.5 m", "0 m"], ["0.5 m", "0.25 m"], ["0.54 m", "0.25 m"], ["1.02 m", "0 m"]]
[[free_water]]
name = "reservoir"
box = [["0 m", "0 m"], ["0.5 m", "0.2 m"]]
[initial]
water_table = [["0.5 m", "0.2 m"], ["1.02 m", "0 m"]]
stress = "none"
[[boundary]]
side = "base"
soil = "rough"
[[boundary]]
name = "A-B"
line = [["0.5 m", "0 m"], ["0.5 m", "0.3 m"]]
soil = "roller"
water = "open"
[[stage]]
name = "gravity"
initial  = true
duration = "0.4 s"
ramp     = "0.3 s"
damping  = "10 1/s"
hold_water = true
[[stage]]
name = "failure"
duration = "5 s"
[numerics]
cfl = 0.8
)"),
                              2);
  double fastest = 0;
  while (!run.finished()) {
    run.advance();
    fastest = std::max(fastest, run.state().motion.speed * run.state().setup.lattice.smallest_spacing());
  }
  EXPECT_LT(fastest, std::sqrt(2 * 9.81 * 0.2));
  EXPECT_GT(fastest, 0.1);
}

}  // namespace
}  // namespace polder
