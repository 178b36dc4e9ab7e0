// The examples of the guide (cases/examples) run to their ends with their balances kept and nothing to warn of.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "polder/case/reader.hpp"
#include "polder/stage/simulation.hpp"

namespace polder {
namespace {

namespace fs = std::filesystem;

template <class Space>
void run_to_its_end(const Model& model) {
  Simulation<Space> run(model, 1);
  while (!run.finished()) run.advance();
  EXPECT_NEAR(run.time(), run.end_time(), 1e-9 * run.end_time());
  EXPECT_LT(run.audit().water_balance_error(run.state()), 1e-12);
  EXPECT_LT(run.audit().solid_mass_error(run.state()), 1e-12);
  for (const std::string& warning : run.guards().warnings()) ADD_FAILURE() << warning;
}

class GuideExample : public testing::TestWithParam<fs::path> {};

TEST_P(GuideExample, RunsToItsEnd) {
  const ReadResult result = read_case((GetParam() / "case.toml").string());
  ASSERT_TRUE(result.diagnostics.empty()) << format(result.diagnostics);
  if (result.model.space == SpaceKind::solid)
    run_to_its_end<Solid>(result.model);
  else
    run_to_its_end<PlaneStrain>(result.model);
}

std::vector<fs::path> examples() {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(fs::path(POLDER_SOURCE_DIR) / "cases/examples"))
    if (entry.is_directory()) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders;
}

INSTANTIATE_TEST_SUITE_P(All, GuideExample, testing::ValuesIn(examples()), [](const auto& example) {
  std::string name = example.param.filename().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace polder
