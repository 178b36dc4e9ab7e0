#include "polder/step/fields.hpp"

#include <algorithm>

namespace polder {

template <class Space>
void GridFields<Space>::activate(const Lattice<Space>& lattice, ActiveRows<Space> now) {
  std::vector<Array*> zero{&solid_volume,      &soil_cell_mass,    &linear_drag[0], &linear_drag[1],
                           &quadratic_drag[0], &quadratic_drag[1], &water_volume,   &fill,
                           &pressure,          &pressure_trend,    &potential,      &potential_trend,
                           &saturated_solid,   &carried_volume};
  for (auto* faces :
       {&soil_mass, &soil_velocity, &soil_force, &soil_before, &water_mass, &water_velocity, &relative_flux,
        &water_before, &carried_mass, &discharge, &soil_response, &water_response, &mobility, &shift})
    for (auto& component : *faces) zero.push_back(&component);
  std::vector<Array*> one{&cell_porosity};
  for (auto& component : porosity) one.push_back(&component);
  std::vector<AlignedVector<std::uint8_t>*> flags{&wet};
  for (auto* faces : {&reached, &layers[0], &layers[1], &shift_layers[0], &shift_layers[1], &soil_known})
    for (auto& component : *faces) flags.push_back(&component);

  const auto rest = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (auto* field : zero) std::fill(field->begin() + begin, field->begin() + end, 0.0);
    for (auto* field : one) std::fill(field->begin() + begin, field->begin() + end, 1.0);
    for (auto* field : flags) std::fill(field->begin() + begin, field->begin() + end, std::uint8_t{0});
  };
  for (std::size_t row = 0; row < rows.spans.size(); ++row) {
    const RowSpan before = rows.spans[row], after = now.spans[row];
    if (before == after || before.count() == 0) continue;
    const int j = static_cast<int>(static_cast<std::ptrdiff_t>(row) % lattice.cells[1]);
    const int k = static_cast<int>(static_cast<std::ptrdiff_t>(row) / lattice.cells[1]);
    const auto rest_cells = [&](int begin, int end) {
      if (begin >= end) return;
      for (const int z : {k, k + 1}) {  // the last row of cells has faces beyond it, at the indices of a further row
        if (z > k && (Space::axes == 2 || z < lattice.cells[2])) continue;
        for (const int y : {j, j + 1})
          if (y == j || y == lattice.cells[1]) rest(lattice.index(begin, y, z), lattice.index(end, y, z));
      }
    };
    rest_cells(before.begin, std::min(before.end, after.begin));
    const int from = after.count() > 0 ? std::max(before.begin, after.end) : before.begin;
    if (from < before.end) rest_cells(from, before.end + 1);
  }
  rows = std::move(now);
}

template struct GridFields<PlaneStrain>;
template struct GridFields<Solid>;

}  // namespace polder
