#pragma once
// summary.json: what a run was, why it stopped, and the audits by which one may trust it.
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace polder {

enum class RunStatus { finished, failed, interrupted };

/// The keys of summary.json. Errors and shares are pure numbers; NaN (not measured) is written as null.
struct Summary {
  RunStatus status = RunStatus::finished;
  std::string version;                          ///< of Polder
  std::string reason;                           ///< why it stopped, as a sentence
  std::vector<std::string> warnings;            ///< what the reader of the results must know; sentences
  std::map<std::string, double> stage_seconds;  ///< s, how long each stage that is over has lasted
  double simulated_time = 0;                    ///< s
  std::uint64_t steps = 0;
  double wall_seconds = 0;  ///< s
  int threads = 1;
  std::uint64_t soil_points = 0, water_points = 0, cells = 0;
  double bytes_per_point = 0;  ///< B
  double point_steps_per_second = 0;
  double pressure_iterations_per_step = 0, volume_iterations_per_step = 0;
  std::string state_hash;                ///< hash_text of state_hash
  double overfilled_cells = 0;           ///< share of wet cells with fill above 1.05
  double flux_balance_error = 0;         ///< boundary flux integrated from grid velocities against the points' balance
  double water_balance_error = 0;        ///< (in − out − stored) / initial
  double solid_mass_error = 0;           ///< relative
  std::map<std::string, double> energy;  ///< J (J per metre in plane strain): kinetic, potential, dissipated, ...
  std::map<std::string, double> maxima;  ///< SI; the largest speed, pressure, ... of the run
  std::map<std::string, double> kernel_seconds;  ///< wall time by kernel
  nlohmann::ordered_json case_inputs;            ///< the case with every default filled in: the key `case`
};

nlohmann::ordered_json summary_json(const Summary& summary);

/// Atomically, so that a reader never meets half a file. Throws OutputError.
void write_summary(const std::filesystem::path& path, const Summary& summary);

/// Throws std::runtime_error naming the file where it is missing or no JSON.
nlohmann::ordered_json read_json(const std::filesystem::path& path);

}  // namespace polder
