#include "polder/stage/unsaturated_start.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "polder/stage/initial.hpp"
#include "polder/step/unsaturated_step.hpp"

namespace polder {

namespace {

/// One axis' layers of points at the start: each cell is parted into as many as it has points along the axis.
class PointLayers {
 public:
  PointLayers(const GridAxis& axis, int points_per_axis) : axis_(axis), parts_(points_per_axis) {}
  long number(double x) const {
    return static_cast<long>(axis_.graded() ? axis_.place(x) * parts_ : x / (axis_.least() / parts_));
  }
  double thickness(double x) const { return (axis_.graded() ? axis_.width(axis_.cell_at(x)) : axis_.least()) / parts_; }
  double ceiling(double x) const {
    const auto above = static_cast<double>(number(x) + 1);
    return axis_.graded() ? axis_.at_place(above / parts_) : above * thickness(x);
  }

 private:
  const GridAxis& axis_;
  double parts_;
};

}  // namespace

template <class Space>
void set_unsaturated_k0_stress(const Model& model, const Setup<Space>& setup, SoilPoints<Space>& soil) {
  constexpr int up = Space::up;
  const auto layers = [&](int a) { return PointLayers(setup.lattice.axis[a], model.points_per_axis); };
  const PointLayers along = layers(0), across = layers(1), upwards = layers(up);
  std::map<std::pair<long, long>, std::vector<std::size_t>> columns;
  for (std::size_t p = 0; p < soil.size(); ++p)
    columns[{along.number(soil.position[0][p]), Space::axes == 3 ? across.number(soil.position[1][p]) : 0}].push_back(
        p);
  for (auto& column : columns) {
    std::vector<std::size_t>& points = column.second;
    std::sort(points.begin(), points.end(),
              [&](std::size_t a, std::size_t b) { return soil.position[up][a] > soil.position[up][b]; });
    // total stress of whole layers above, Pa; at first that of water over the ground
    const std::size_t top = points.front();
    double above =
        std::max(0.0, pressure_at_start(setup, soil.position[0][top], upwards.ceiling(soil.position[up][top])));
    for (const std::size_t p : points) {
      const MaterialInput& material = model.materials[soil.material[p]];
      const double y = soil.position[up][p];
      const double p_water = pressure_at_start(setup, soil.position[0][p], y);
      const double wet = saturation(setup.pores[soil.material[p]].retention, -p_water);
      const double weight = model.gravity * ((1 - material.porosity) * material.grain_density +
                                             material.porosity * wet * model.water.density);
      const double vertical = -(above + weight * (upwards.ceiling(y) - y)) + wet * p_water;
      above += weight * upwards.thickness(y);
      const double k0 = model.k0.value_or(earth_pressure_at_rest(material));
      for (int a = 0; a < 3; ++a) soil.stress[a][p] = a == up ? vertical : k0 * vertical;
    }
  }
}

template void set_unsaturated_k0_stress(const Model&, const Setup<PlaneStrain>&, SoilPoints<PlaneStrain>&);
template void set_unsaturated_k0_stress(const Model&, const Setup<Solid>&, SoilPoints<Solid>&);

}  // namespace polder
