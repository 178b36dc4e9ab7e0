// The state of some shipped cases after some steps, bit for bit, as it was when tests/result/state_hashes.toml was
// written. A change that is meant is renewed with POLDER_RENEW_HASHES=1 build/release/test_result
// --gtest_filter='Pinned*' and explained in CHANGELOG.md.
#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <cstdlib>
#include <fstream>
#include <map>

#include "polder/case/reader.hpp"
#include "polder/result/frame_of.hpp"
#include "polder/result/state_hash.hpp"

namespace polder {
namespace {

#if defined(POLDER_RELEASE_BY_GCC) && defined(__AVX2__) && !defined(__AVX512F__)
constexpr bool recorded_build = true;
#else
constexpr bool recorded_build = false;
#endif

template <class Space>
std::string hash_after(const Model& model, int steps, int threads) {
  Simulation<Space> run(model, threads);
  for (int step = 0; step < steps && !run.finished(); ++step) run.advance();
  return hash_text(hash_of(run));
}

std::string hash_of_case(const std::string& name, int steps, int threads) {
  const ReadResult read = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/" + name + "/case.toml");
  EXPECT_TRUE(read.ok()) << name;
  return read.model.space == SpaceKind::plane_strain ? hash_after<PlaneStrain>(read.model, steps, threads)
                                                     : hash_after<Solid>(read.model, steps, threads);
}

TEST(PinnedState, IsThatOfTheRecordedBuild) {
  if (!recorded_build) GTEST_SKIP() << "recorded with g++, optimised, for x86-64-v3";
  const std::string path = std::string(POLDER_SOURCE_DIR) + "/tests/result/state_hashes.toml";
  const std::map<std::string, int> cases = {
      {"dike-seepage", 300},       {"dike-paper-darcy", 300}, {"granular-column", 200}, {"hydrostatic-3d", 100},
      {"levee-uplift-paper", 100}, {"pipe-leak", 100},        {"porous-block", 200},    {"excavation-onset", 100}};
  std::map<std::string, std::string> now;
  for (const auto& [name, steps] : cases) {
    now[name] = hash_of_case(name, steps, 1);
    EXPECT_EQ(hash_of_case(name, steps, 2), now[name]) << name << ": two threads";
  }
  if (std::getenv("POLDER_RENEW_HASHES")) {
    std::ofstream file(path);
    file << "# state_hash after the steps that pinned_test.cpp lists; g++ 12, x86-64-v3\n";
    for (const auto& [name, hash] : now) file << name << " = \"" << hash << "\"\n";
  }
  const toml::table recorded = toml::parse_file(path);
  for (const auto& [name, hash] : now)
    EXPECT_EQ(recorded[name].value_or(std::string("none")), hash)
        << name << ": if this is meant, renew (see the head of pinned_test.cpp) and say why in CHANGELOG.md";
}

}  // namespace
}  // namespace polder
