// Checkpoints with a right checksum whose data sets are not those that a run writes: each is refused, and nothing is
// allocated by what a data set says of its own length.
#include "polder/stage/checkpoint.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <filesystem>

#include "../result/temporary_folder.hpp"
#include "case_text.hpp"

namespace polder {
namespace {

Model drop() {
  return read_text(R"(
[model]
size = ["0.4 m", "0.4 m"]
cell = "0.1 m"
[[free_water]]
box = [["0 m", "0 m"], ["0.4 m", "0.2 m"]]
[[stage]]
name = "event"
duration = "1 s"
)");
}

constexpr std::size_t tail = 16;  // checksum and mark

std::string sealed(std::string bytes) {
  const std::uint64_t sum = checksum(bytes.data(), bytes.size());
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes + "polder-1";
}

/// The checkpoint after `change` has had its HDF5 file open.
template <class Change>
std::string changed(const std::string& checkpoint, Change&& change) {
  std::string image = checkpoint.substr(0, checkpoint.size() - tail);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, 0);
  H5Pset_file_image(access, image.data(), image.size());
  const hid_t file = H5Fopen("checkpoint", H5F_ACC_RDWR, access);
  EXPECT_GE(file, 0);
  change(file);
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  std::string bytes(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)), '\0');
  H5Fget_file_image(file, bytes.data(), bytes.size());
  H5Fclose(file);
  H5Pclose(access);
  return sealed(bytes);
}

/// Puts another data set of zeros in the place of `name`. `chunk`: it is stored in pieces of that length.
void replace(hid_t file, const char* name, hid_t type, hsize_t length, hsize_t chunk = 0) {
  ASSERT_GE(H5Ldelete(file, name, H5P_DEFAULT), 0) << name;
  const hid_t space = H5Screate_simple(1, &length, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  if (chunk > 0) H5Pset_chunk(creation, 1, &chunk);
  H5Pset_alloc_time(creation, H5D_ALLOC_TIME_LATE);
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  ASSERT_GE(set, 0) << name;
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
}

/// The message with which a checkpoint is refused; empty: it is not.
std::string refusal(const Model& model, const std::string& bytes) {
  Simulation<PlaneStrain> run(model, 1);
  try {
    restore_checkpoint(bytes, run, "case");
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return {};
}

class StoredCheckpoint : public ::testing::Test {
 public:
  void SetUp() override {
    model = drop();
    Simulation<PlaneStrain> run(model, 1);
    for (int step = 0; step < 3; ++step) run.advance();
    sound = checkpoint_bytes(run, OutputState{}, "case");
  }
  Model model;
  std::string sound;
};

#define EXPECT_REFUSED(part, name, ...)                                                                            \
  do {                                                                                                             \
    const std::string said = refusal(model, changed(sound, [](hid_t file) { replace(file, name, __VA_ARGS__); })); \
    EXPECT_NE(said.find(std::string("'") + name + "' " + part), std::string::npos) << name << ": " << said;        \
  } while (false)

TEST_F(StoredCheckpoint, IsUsedWhenItWasOnlyOpened) {
  EXPECT_EQ(refusal(model, changed(sound, [](hid_t) {})), "");
}

TEST_F(StoredCheckpoint, IsRefusedWhenADataSetSaysItIsLongerThanTheFile) {
  const hsize_t huge = hsize_t{1} << 44;  // 128 TB of doubles, none of which is there
  EXPECT_REFUSED("is not stored as a run stores it", "water/volume0", H5T_NATIVE_DOUBLE, huge);
  EXPECT_REFUSED("is not stored as a run stores it", "grid/pressure", H5T_NATIVE_DOUBLE, huge);
  EXPECT_REFUSED("is not stored as a run stores it", "case", H5T_NATIVE_UINT8, huge);
}

TEST_F(StoredCheckpoint, IsRefusedWhenADataSetIsStoredOtherwise) {
  EXPECT_REFUSED("is not stored as a run stores it", "water/volume0", H5T_NATIVE_DOUBLE, 64, 64);
  EXPECT_REFUSED("has another length", "step", H5T_NATIVE_UINT8, 1);
  EXPECT_REFUSED("has another length", "time", H5T_NATIVE_DOUBLE, 2);
  EXPECT_REFUSED("has another length", "grid/pressure", H5T_NATIVE_DOUBLE, 3);
}

// What the fuzzer found: a value beyond all reason, finite though, and the next step looked for the cell of a point
// that was nowhere.
TEST_F(StoredCheckpoint, WithValuesBeyondReasonEndsAtAGuard) {
  const auto ends = [&](auto&& spoil) {
    Simulation<PlaneStrain> run(model, 1);
    for (int step = 0; step < 3; ++step) run.advance();
    spoil(run.state());
    Simulation<PlaneStrain> again(model, 1);
    try {
      restore_checkpoint(checkpoint_bytes(run, OutputState{}, "case"), again, "case");
      for (int step = 0; step < 20; ++step) again.advance();
    } catch (const CheckpointError&) {
      return true;
    } catch (const RunFailure&) {
      return true;
    }
    return false;
  };
  for (const double value : {-3e231, 3e231, 1e300}) {
    EXPECT_TRUE(ends([&](auto& state) { state.water.velocity[1][5] = value; })) << value;
    EXPECT_TRUE(ends([&](auto& state) { state.water.affine[2][5] = value; })) << value;
    EXPECT_TRUE(ends([&](auto& state) { state.water.volume[5] = std::abs(value); })) << value;
    EXPECT_TRUE(ends([&](auto& state) { state.water.elongation[0][5] = value; })) << value;
  }
}

// HDF5 looks on the disk for a file of the name that one in memory is given.
TEST(Checkpoint, IsRestoredBesideAnythingThatIsCalledCheckpoint) {
  const auto here = std::filesystem::current_path();
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path / "checkpoint");
  std::filesystem::current_path(folder.path);
  const Model model = drop();
  Simulation<PlaneStrain> run(model, 1), again(model, 1);
  run.advance();
  EXPECT_NO_THROW(restore_checkpoint(checkpoint_bytes(run, OutputState{}, "case"), again, "case"));
  std::filesystem::current_path(here);
  EXPECT_EQ(again.time(), run.time());
}

}  // namespace
}  // namespace polder
