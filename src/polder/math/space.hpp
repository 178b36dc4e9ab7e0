#pragma once
// What a kernel must know about the space it works in: how many axes, how large a stress is, which way is up.
namespace polder {

/// Plane strain, per metre of thickness. Axes x, y (up). Stress components: xx, yy, zz, xy.
struct PlaneStrain {
  static constexpr int axes = 2;
  static constexpr int stress = 4;
  static constexpr int up = 1;
  static constexpr const char* name = "plane strain";
};

/// Three dimensions. Axes x, y, z (up). Stress components: xx, yy, zz, xy, yz, zx.
struct Solid {
  static constexpr int axes = 3;
  static constexpr int stress = 6;
  static constexpr int up = 2;
  static constexpr const char* name = "3d";
};

/// Index of the stress component (row, column) in the storage order of `Space`.
template <class Space>
constexpr int stress_index(int row, int column) {
  if (row == column) return row;
  const int sum = row + column;  // 1: xy, 3: yz, 2: zx
  return sum == 1 ? 3 : sum == 3 ? 4 : 5;
}

}  // namespace polder
