#pragma once
// What a run must keep: mass of solids, volume of water, agreement of the flux on the grid with the motion of the
// points, cells neither overfilled nor underfilled.
#include <string>
#include <vector>

#include "polder/case/model.hpp"
#include "polder/stage/ground_changes.hpp"

namespace polder {

/// Of a section: |∫ flux dt − change of the points' volume beyond it| / largest volume that has passed.
struct FluxError {
  double error = 0;
  int axis = 0;
  double at = 0;      ///< m, on that axis
  double passed = 0;  ///< that volume over all water at the start
};

template <class Space>
class Audit {
 public:
  /// Starts from the state as it is. The flux is audited through the lines of the boundaries that are open to water; if
  /// there are none, through the upright plane in the middle of the model.
  Audit(const Model& model, const Stepper<Space>& state);

  /// After a step.
  void take(const Stepper<Space>& state, double dt, Team& team);
  /// After the ground was changed between two steps.
  void take(const Stepper<Space>& state, const ChangedMass& changed);

  double solid_mass_error(const Stepper<Space>& state) const;     ///< relative
  double water_balance_error(const Stepper<Space>& state) const;  ///< (stored − initial − in + out)/initial
  /// |∫ flux dt − change of the points' volume beyond the section| / largest volume that has passed (at least a
  /// thousandth of all water), worst section.
  double flux_balance_error() const { return worst_flux().error; }
  FluxError worst_flux() const;

  template <class Archive>
  void each_state(Archive&& archive) {
    archive("audit/solid_at_start", solid_at_start_);
    archive("audit/water_at_start", water_at_start_);
    archive("audit/overfilled", overfilled_most);
    archive("audit/underfilled", underfilled_most);
    archive("audit/pressure_iterations", pressure_iterations);
    archive("audit/volume_iterations", volume_iterations);
    archive("audit/steps", steps);
    archive("audit/water_in", water_in);
    archive("audit/water_out", water_out);
    archive("audit/solid_in", solid_in);
    archive("audit/solid_out", solid_out);
    archive("audit/displaced", displaced);
    archive("audit/body_work", body_work);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const std::string name = "audit/section" + std::to_string(i) + "/";
      archive(name + "beyond_at_start", sections_[i].beyond_at_start);
      archive(name + "moved", sections_[i].moved);
      archive(name + "exchanged", sections_[i].exchanged);
      archive(name + "passed", sections_[i].passed);
      archive(name + "passed_before", sections_[i].passed_before);
      archive(name + "most", sections_[i].most);
    }
  }

  double overfilled_now = 0, underfilled_now = 0;  ///< share of wet cells with F > 1.05; of interior ones with F < 0.95
  double overfilled_most = 0, underfilled_most = 0;
  std::uint64_t pressure_iterations = 0, volume_iterations = 0;
  std::uint64_t steps = 0;
  double water_in = 0, water_out = 0;   ///< m³
  double solid_in = 0, solid_out = 0;   ///< kg, by changes of the ground
  double displaced = 0, body_work = 0;  ///< m³ of water, net, that made way for bodies; J, of the bodies on all

 private:
  struct Section {
    int axis, face;
    double at;                   ///< m, where on its axis
    double beyond_at_start = 0;  ///< m³ of water past the section when the first step began
    double moved = 0;            ///< change of it until the last step began
    double exchanged = 0;        ///< m³ that reservoirs have given beyond it until the last step began
    double passed = 0, passed_before = 0, most = 0;  ///< ∫ flux dt: after the last step, before it, largest so far
  };
  struct CellCounts {
    std::uint64_t wet = 0, over = 0, inside = 0, under = 0;  ///< wet; F > 1.05; amid wet ones; of these F < 0.95

    void operator+=(const CellCounts& more) {
      wet += more.wet, over += more.over, inside += more.inside, under += more.under;
    }
  };
  double water_beyond(const Stepper<Space>& state, const Section& section, std::ptrdiff_t first, int count,
                      const std::array<int, 3>& place) const;
  CellCounts count_cells(const Stepper<Space>& state, std::ptrdiff_t first, int count,
                         const std::array<int, 3>& place) const;
  CellCounts look_through(const Stepper<Space>& state, Team& team);
  void book(const Stepper<Space>& state, const Exchange& exchange);

  std::vector<Section> sections_;
  std::vector<double> beyond_;  // m³ past each section, row by row
  double solid_at_start_ = 0, water_at_start_ = 0;
};

/// Water in the model, m³: of the water points, of what soil points carry, and what is between the two.
template <class Space>
double stored_water(const Stepper<Space>& state);

}  // namespace polder
