#include <array>

#include "polder/material/law.hpp"

// The laws that the program knows, one line a law: the name of the function that describes it, in its own file.
// clang-format off
#define POLDER_SOIL_LAWS(law) \
  law(linear_elastic)         \
  law(neo_hookean)            \
  law(mohr_coulomb)           \
  law(softening_mohr_coulomb) \
  law(tresca)                 \
  law(drucker_prager)         \
  law(modified_cam_clay)
// clang-format on

namespace polder {

#define POLDER_DECLARE(name) LawDescription name##_law();
POLDER_SOIL_LAWS(POLDER_DECLARE)

std::span<const LawDescription> soil_laws() {
#define POLDER_DESCRIBE(name) name##_law(),
  static const std::array laws{POLDER_SOIL_LAWS(POLDER_DESCRIBE)};
  return laws;
}

const LawDescription* find_soil_law(std::string_view name) {
  for (const LawDescription& law : soil_laws())
    if (law.name == name) return &law;
  return nullptr;
}

}  // namespace polder
