// Absorbing sides hold ground that begins at rest by K0, without a stage in which it comes to rest.
#include <gtest/gtest.h>

#include "case_text.hpp"
#include "largest_displacement.hpp"
#include "level_sand.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

/// Of level sand with an absorbing side, in its event.
double moved(const std::string& formulation, const std::string& start) {
  const std::string side = "\n[[boundary]]\nside = \"left\"\nsoil = \"absorbing\"\n";
  Simulation<PlaneStrain> run(read_text(level_sand(formulation, "k0", start + side)), 1);
  while (!run.finished()) run.advance();
  return largest_displacement(run.state().soil);
}

// What moves is the compression of the first milliseconds, in which the pressure of the water builds up.
TEST(FarField, HoldsGroundAtRestFromTheFirstStep) {
  for (const char* formulation : {"double-point", "single-point"}) {
    EXPECT_LT(moved(formulation, ""), 6e-5) << formulation;
    EXPECT_LT(moved(formulation, "water_table = [[0, 1], [2, 1]]"), 6e-5) << formulation;
    EXPECT_LT(moved(formulation, "water_table = [[0, 3], [2, 3]]\n[[free_water]]\nbox = [[0, 2], [2, 3]]"), 6e-5)
        << formulation;
  }
}

}  // namespace
}  // namespace polder
