#pragma once
// Laboratory tests on one point of a material: what a law answers to a path that is known by heart.
// Signs of the law: stress and strain positive in tension. Rows are what a laboratory reports: compression positive.
#include <array>
#include <string>
#include <vector>

#include "polder/material/law.hpp"

namespace polder {

enum class ElementTest { oedometer, triaxial_drained, triaxial_undrained, simple_shear, simple_shear_undrained };

/// A test. Axes of the sample: y is axial (up), x and z lateral; shear acts in xy.
struct ElementPath {
  ElementTest test = ElementTest::triaxial_drained;
  double vertical_stress = 100e3;  ///< Pa, effective, compression positive, at the start
  double stress_ratio = 1;         ///< lateral over vertical effective stress at the start
  /// Oedometer: vertical stresses (Pa, compression positive) reached one after the other, up or down.
  std::vector<double> loads{};
  double strain = 0.05;  ///< triaxial: axial strain (compression positive; negative: extension); simple shear: γ_xy
  int steps = 500;       ///< of the whole path; of each load in the oedometer
};

/// One line of the result. Pressures in Pa, compression positive; strains compression positive but γ.
struct ElementRow {
  double axial_strain = 0, lateral_strain = 0, volumetric_strain = 0;
  double shear_strain = 0;                          ///< γ_xy
  double axial = 0, lateral = 0, out_of_plane = 0;  ///< effective stresses σ'_yy, σ'_xx, σ'_zz
  double shear = 0;                                 ///< τ_xy
  double mean = 0;                                  ///< p' = (σ'₁ + σ'₂ + σ'₃)/3
  double deviator = 0;                              ///< q = √(3 J₂), |σ₁ − σ₃| in the triaxial test
  double pore_pressure = 0;                         ///< u, excess
  double porosity = 0;
  double plastic_shear_strain = 0;
};

struct ElementResult {
  std::vector<ElementRow> rows;  ///< the start, then one a step
  /// Empty, or why the path ended early: where, and what to change.
  std::string stopped;
};

/// Runs the path on a point of `law` that starts at `porosity`. `max_porosity` ends the test: grains lose contact.
ElementResult run_element_test(const SoilLaw& law, const ElementPath& path, double porosity, double max_porosity);

/// Name in input files and back; nullptr-free: throws std::invalid_argument with the list of names.
ElementTest element_test_from_name(std::string_view name);
std::string_view element_test_name(ElementTest test);

}  // namespace polder
