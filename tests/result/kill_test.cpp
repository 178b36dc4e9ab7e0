#include "killed_run.hpp"

namespace polder {

TEST(Kill, LosesNothing) { expect_nothing_lost(5, 20261125, 0.4); }

// The last checkpoint is of the initial stage, the results are of the event already.
TEST(Kill, AfterTheFirstSnapshotAndBeforeTheFirstCheckpointOfTheEventRepeatsNoSnapshot) {
  const TemporaryFolder folder;
  const Model model = restless_case(folder.path, 0.1);
  RunOptions options;
  options.threads = 1;
  options.quiet = true;
  options.folder = folder.path / "run";
  std::atomic<bool> at_once = true;
  options.interrupted = &at_once;
  ASSERT_EQ(run_case(model, options).status, RunStatus::interrupted);
  const std::string early = bytes_of(options.folder / "checkpoint.h5");

  options.interrupted = nullptr;
  options.force = true;
  const Summary whole = run_case(model, options);
  const std::string series = bytes_of(options.folder / "points.pvd");
  const std::string history = bytes_of(options.folder / "history.csv");

  std::ofstream(options.folder / "checkpoint.h5", std::ios::binary) << early;
  options.force = false;
  options.resume = true;
  EXPECT_EQ(run_case(model, options).state_hash, whole.state_hash);
  EXPECT_EQ(bytes_of(options.folder / "points.pvd"), series);
  EXPECT_EQ(bytes_of(options.folder / "history.csv"), history);
}

}  // namespace polder
