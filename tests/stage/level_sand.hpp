#pragma once
#include <fmt/format.h>

#include <string>

namespace polder {

/// A case: level elastic sand, 2 m high and wide, in a model of 4 m. `start`: the rest of [initial], and what follows.
inline std::string level_sand(const std::string& formulation, const std::string& stress, const std::string& start) {
  return fmt::format(R"(
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
[[stage]]
name = "event"
duration = "0.2 s"
[initial]
stress = "{}"
{}
)",
                     formulation, stress, start);
}

}  // namespace polder
