#include "polder/stage/unsaturated_start.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "polder/stage/initial.hpp"
#include "polder/step/unsaturated_step.hpp"

namespace polder {

template <class Space>
void set_unsaturated_k0_stress(const Model& model, const Setup<Space>& setup, SoilPoints<Space>& soil) {
  constexpr int up = Space::up;
  std::array<double, 3> d{1, 1, 1};
  for (int a = 0; a < Space::axes; ++a) d[a] = setup.lattice.spacing[a] / model.points_per_axis;
  std::map<std::pair<long, long>, std::vector<std::size_t>> columns;
  for (std::size_t p = 0; p < soil.size(); ++p)
    columns[{static_cast<long>(soil.position[0][p] / d[0]),
             Space::axes == 3 ? static_cast<long>(soil.position[1][p] / d[1]) : 0}]
        .push_back(p);
  for (auto& column : columns) {
    std::vector<std::size_t>& points = column.second;
    std::sort(points.begin(), points.end(),
              [&](std::size_t a, std::size_t b) { return soil.position[up][a] > soil.position[up][b]; });
    double above = 0;  // total stress of whole layers above, Pa
    for (const std::size_t p : points) {
      const MaterialInput& material = model.materials[soil.material[p]];
      const double y = soil.position[up][p];
      const double p_water = pressure_at_start(setup, soil.position[0][p], y);
      const double wet = saturation(setup.pores[soil.material[p]].retention, -p_water);
      const double weight = model.gravity * ((1 - material.porosity) * material.grain_density +
                                             material.porosity * wet * model.water.density);
      const double ceiling = (std::floor(y / d[up]) + 1) * d[up];
      const double vertical = -(above + weight * (ceiling - y)) + wet * p_water;
      above += weight * d[up];
      const double k0 = model.k0.value_or(earth_pressure_at_rest(material));
      for (int a = 0; a < 3; ++a) soil.stress[a][p] = a == up ? vertical : k0 * vertical;
    }
  }
}

template void set_unsaturated_k0_stress(const Model&, const Setup<PlaneStrain>&, SoilPoints<PlaneStrain>&);
template void set_unsaturated_k0_stress(const Model&, const Setup<Solid>&, SoilPoints<Solid>&);

}  // namespace polder
