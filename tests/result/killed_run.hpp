#pragma once
// A run that is killed at random moments and resumed, until it ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>
#include <random>

#include "polder/case/reader.hpp"
#include "polder/result/history.hpp"
#include "polder/result/run.hpp"
#include "polder/result/run_folder.hpp"
#include "polder/result/vtk_reader.hpp"
#include "polder/stage/checkpoint.hpp"
#include "temporary_folder.hpp"

namespace polder {

/// A bed under a dam break that writes all the time: a snapshot every few steps, a checkpoint every hundredth of a s.
inline Model restless_case(const std::filesystem::path& folder, double end) {
  const auto file = folder / "case.toml";
  std::ofstream(file) << R"(
[model]
title = "Water that breaks onto a bed"
size = ["1 m", "0.8 m"]
cell = "0.1 m"
[[material]]
name = "sand"
law = "mohr-coulomb"
grain_density = "2650 kg/m3"
porosity = 0.4
grain_diameter = "2 mm"
young_modulus = "1 MPa"
poisson_ratio = 0.3
friction_angle = "35 deg"
[[soil]]
material = "sand"
box = [["0.4 m", "0 m"], ["1 m", "0.2 m"]]
[[free_water]]
box = [["0 m", "0 m"], ["0.4 m", "0.6 m"]]
[initial]
water_table = [["0 m", "0.2 m"], ["1 m", "0.2 m"]]
[[stage]]
name = "rest"
initial = true
duration = "0.05 s"
[[stage]]
name = "event"
duration = ")" << end << R"( s"
[output]
history = "0.004 s"
snapshots = "0.02 s"
pictures = ["0.1 s"]
checkpoint = "0.01 s"
)";
  const ReadResult read = read_case(file);
  EXPECT_TRUE(read.ok()) << format(read.diagnostics);
  return read.model;
}

/// Every file of a run's folder that a reader may open is whole. Returns how many there are.
inline int expect_readable(const std::filesystem::path& folder, const Model& model) {
  namespace fs = std::filesystem;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.filename().string().starts_with('.') || !entry.is_regular_file()) continue;
    const std::string kind = path.extension();
    ++files;
    if (kind == ".vtp") {
      EXPECT_NO_THROW(read_vtp(path)) << path;
    }
    if (kind == ".json") {
      EXPECT_NO_THROW(read_json(path)) << path;
    }
    // killed between its creation and its heading, a history has nothing in it: there is no row to lose
    if (kind == ".csv" && fs::file_size(path) > 0) {
      EXPECT_NO_THROW(read_history(path)) << path;
    }
    if (kind == ".png") {
      EXPECT_EQ(bytes_of(path).substr(1, 3), "PNG") << path;
    }
    if (kind == ".pvd" || kind == ".svg") {
      EXPECT_NE(bytes_of(path).find("</"), std::string::npos) << path;
    }
    if (kind != ".h5") continue;
    Simulation<PlaneStrain> run(model, 1);
    const std::string bytes = bytes_of(path);
    try {
      restore_checkpoint(bytes, run, case_identity(model));
    } catch (const CheckpointError& error) {
      ADD_FAILURE() << path << ": " << error.what();
    }
  }
  return files;
}

/// Kills the run `kills` times at moments that `seed` gives; the state at the end must be that of one that was left
/// alone.
inline void expect_nothing_lost(int kills, unsigned seed, double end) {
  std::cout << "seed " << seed << std::endl;
  const TemporaryFolder folder;
  const Model model = restless_case(folder.path, end);
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  options.folder = folder.path / "whole";
  const Summary whole = run_case(model, options);
  ASSERT_EQ(whole.status, RunStatus::finished) << whole.reason;

  options.folder = folder.path / "parts";
  std::mt19937 random(seed);
  int killed = 0, files = 0;
  while (killed < kills) {
    const auto& parts = options.folder;
    options.resume = std::filesystem::exists(parts / "checkpoint.h5");
    options.force = !options.resume;
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        run_case(model, options);
      } catch (const std::exception& error) {
        std::cerr << error.what() << std::endl;
        ::_exit(1);
      }
      ::_exit(0);
    }
    // about as much time as it takes to get on by a snapshot or two, so that most kills meet a file being written
    ::usleep(static_cast<useconds_t>(20000 + random() % 120000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status)) {
      ASSERT_EQ(WEXITSTATUS(status), 0);
      std::filesystem::remove_all(parts);  // it was done before it was killed: from the start again
      continue;
    }
    ++killed;
    if (std::filesystem::exists(parts)) files += expect_readable(parts, model);
    if (testing::Test::HasFailure()) return;
  }
  options.resume = std::filesystem::exists(options.folder / "checkpoint.h5");
  options.force = !options.resume;
  const Summary parts = run_case(model, options);
  EXPECT_EQ(parts.status, RunStatus::finished) << parts.reason;
  EXPECT_EQ(parts.state_hash, whole.state_hash);
  EXPECT_EQ(bytes_of(folder.path / "parts/history.csv"), bytes_of(folder.path / "whole/history.csv"));
  EXPECT_EQ(bytes_of(folder.path / "parts/points.pvd"), bytes_of(folder.path / "whole/points.pvd"));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path / "whole/points"))
    EXPECT_EQ(bytes_of(folder.path / "parts/points" / entry.path().filename()), bytes_of(entry.path()));
  std::cout << "record: kill kill-9-at-random-moments " << kills << " 0 " << files << " files read" << std::endl;
  testing::Test::RecordProperty("kills", kills);
  testing::Test::RecordProperty("files_read", files);
}

}  // namespace polder
