#pragma once
// What four points of one cell read from a face field.
//
// All points of a cell have the same nodes for component c: along c from the four faces around, of which one has no
// weight for a point, along the other axes the cell's own and the two neighbouring centres. So a value of the grid is
// loaded once for four points, one in each lane.
#include "polder/step/chunk.hpp"

namespace polder {

/// The value of four points, its moments about the reference node (ChunkWeights::from_reference) and its slopes by
/// axis.
template <int axes>
struct FourSums {
  Vec4 value, moment[axes], slope[axes];
};

/// Weights and their derivatives of `n` nodes on an axis; where these are, from the reference node, on graded lattices.
template <int n>
struct FourWeights {
  Vec4 weight[n], slope[n], node[n];
};

inline FourWeights<3> centre_weights(Vec4 from_centre) {
  FourWeights<3> at;
  Vec4 offset[3];
  spline_weights(from_centre, at.weight, offset, at.slope);
  return at;
}

inline FourWeights<4> face_weights(Vec4 from_centre, Vec4 from_face) {
  FourWeights<4> at;
  Vec4 w[3], offset[3], d[3];
  spline_weights(from_face, w, offset, d);
  const auto upper = from_centre >= 0;
  const auto put = [&](Vec4(&to)[4], const Vec4(&of)[3]) {
    constexpr Vec4 none{};
    to[0] = upper ? none : of[0];
    to[1] = upper ? of[0] : of[1];
    to[2] = upper ? of[1] : of[2];
    to[3] = upper ? of[2] : none;
  };
  put(at.weight, w);
  put(at.slope, d);
  return at;
}

/// Reads component c. `own_difference`: the slope along c is the difference of the two faces of the points' cell.
template <int c, bool with_slope, bool graded, bool own_difference, class Space>
class FourPoints {
 public:
  static constexpr int axes = Space::axes;

  /// For the points from `l` on that are in one cell.
  [[gnu::always_inline]] FourPoints(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk,
                                    const std::array<std::ptrdiff_t, 3>& stride, int l, int count)
      : stride_(stride) {
    if constexpr (graded) {
      take_graded(lattice, chunk, l, count);
    } else {
      for (int a = 0; a < axes; ++a)
        if (a != c) centres_[a] = centre_weights(load4(chunk.delta[a][0] + l));
      faces_ = face_weights(load4(chunk.delta[c][0] + l), load4(chunk.delta[c][1] + l));
    }
    if constexpr (own_difference) {
      const double step = lattice.spacing[c] / lattice.axis[c].width(chunk.cell[c][l]);
      faces_.slope[1] = splat4(-step);
      faces_.slope[2] = splat4(step);
    }
  }

  /// Of the field whose value at the first node is at `at`.
  [[gnu::always_inline]] FourSums<axes> sums(const double* at) const { return all<true, with_slope>(at); }
  [[gnu::always_inline]] Vec4 value(const double* at) const { return all<false, false>(at).value; }

 private:
  static constexpr int inner = c == 0 ? 1 : 0, outer = axes == 3 ? 3 - c - inner : inner;  // the other axes

  /// sum (+)= term
  template <bool first>
  [[gnu::always_inline]] static void take(Vec4& sum, Vec4 term) {
    if constexpr (first)
      sum = term;
    else
      sum += term;
  }

  [[gnu::always_inline]] static Vec4 moment(const FourWeights<3>& own, Vec4 low, Vec4 high) {
    return graded ? own.node[0] * low + own.node[2] * high : high - low;
  }

  /// Along the three centres of axis `inner`.
  template <bool with_moments, bool with_slopes>
  [[gnu::always_inline]] FourSums<axes> line(const double* at) const {
    const auto& own = centres_[inner];
    FourSums<axes> sums;
    const Vec4 low = splat4(at[0]), middle = splat4(at[stride_[inner]]), high = splat4(at[2 * stride_[inner]]);
    const Vec4 low_part = own.weight[0] * low, high_part = own.weight[2] * high;
    sums.value = low_part + own.weight[1] * middle + high_part;
    if constexpr (with_moments) sums.moment[inner] = moment(own, low_part, high_part);
    if constexpr (with_slopes) sums.slope[inner] = own.slope[0] * low + own.slope[1] * middle + own.slope[2] * high;
    return sums;
  }

  /// Along the centres of both other axes.
  template <bool with_moments, bool with_slopes>
  [[gnu::always_inline]] FourSums<axes> plane(const double* at) const {
    if constexpr (axes == 2) {
      return line<with_moments, with_slopes>(at);
    } else {
      const auto& own = centres_[outer];
      FourSums<axes> sums;
      Vec4 part[3];
      unrolled<3>([&]<int k>() POLDER_INLINED {
        const auto of_line = line<with_moments, with_slopes>(at + k * stride_[outer]);
        part[k] = own.weight[k] * of_line.value;
        take<k == 0>(sums.value, part[k]);
        if constexpr (with_moments) take<k == 0>(sums.moment[inner], own.weight[k] * of_line.moment[inner]);
        if constexpr (with_slopes) {
          take<k == 0>(sums.slope[inner], own.weight[k] * of_line.slope[inner]);
          take<k == 0>(sums.slope[outer], own.slope[k] * of_line.value);
        }
      });
      if constexpr (with_moments) sums.moment[outer] = moment(own, part[0], part[2]);
      return sums;
    }
  }

  /// Over all nodes.
  template <bool with_moments, bool with_slopes>
  [[gnu::always_inline]] FourSums<axes> all(const double* at) const {
    FourSums<axes> sums;
    Vec4 part[4];
    unrolled<4>([&]<int i>() POLDER_INLINED {
      const auto of_plane = plane<with_moments, with_slopes>(at + i * stride_[c]);
      part[i] = faces_.weight[i] * of_plane.value;
      take<i == 0>(sums.value, part[i]);
      if constexpr (with_slopes && !own_difference) take<i == 0>(sums.slope[c], faces_.slope[i] * of_plane.value);
      if constexpr (with_slopes && own_difference && (i == 1 || i == 2))
        take<i == 1>(sums.slope[c], faces_.slope[i] * of_plane.value);
      unrolled<axes>([&]<int a>() POLDER_INLINED {
        if constexpr (a != c && with_moments) take<i == 0>(sums.moment[a], faces_.weight[i] * of_plane.moment[a]);
        if constexpr (a != c && with_slopes) take<i == 0>(sums.slope[a], faces_.weight[i] * of_plane.slope[a]);
      });
    });
    if constexpr (with_moments) {
      if constexpr (graded)
        sums.moment[c] =
            faces_.node[0] * part[0] + faces_.node[1] * part[1] + faces_.node[2] * part[2] + faces_.node[3] * part[3];
      else
        sums.moment[c] = part[2] - part[0] + 2 * part[3];
    }
    return sums;
  }

  void take_graded(const Lattice<Space>& lattice, const ChunkWeights<Space>& chunk, int first, int count) {
    for (int lane = 0; lane < 4; ++lane) {
      const int l = std::min(first + lane, count - 1);
      const auto take_row = [&]<int n>(FourWeights<n>& to, const SplineRow& row) {
        for (int i = 0; i < n; ++i) {
          to.weight[i][lane] = row.weight[i];
          to.slope[i][lane] = row.derivative[i];
          to.node[i][lane] = row.node[i];
        }
      };
      for (int a = 0; a < axes; ++a) {
        const GradedSpline& spline = *lattice.spline[a];
        const int cell = chunk.cell[a][l];
        if (a != c)
          take_row(centres_[a], spline.centres(cell).row(chunk.delta[a][0][l]));
        else
          take_row(faces_, spline.faces(cell, chunk.face_shift[a][l] != 0).row(chunk.delta[a][1][l]));
      }
    }
  }

  std::array<std::ptrdiff_t, 3> stride_;
  FourWeights<3> centres_[axes];  // of the axes but c
  FourWeights<4> faces_;          // of axis c
};

}  // namespace polder
