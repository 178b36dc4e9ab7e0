#include "polder/result/summary.hpp"

#include <fstream>
#include <stdexcept>

#include "polder/result/atomic_file.hpp"

namespace polder {
namespace {

const char* status_name(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
      return "finished";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  throw std::logic_error("summary: unknown status");
}

}  // namespace

nlohmann::ordered_json summary_json(const Summary& s) {
  nlohmann::ordered_json json;
  json["program"] = "polder";
  json["version"] = s.version;
  json["status"] = status_name(s.status);
  json["reason"] = s.reason;
  json["warnings"] = s.warnings;
  json["stage_seconds"] = s.stage_seconds;
  json["simulated_time"] = s.simulated_time;
  json["steps"] = s.steps;
  json["wall_seconds"] = s.wall_seconds;
  json["threads"] = s.threads;
  json["soil_points"] = s.soil_points;
  json["water_points"] = s.water_points;
  json["cells"] = s.cells;
  json["bytes_per_point"] = s.bytes_per_point;
  json["point_steps_per_second"] = s.point_steps_per_second;
  json["pressure_iterations_per_step"] = s.pressure_iterations_per_step;
  json["volume_iterations_per_step"] = s.volume_iterations_per_step;
  json["state_hash"] = s.state_hash;
  json["overfilled_cells"] = s.overfilled_cells;
  json["flux_balance_error"] = s.flux_balance_error;
  json["water_balance_error"] = s.water_balance_error;
  json["solid_mass_error"] = s.solid_mass_error;
  json["energy"] = s.energy;
  json["maxima"] = s.maxima;
  json["kernel_seconds"] = s.kernel_seconds;
  json["case"] = s.case_inputs;
  return json;
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  // Names of cases are the user's: bytes that are no UTF-8 must not cost him the summary.
  write_atomically(path,
                   summary_json(summary).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

nlohmann::ordered_json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": there is no such file");
  try {
    return nlohmann::ordered_json::parse(file);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace polder
