#pragma once
// What predict_faces() does where no wall or body is near, several faces along x at once: all kinds of faces four at a
// time, and the three kinds that most faces are eight at a time. As functions of their own: where they are inlined into
// its loop, g++ 12 does not vectorise them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "polder/math/simd.hpp"
#include "polder/step/face_predictor.hpp"

namespace polder::face_blocks {

inline constexpr double soil_present = 1e-6;      // share of a face full of grains below which it has no soil
inline constexpr double least_solid = 1e-9;       // share of a cell below which grains in it are rounding
inline constexpr double force_floor = 1e-4;       // least share of grains that an internal force is divided by
inline constexpr double least_saturation = 0.25;  // of a face with one wet side

/// The fields of one component.
struct FaceArrays {
  const double *soil_mass, *water_mass, *force, *flux, *linear_drag, *quadratic_drag;
  double *soil, *water, *porosity, *soil_response, *water_response, *mobility, *soil_before, *water_before;
  const std::uint8_t* wet;  // of cells, as the next
  const double *solid_volume, *cell_porosity;
};

/// Of all faces of a component that lie between two cells.
struct FaceConstants {
  double dt, inverse_volume, full_of_grains, water_density, fall;
  double soil_kept, water_kept;  // of the velocities, after damping
};

inline constexpr int block = 8;

/// Most faces: eight side by side between wet cells of saturated soil, no wall near. As the loop of predict_faces()
/// does it, without its cases: a quarter fewer instructions than predict_four().
[[gnu::noinline]] inline void predict_block(const FaceArrays& at, std::ptrdiff_t first, std::ptrdiff_t step,
                                            const FaceConstants& k) {
  POLDER_INDEPENDENT
  for (std::ptrdiff_t f = first; f < first + block; ++f) {
    const double ms = at.soil_mass[f], mw = at.water_mass[f];
    const double n = std::max(0.2, 1 - ms / k.full_of_grains);
    double soil = at.soil[f] / ms;
    at.soil_before[f] = soil;
    double water = mw * k.inverse_volume > water_present * k.water_density ? at.water[f] / mw : soil;
    at.water_before[f] = water;
    soil = (soil + k.dt * at.force[f] / std::max(ms, force_floor * k.full_of_grains) - k.fall) * k.soil_kept;
    water = (water - k.fall) * k.water_kept;
    const double linear = 0.5 * (at.linear_drag[f - step] + at.linear_drag[f]);
    const double quadratic = 0.5 * (at.quadratic_drag[f - step] + at.quadratic_drag[f]);
    const double o = k.dt * n * n * (linear + quadratic * at.flux[f]) * k.inverse_volume;
    const double Mw = n * k.water_density, Ms = ms * k.inverse_volume;
    const double a = Mw + o, b = Ms + o, inverse = 1 / (Mw * Ms + o * (Mw + Ms));
    const double rw = Mw * water, rs = Ms * soil, ew = k.dt * n, es = k.dt * (1 - n);
    const double water_response = -(b * ew + o * es) * inverse, soil_response = -(a * es + o * ew) * inverse;
    at.porosity[f] = n;
    at.water[f] = (b * rw + o * rs) * inverse;
    at.soil[f] = (a * rs + o * rw) * inverse;
    at.water_response[f] = water_response;
    at.soil_response[f] = soil_response;
    at.mobility[f] = -(n * water_response + (1 - n) * soil_response);
  }
}

/// Likewise eight side by side between wet cells, and no soil near.
[[gnu::noinline]] inline void predict_water_block(const FaceArrays& at, std::ptrdiff_t first, const FaceConstants& k) {
  const double least = water_present * k.water_density / k.inverse_volume, response = -k.dt / k.water_density;
  POLDER_INDEPENDENT
  for (std::ptrdiff_t f = first; f < first + block; ++f) {
    const double mw = at.water_mass[f];
    const double water = mw > least ? at.water[f] / mw : 0.0;
    at.water_before[f] = water;
    at.water[f] = (water - k.fall) * k.water_kept;
    at.water_response[f] = response;
    at.mobility[f] = -response;
    at.porosity[f] = 1;
    at.soil_before[f] = at.soil[f] = at.soil_response[f] = 0;
  }
}

/// Four side by side of any kind, no wall near: all cases of the loop in predict_faces() at once.
[[gnu::noinline]] inline void predict_four(const FaceArrays& at, std::ptrdiff_t f, std::ptrdiff_t step,
                                           const FaceConstants& k) {
  const Vec4 zero = splat4(0), one = splat4(1);
  const auto flags = [&](std::ptrdiff_t cell) {
    const std::uint8_t* wet = at.wet + cell;
    return Vec4{1.0 * wet[0], 1.0 * wet[1], 1.0 * wet[2], 1.0 * wet[3]};
  };
  const Vec4 low = flags(f - step), high = flags(f), any = low + high, one_wet = (low - high) * (low - high);
  const Vec4 ms = load4(at.soil_mass + f), mw = load4(at.water_mass + f);
  const Vec4 has_soil = ms > soil_present * k.full_of_grains ? one : zero;
  const Vec4 something = any + ms + mw > zero ? one : zero;

  const Vec4 solid_low = load4(at.solid_volume + f - step), solid_high = load4(at.solid_volume + f);
  const Vec4 in_wet = low * solid_low + high * solid_high, in_dry = solid_low + solid_high - in_wet;
  const Vec4 least = splat4(least_solid / k.inverse_volume);
  const Vec4 ends = in_wet > least ? one_wet * max4(zero, one - in_dry / max4(in_wet, least)) : zero;
  const Vec4 n_wet = low * load4(at.cell_porosity + f - step) + high * load4(at.cell_porosity + f);
  const Vec4 n_all = max4(splat4(0.2), one - ms / k.full_of_grains), n = n_all + ends * (n_wet - n_all);
  const Vec4 filled = min4(one, mw * k.inverse_volume / (k.water_density * n));
  const Vec4 S = max4(filled, low * high + one_wet * least_saturation);

  const Vec4 soil_before = has_soil * load4(at.soil + f) / max4(ms, splat4(1e-300));
  const Vec4 water_before = mw * k.inverse_volume > splat4(water_present * k.water_density)
                                ? load4(at.water + f) / max4(mw, splat4(1e-300))
                                : soil_before;
  const Vec4 push = k.dt * load4(at.force + f) / max4(ms, splat4(force_floor * k.full_of_grains)) - k.fall;
  const Vec4 soil = (soil_before + push) * k.soil_kept, water = (water_before - k.fall) * k.water_kept;

  const Vec4 of_low = 0.5 * (one + (low - high) * ends);
  const auto drag = [&](const double* cells) {
    return of_low * load4(cells + f - step) + (one - of_low) * load4(cells + f);
  };
  const Vec4 o =
      k.dt * n * n * (drag(at.linear_drag) + drag(at.quadratic_drag) * load4(at.flux + f)) * k.inverse_volume * S;
  const Vec4 Mw = n * k.water_density * max4(S, splat4(1e-6)), Ms = max4(ms * k.inverse_volume, splat4(1e-9));
  const Vec4 a = Mw + o, b = Ms + o, inverse = one / (Mw * Ms + o * (Mw + Ms));
  const Vec4 rw = Mw * water, rs = Ms * soil, ew = k.dt * n * S, es = k.dt * (one - n) * S;
  const Vec4 grains_alone = any + max4(zero, filled - water_present) > zero ? zero : one, both = one - grains_alone;

  const Vec4 water_response =
      -has_soil * both * (b * ew + o * es) * inverse - (one - has_soil) * something * k.dt / k.water_density;
  const Vec4 soil_response = -has_soil * (both * (a * es + o * ew) * inverse + grains_alone * es / b);
  store4(at.porosity + f, n);
  store4(at.soil_before + f, soil_before);
  store4(at.water_before + f, something * water_before);
  store4(at.water + f,
         has_soil * (grains_alone * soil + both * (b * rw + o * rs) * inverse) + (one - has_soil) * something * water);
  store4(at.soil + f, has_soil * (grains_alone * soil + both * (a * rs + o * rw) * inverse));
  store4(at.water_response + f, water_response);
  store4(at.soil_response + f, soil_response);
  store4(at.mobility + f, -(n * water_response + (one - n) * soil_response));
}

/// Eight side by side that nothing has reached.
inline void clear_block(const FaceArrays& at, std::ptrdiff_t first) {
  for (double* field :
       {at.soil_before, at.water_before, at.soil, at.water, at.soil_response, at.water_response, at.mobility})
    std::fill_n(field + first, block, 0.0);
  std::fill_n(at.porosity + first, block, 1.0);
}

inline bool all_zero(const double* value) {
  double sum = 0;
  for (int i = 0; i < block; ++i) sum += std::abs(value[i]);
  return sum == 0;
}

inline bool all_above(const double* value, double bound) {
  bool above = true;
  for (int i = 0; i < block; ++i) above = above && value[i] > bound;
  return above;
}

}  // namespace polder::face_blocks
