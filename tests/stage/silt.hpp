#pragma once
// The elastic, unsaturated silt of the tests of this room.
#include <string>

namespace polder {

/// Its [[material]], with further keys, and its [[retention]].
inline std::string silt(const std::string& more = "") {
  return R"(
[[material]]
name = "silt"
law = "linear-elastic"
grain_density = "2650 kg/m3"
porosity = 0.4
permeability = "5e-4 m/s"
permeability_exponent = 0
young_modulus = "20 MPa"
poisson_ratio = 0.3
)" + more +
         R"(
[[retention]]
material = "silt"
model = "van-genuchten"
g_a = "0.3 1/m"
g_n = 2
residual = 0.05
)";
}

}  // namespace polder
