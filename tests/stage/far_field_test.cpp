// Absorbing sides hold ground that begins at rest by K0, without a stage in which it comes to rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "case_text.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// Furthest way of a grain of sand 2 m high with an absorbing side in 0.2 s, m.
double moved(const std::string& formulation, const std::string& table, const std::string& more) {
  Simulation<PlaneStrain> run(read_text(fmt::format(R"(
[model]
size = ["2 m", "4 m"]
cell = "0.2 m"
formulation = "{}"
[[material]]
name = "sand"
law = "linear-elastic"
young_modulus = "20 MPa"
poisson_ratio = 0.3
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "1e-4 m/s"
[[soil]]
material = "sand"
box = [["0 m", "0 m"], ["2 m", "2 m"]]
[initial]
stress = "k0"
{}
{}
[[boundary]]
side = "left"
soil = "absorbing"
[[stage]]
name = "event"
duration = "0.2 s"
)",
                                                    formulation, table, more)),
                              1);
  while (!run.finished()) run.advance();
  const auto& soil = run.state().soil;
  double most = 0;
  for (std::size_t p = 0; p < soil.size(); ++p)
    most = std::max(most,
                    std::hypot(soil.position[0][p] - soil.reference[0][p], soil.position[1][p] - soil.reference[1][p]));
  return most;
}

// What moves is the compression of the first milliseconds, in which the pressure of the water builds up.
TEST(FarField, HoldsGroundAtRestFromTheFirstStep) {
  for (const char* formulation : {"double-point", "single-point"}) {
    EXPECT_LT(moved(formulation, "", ""), 6e-5) << formulation;
    EXPECT_LT(moved(formulation, "water_table = [[0, 1], [2, 1]]", ""), 6e-5) << formulation;
    EXPECT_LT(moved(formulation, "water_table = [[0, 3], [2, 3]]", "[[free_water]]\nbox = [[0, 2], [2, 3]]"), 6e-5)
        << formulation;
  }
}

}  // namespace
}  // namespace polder
