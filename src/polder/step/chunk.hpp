#pragma once
// Spline weights for a chunk of consecutive points, and the two moves that every transfer is made of: adding a point's
// rows to the grid and summing the grid's rows at a point (docs/theory.md, "Transfers").
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "polder/grid/lattice.hpp"
#include "polder/math/simd.hpp"

namespace polder {

inline constexpr int chunk_size = 32;
inline constexpr int chunk_room = chunk_size + 4;  // so that four values can be read or written from any point on

/// What the transfers need of where the points of a chunk are. Set 0: centres, set 1: faces.
template <class Space>
struct alignas(64) ChunkWeights {
  static constexpr int axes = Space::axes;
  double delta[axes][2][chunk_room];          // from the middle node, spacings
  double weight[axes][2][3][chunk_size];      // of axes ≥ 1
  double derivative[axes][2][3][chunk_size];  // per spacing
  int cell_base[chunk_size];                  // index of the stencil's first cell centre
  int face_shift[axes][chunk_size];           // further steps to the first of the three faces
  int cell[axes][chunk_size];                 // the point's cell
  double share[axes][chunk_size];             // of its cell below the point; on graded lattices
  double inertia[axes][2][chunk_size];        // Σ weight (node − point)², square spacings; likewise
  double node[axes][2][3][chunk_size];        // from the middle one, spacings, where not −1, 0 and 1; likewise
  const SplinePiece* row[2][chunk_size];      // along x; likewise
  int batches;                                // of points that read at once
  int batch[chunk_size];                      // their first points: up to four that follow each other in one cell

  template <bool with_derivative = true>
  void compute(const Lattice<Space>& lattice, const std::array<const double*, axes>& position, int count) {
    locate(lattice, position, count);
    if (lattice.graded) return;
    for (int a = 1; a < axes; ++a)
      for (int set = 0; set < 2; ++set)
        for (int l = 0; l < count; ++l) {
          double w[3], o[3], d[3];
          spline_weights(delta[a][set][l], w, o, d);
          put<with_derivative>(a, set, l, w, d);
        }
  }

  /// For points that only read: where they are, and their batches; on graded lattices the weights, too.
  void compute_places(const Lattice<Space>& lattice, const std::array<const double*, axes>& position, int count) {
    locate(lattice, position, count);
    find_batches(count);
  }

  void find_batches(int count) {
    batches = 0;
    for (int l = 0, begin = 0; l < count; ++l) {
      if (l > 0 && cell_base[l] == cell_base[l - 1] && l < begin + 4) continue;
      batch[batches++] = begin = l;
    }
  }

  /// Distance of point l on axis a from the node about which component c's moments are taken, spacings: the centre of
  /// the point's cell, on axis c its low face; on graded lattices the middle node.
  double from_reference(int c, int a, int l, bool graded) const {
    return a != c || graded ? delta[a][a == c][l] : delta[a][0][l] + 0.5;
  }

  /// What is `middle` at the middle one of point l's three nodes on axis a ≥ 1 and changes by `slope` per spacing, at
  /// all three.
  template <bool graded>
  [[gnu::always_inline]] void at_nodes(int a, int set, int l, Vec4 middle, Vec4 slope, Vec4 (&at)[3]) const {
    at[0] = graded ? middle + node[a][set][0][l] * slope : middle - slope;
    at[1] = middle;
    at[2] = graded ? middle + node[a][set][2][l] * slope : middle + slope;
  }

  /// The three weights along an axis of a graded lattice, also along x.
  void weights(int a, int set, int l, double (&w)[3], double (&o)[3], double (&d)[3]) const {
    if (a == 0) return unpack(row[set][l]->row(delta[0][set][l]), set == 1 && face_shift[0][l] != 0, w, o, d);
    for (int i = 0; i < 3; ++i) {
      w[i] = weight[a][set][i][l];
      o[i] = w[i] * (node[a][set][i][l] - delta[a][set][l]);
      d[i] = derivative[a][set][i][l];
    }
  }

 private:
  void locate(const Lattice<Space>& lattice, const std::array<const double*, axes>& position, int count) {
    for (int l = 0; l < count; ++l) cell_base[l] = static_cast<int>(lattice.index(-1, -1, axes == 3 ? -1 : 0));
    for (int a = 0; a < axes; ++a) {
      if (lattice.graded) {
        compute_graded(lattice, a, position[a], count);
        continue;
      }
      const double inverse = 1 / lattice.spacing[a];
      const int step = static_cast<int>(lattice.stride[a]);
      const double* x = position[a];
      for (int l = 0; l < count; ++l) {
        const double scaled = x[l] * inverse;
        const int b = static_cast<int>(scaled);
        const double f = scaled - b;
        const int upper = f >= 0.5;
        cell[a][l] = b;
        cell_base[l] += b * step;
        face_shift[a][l] = upper * step;
        delta[a][0][l] = f - 0.5;
        delta[a][1][l] = f - upper;
      }
    }
  }

  template <bool with_derivative = true>
  void put(int a, int set, int l, const double (&w)[3], const double (&d)[3]) {
    for (int i = 0; i < 3; ++i) {
      weight[a][set][i][l] = w[i];
      if constexpr (with_derivative) derivative[a][set][i][l] = d[i];
    }
  }
  static void unpack(const SplineRow& row_, int lane, double (&w)[3], double (&o)[3], double (&d)[3]) {
    for (int i = 0; i < 3; ++i)
      w[i] = row_.weight[lane + i], o[i] = row_.offset[lane + i], d[i] = row_.derivative[lane + i];
  }

  void compute_graded(const Lattice<Space>& lattice, int a, const double* x, int count) {
    const GridAxis& axis = lattice.axis[a];
    const GradedSpline& spline = *lattice.spline[a];
    const double inverse = 1 / lattice.spacing[a];
    const int step = static_cast<int>(lattice.stride[a]);
    for (int l = 0; l < count; ++l) {
      const int b =
          std::clamp(static_cast<int>(axis.graded() ? axis.cell_at(x[l]) : x[l] * inverse), 0, axis.cells() - 1);
      const int upper = x[l] >= axis.knot(b);
      cell[a][l] = b;
      cell_base[l] += b * step;
      face_shift[a][l] = upper * step;
      share[a][l] = axis.place_from(b, x[l]) - b;
      delta[a][0][l] = (x[l] - axis.centre(b)) * inverse;
      delta[a][1][l] = (x[l] - axis.edge(b + upper)) * inverse;
      const SplinePiece* pieces[2] = {&spline.centres(b), &spline.faces(b, upper)};
      for (int set = 0; set < 2; ++set) {
        const double from_middle = delta[a][set][l];
        inertia[a][set][l] = pieces[set]->inertia(from_middle);
        if (a == 0) {
          row[set][l] = pieces[set];
          continue;
        }
        const int lane = set == 1 ? upper : 0;
        double w[3], o[3], d[3];
        unpack(pieces[set]->row(from_middle), lane, w, o, d);
        put(a, set, l, w, d);
        for (int i = 0; i < 3; ++i) node[a][set][i][l] = pieces[set]->node[lane + i];
      }
    }
  }
};

/// Index of the cell in which point l is.
template <class Space>
inline std::ptrdiff_t cell_index(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int l) {
  return chunk.cell_base[l] + 1 + lattice.stride[1] + lattice.stride[2];
}

/// The same as places on the axes.
template <class Space>
inline std::array<int, 3> cell_places(const ChunkWeights<Space>& chunk, int l) {
  return {chunk.cell[0][l], chunk.cell[1][l], Space::axes == 3 ? chunk.cell[Space::axes - 1][l] : 0};
}

/// Index of the first node of point l's stencil for component c; its rows along x have four nodes.
template <int c, class Space>
inline std::ptrdiff_t stencil_base(const ChunkWeights<Space>& chunk, int l) {
  if constexpr (c == 0)
    return chunk.cell_base[l];
  else
    return chunk.cell_base[l] + chunk.face_shift[c][l];
}

/// Point l's weights along x for component c.
template <int c, bool graded = false, class Space>
inline SplineRow x_row(const ChunkWeights<Space>& chunk, int l) {
  if constexpr (graded)
    return chunk.row[c == 0][l]->row(chunk.delta[0][c == 0][l]);
  else if constexpr (c == 0)
    return face_row(chunk.delta[0][1][l], chunk.face_shift[0][l]);
  else
    return centre_row(chunk.delta[0][0][l]);
}

/// Volume of the cells that a chunk's points are in; for graded lattices.
template <class Space>
inline double own_cell_volume(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int l) {
  double v = 1;
  for (int a = 0; a < Space::axes; ++a) v *= lattice.axis[a].width(chunk.cell[a][l]);
  return v;
}

/// Visits the rows of point l's stencil of component c: body(position of the row relative to the base, weight and
/// derivative of its y and of its z, and which of the three nodes these are). In plane strain z's are 1, 0 and 1.
template <int c, class Space, class Body>
[[gnu::always_inline]] inline void over_rows(const ChunkWeights<Space>& chunk,
                                             const std::array<std::ptrdiff_t, 3>& stride, int l, Body&& body) {
  constexpr int sy = c == 1;
  if constexpr (Space::axes == 2) {
    for (int j = 0; j < 3; ++j)
      body(j * stride[1], chunk.weight[1][sy][j][l], chunk.derivative[1][sy][j][l], 1.0, 0.0, j, 1);
  } else {
    constexpr int sz = c == 2;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        body(j * stride[1] + k * stride[2], chunk.weight[1][sy][j][l], chunk.derivative[1][sy][j][l],
             chunk.weight[2][sz][k][l], chunk.derivative[2][sz][k][l], j, k);
  }
}

/// What a box that reaches `half` cells (at most half a cell) to either side of x has in the lower one of the two cells
/// that it overlaps on an axis, pushed inside [low, high) cells; x in cells.
struct AxisOverlap {
  int cell;      ///< the lower one
  double share;  ///< of it

  AxisOverlap(double x, double half, int low, int high) {
    half = std::min(0.5, half);
    const double begin = std::min(std::max(x, low + half), high - half) - half;
    cell = std::max(low, static_cast<int>(begin));
    share = std::min(1.0, std::max(0.0, (cell + 1 - begin) * (0.5 / half)));
  }
};

/// Share of a point's content that falls in each of the 2^axes cells that its own box overlaps. The box has `half`
/// cells on either side (per axis, at most half a cell) and is pushed inside [low, high) cells.
template <class Space>
struct BoxOverlap {
  std::ptrdiff_t base = 0;
  double share[3][2] = {};

  BoxOverlap() = default;
  BoxOverlap(const Lattice<Space>& lattice, const std::array<double, 3>& position, double half,
             const std::array<int, 3>& low, const std::array<int, 3>& high)
      : BoxOverlap(lattice, position, std::array{half, half, half}, low, high) {}

  BoxOverlap(const Lattice<Space>& lattice, const std::array<double, 3>& position, const std::array<double, 3>& halves,
             const std::array<int, 3>& low, const std::array<int, 3>& high) {
    int first[3] = {0, 0, 0};
    for (int a = 0; a < Space::axes; ++a) {
      const AxisOverlap on_axis(lattice.axis[a].place(position[a]), halves[a], low[a], high[a]);
      first[a] = on_axis.cell;
      share[a][0] = on_axis.share;
      share[a][1] = 1 - on_axis.share;
    }
    base = lattice.index(first[0], first[1], first[2]);
  }

  /// body(cell index, share)
  template <class Body>
  [[gnu::always_inline]] void over_cells(const Lattice<Space>& lattice, Body&& body) const {
    if constexpr (Space::axes == 2) {
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) body(base + i + j * lattice.stride[1], share[0][i] * share[1][j]);
    } else {
      for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
          for (int i = 0; i < 2; ++i)
            body(base + i + j * lattice.stride[1] + k * lattice.stride[2], share[0][i] * share[1][j] * share[2][k]);
    }
  }
};

/// The same shares for a chunk of points, whose boxes need not be equal.
template <class Space>
struct alignas(64) ChunkOverlap {
  static constexpr int axes = Space::axes;
  double share[axes][chunk_size];  // of the lower of the two cells
  int base[chunk_size];

  void compute(const Lattice<Space>& lattice, const std::array<const double*, axes>& position,
               const std::array<const double*, axes>& half_edges, int count, const std::array<int, 3>& low,
               const std::array<int, 3>& high) {
    for (int l = 0; l < count; ++l) base[l] = static_cast<int>(lattice.index(0, 0, 0));
    for (int a = 0; a < axes; ++a) {
      const double inverse = 1 / lattice.spacing[a];
      const int step = static_cast<int>(lattice.stride[a]), lowest = low[a], beyond = high[a];
      const double *x = position[a], *edge = half_edges[a];
      double* of_lower = share[a];
      const auto put = [&](int l, double place) {
        const AxisOverlap on_axis(place, edge[l], lowest, beyond);
        of_lower[l] = on_axis.share;
        base[l] += on_axis.cell * step;
      };
      if (lattice.axis[a].graded()) {
        for (int l = 0; l < count; ++l) put(l, lattice.axis[a].place(x[l]));
      } else {
        POLDER_INDEPENDENT
        for (int l = 0; l < count; ++l) put(l, x[l] * inverse);
      }
    }
  }

  /// body(cell index, share of `whole`) for point l
  template <class Content, class Body>
  [[gnu::always_inline]] void over_cells(const Lattice<Space>& lattice, int l, Content whole, Body&& body) const {
    const std::ptrdiff_t first = base[l], next_row = lattice.stride[1], next_plane = lattice.stride[2];
    const auto row = [&](std::ptrdiff_t at, Content content) {
      const Content lower = share[0][l] * content;
      body(at, lower);
      body(at + 1, content - lower);
    };
    const auto plane = [&](std::ptrdiff_t at, Content content) {
      const Content lower = share[1][l] * content;
      row(at, lower);
      row(at + next_row, content - lower);
    };
    if constexpr (axes == 2) {
      plane(first, whole);
    } else {
      const Content lower = share[axes - 1][l] * whole;
      plane(first, lower);
      plane(first + next_plane, whole - lower);
    }
  }
};

/// Half the edge, in cells, of a box of volume `volume` with the proportions of a cell.
template <class Space>
inline double half_edge(double volume, double cell_volume) {
  if constexpr (Space::axes == 2)
    return 0.5 * std::sqrt(volume / cell_volume);
  else
    return 0.5 * std::cbrt(volume / cell_volume);
}

/// The same for a chunk, each in the proportions of its own cell.
template <class Space>
inline void half_edges(const double (&volume)[chunk_size], const Lattice<Space>& lattice,
                       const ChunkWeights<Space>& chunk, int count, double (&half)[chunk_size]) {
  if (lattice.graded) {
    for (int l = 0; l < count; ++l) half[l] = half_edge<Space>(volume[l], own_cell_volume(lattice, chunk, l));
    return;
  }
  const double inverse = 1 / lattice.cell_volume();
  if constexpr (Space::axes == 2) {
    for (int l = 0; l < count; ++l) half[l] = 0.5 * std::sqrt(volume[l] * inverse);
  } else {
    for (int l = 0; l < count; l += 4) {
      Vec4 part{1, 1, 1, 1};
      const int filled = std::min(4, count - l);
      if (filled == 4)
        part = load4(volume + l) * inverse;
      else
        for (int i = 0; i < filled; ++i) part[i] = volume[l + i] * inverse;
      store4(half + l, 0.5 * cube_root(part));
    }
  }
}

}  // namespace polder
