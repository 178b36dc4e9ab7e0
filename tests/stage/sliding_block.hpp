#pragma once
// A block that settles under gravity on a bed and then slides along it.
#include <fmt/format.h>

#include <string>

namespace polder {

struct SlidingBlock {
  std::string model;                  ///< keys of [model]
  std::string material;               ///< of the block's material, beside what all have in common
  std::string ground;                 ///< [[soil]], [[wall]] and whatever else
  double duration = 0;                ///< s, of the slide
  std::string initial{}, settling{};  ///< more keys of [initial] and of the first stage

  std::string text() const {
    return fmt::format(R"([model]
{}
[[material]]
name = "block"
law = "linear-elastic"
poisson_ratio = 0.2
porosity = 0.4
{}
{}
[initial]
stress = "gravity"
{}
[[stage]]
name = "rest"
duration = "0.5 s"
initial = true
ramp = "0.2 s"
damping = "50 1/s"
{}
[[stage]]
name = "slide"
duration = {}
)",
                       model, material, ground, initial, settling, duration);
  }
};

}  // namespace polder
