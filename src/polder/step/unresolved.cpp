#include "polder/step/unresolved.hpp"

#include <algorithm>

#include "polder/step/chunk_loop.hpp"
#include "polder/step/face_loop.hpp"
#include "polder/step/gather.hpp"
#include "polder/step/scatter.hpp"
#include "polder/step/wall_transfer.hpp"

namespace polder {

template <class Space>
void find_unresolved(const Setup<Space>& setup, const SoilPoints<Space>& soil, const Tiling<Space>& tiling,
                     GridFields<Space>& grid, Team& team) {
  const auto& lattice = setup.lattice;
  const PhaseBox& box = setup.soil_box;
  for (int c = 0; c < Space::axes; ++c) {
    reflect(grid.soil_before[c], c, true, box, lattice, true);
    std::fill(grid.unresolved[c].begin(), grid.unresolved[c].end(), 0.0);
  }
  over_chunks(tiling, team, [&](std::size_t first, int count) {
    ChunkWeights<Space> chunk;
    chunk.compute(lattice, pointers_at<Space>(soil.position, first), count);
    chunk.find_batches(count);
    const bool walled = beside_walls(setup.walls, lattice, chunk, count);
    over_components<Space>([&]<int c>() {
      double lost[chunk_room];  // momentum
      const double* before = grid.soil_before[c].data();
      if (walled)
        gather_value_beside_walls<c>(setup.walls, lattice, chunk, count, before, lost);
      else
        by_spacing(lattice, [&]<bool graded>() { gather_value<c, graded>(lattice, chunk, count, before, lost); });
      for (int l = 0; l < count; ++l) lost[l] = soil.mass[first + l] * (soil.velocity[c][first + l] - lost[l]);
      double* field = grid.unresolved[c].data();
      if (walled)
        scatter_value_beside_walls<c>(setup.walls, lattice, chunk, lost, count, field);
      else
        scatter_value<c>(lattice, chunk, lost, count, field);
    });
  });
  for (int c = 0; c < Space::axes; ++c) {
    Array& field = grid.unresolved[c];
    fold(field, c, true, box, lattice);
    const bool held[2] = {!moves(box.wall[c][0]) && !box.periodic(c), !moves(box.wall[c][1]) && !box.periodic(c)};
    over_face_rows(lattice, grid.rows, c, team, [&](std::ptrdiff_t first, int count, const std::array<int, 3>& at) {
      for (int i = 0; i < count; ++i) {
        const std::ptrdiff_t f = first + i;
        const int place = c == 0 ? at[0] + i : at[c];
        const bool fixed = (held[0] && place <= box.low[c]) || (held[1] && place >= box.high[c]) || setup.shut(c, f);
        field[f] = !fixed && grid.soil_mass[c][f] > 0 ? field[f] / grid.soil_mass[c][f] : 0;
      }
    });
    reflect(field, c, true, box, lattice);
  }
}

template void find_unresolved(const Setup<PlaneStrain>&, const SoilPoints<PlaneStrain>&, const Tiling<PlaneStrain>&,
                              GridFields<PlaneStrain>&, Team&);
template void find_unresolved(const Setup<Solid>&, const SoilPoints<Solid>&, const Tiling<Solid>&, GridFields<Solid>&,
                              Team&);

}  // namespace polder
