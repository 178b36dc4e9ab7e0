#include "polder/result/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "polder/result/state_hash.hpp"
#include "temporary_folder.hpp"

using namespace polder;

TEST(Summary, HasEveryKeyOfTheContractAndReadsBack) {
  const TemporaryFolder folder;
  Summary summary;
  summary.status = RunStatus::interrupted;
  summary.reason = "SIGINT at t = 1.5 s";
  summary.simulated_time = 1.5;
  summary.water_balance_error = 1.0 / 3e16;
  summary.flux_balance_error = std::nan("");
  summary.energy["kinetic"] = 12.5;
  summary.case_inputs["name"] = "dike";
  write_summary(folder.path / "summary.json", summary);
  const auto json = read_json(folder.path / "summary.json");
  for (const char* key : {"status",
                          "reason",
                          "simulated_time",
                          "steps",
                          "wall_seconds",
                          "threads",
                          "soil_points",
                          "water_points",
                          "cells",
                          "bytes_per_point",
                          "point_steps_per_second",
                          "pressure_iterations_per_step",
                          "volume_iterations_per_step",
                          "state_hash",
                          "overfilled_cells",
                          "flux_balance_error",
                          "water_balance_error",
                          "solid_mass_error",
                          "energy",
                          "maxima",
                          "case",
                          "version"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["status"], "interrupted");
  EXPECT_EQ(json["simulated_time"], 1.5);
  EXPECT_EQ(json["water_balance_error"].get<double>(), 1.0 / 3e16);
  EXPECT_TRUE(json["flux_balance_error"].is_null());
  EXPECT_EQ(json["energy"]["kinetic"], 12.5);
  EXPECT_EQ(json["case"]["name"], "dike");
}

TEST(StateHash, DoesNotDependOnTheOrderOfThePoints) {
  const std::vector<std::uint64_t> ids{4, 1, 9}, sorted{1, 4, 9};
  const std::vector<double> x{40, 41, 10, 11, 90, 91}, x_sorted{10, 11, 40, 41, 90, 91};
  const HashedArray a{x, 2}, b{x_sorted, 2};
  EXPECT_EQ(state_hash(ids, {&a, 1}), state_hash(sorted, {&b, 1}));
}

TEST(StateHash, SeesTheLastBitOfAnyValueAndTheOwnerOfEveryValue) {
  const std::vector<std::uint64_t> ids{1, 2};
  std::vector<double> x{0.5, 0.25};
  const HashedArray array{x, 1};
  const std::uint64_t before = state_hash(ids, {&array, 1});
  x[1] = std::nextafter(x[1], 1);
  EXPECT_NE(state_hash(ids, {&array, 1}), before);
  x = {0.25, 0.5};
  EXPECT_NE(state_hash(ids, {&array, 1}), before);
}

TEST(StateHash, IsTheSameOnEveryMachineAndInEveryVersion) {
  const std::vector<std::uint64_t> ids{3, 1, 2};
  const std::vector<double> x{0.1, -2, 1e300};
  const HashedArray array{x, 1};
  // Computed independently from the definition of splitmix64.
  EXPECT_EQ(hash_text(state_hash(ids, {&array, 1})), "41ffb842c248136e");
}
