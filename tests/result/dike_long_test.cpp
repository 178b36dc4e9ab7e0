// Study P1 with the default soil rule: failure measured in bulk does not depend on the grid, and Darcy's law leads.
// The numbers compared and their tolerances are those of cases/dike-seepage/expected.toml.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <future>

#include "polder/case/reader.hpp"
#include "polder/result/monitors.hpp"

namespace polder {
namespace {

struct Course {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;  // time first
  double overfilled = 0, underfilled = 0, flux_error = 0, water_error = 0, solid_error = 0;

  std::size_t column(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    EXPECT_NE(found, names.end()) << name;
    return static_cast<std::size_t>(found - names.begin()) + 1;
  }
  double at(const std::string& name, double t) const {
    const std::size_t c = column(name);
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i][0] >= t) {
        const double share = (t - rows[i - 1][0]) / (rows[i][0] - rows[i - 1][0]);
        return rows[i - 1][c] + share * (rows[i][c] - rows[i - 1][c]);
      }
    return rows.back()[c];
  }
  double when(const std::string& name, double value) const {
    const std::size_t c = column(name);
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i - 1][c] < value && rows[i][c] >= value)
        return rows[i - 1][0] +
               (value - rows[i - 1][c]) / (rows[i][c] - rows[i - 1][c]) * (rows[i][0] - rows[i - 1][0]);
    return std::nan("");
  }
  double largest(const std::string& name) const {
    double most = 0;
    for (const auto& row : rows) most = std::max(most, row[column(name)]);
    return most;
  }
};

// The course of a run on one thread, to that time at most.
Course run(const std::string& name, int cells_per_metre, double end) {
  const ReadResult read = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/" + name + "/case.toml",
                                    {fmt::format("model.cell={:.15g}", 1.0 / cells_per_metre)});
  EXPECT_TRUE(read.ok());
  Simulation<PlaneStrain> simulation(read.model, 1);
  Course course;
  std::unique_ptr<Monitors<PlaneStrain>> monitors;
  double next = 0;
  while (!simulation.finished() && simulation.time() < end) {
    const double dt = simulation.advance().dt;
    if (simulation.time() < next || (simulation.stage() && simulation.stage()->initial)) continue;
    if (!monitors) {
      monitors = std::make_unique<Monitors<PlaneStrain>>(simulation);
      for (const auto& c : monitors->columns()) course.names.push_back(c.name);
    }
    next += 0.1;
    auto row = monitors->sample(simulation, dt);
    row.insert(row.begin(), simulation.time());
    course.rows.push_back(std::move(row));
    course.flux_error = std::max(course.flux_error, simulation.audit().flux_balance_error());
  }
  course.overfilled = simulation.audit().overfilled_most;
  course.underfilled = simulation.audit().underfilled_most;
  course.water_error = simulation.audit().water_balance_error(simulation.state());
  course.solid_error = simulation.audit().solid_mass_error(simulation.state());
  return course;
}

double expected(const std::string& key) {
  static const toml::table table =
      toml::parse_file(std::string(POLDER_SOURCE_DIR) + "/cases/dike-seepage/expected.toml");
  for (const auto& entry : *table["compare"].as_array())
    if (entry.as_table()->at("quantity").value<std::string>() == key)
      return *entry.as_table()->at("tolerance").value<double>();
  ADD_FAILURE() << key;
  return 0;
}

TEST(DikeSeepage, FailureDoesNotDependOnTheGridAndDarcyLeads) {
  constexpr double to_its_end = 1e9, after_failure = 14;  // s
  const auto beside = [](const char* name, int cells_per_metre, double end) {
    return std::async(std::launch::async, run, name, cells_per_metre, end);
  };
  auto coarse_run = beside("dike-seepage", 30, to_its_end),
       coarse_darcy_run = beside("dike-seepage-darcy", 30, after_failure);
  const Course fine = run("dike-seepage", 40, to_its_end), fine_darcy = run("dike-seepage-darcy", 40, after_failure);
  const Course coarse = coarse_run.get(), coarse_darcy = coarse_darcy_run.get();
  const auto differ = [](double a, double b) { return std::abs(a - b) / std::max(std::abs(a), std::abs(b)); };

  for (const Course* c : {&coarse, &fine, &coarse_darcy, &fine_darcy}) {
    EXPECT_LT(c->overfilled, 0.01);
    EXPECT_LT(c->underfilled, 0.01);
    EXPECT_LT(c->water_error, 1e-9);
    EXPECT_LT(c->solid_error, 1e-9);
    EXPECT_LT(c->largest("largest porosity above the toe"), 0.5);
  }
  for (const auto& [quantity, value] :
       {std::pair{"mean soil displacement", 0.1}, std::pair{"soil outside outline", 0.07}}) {
    const double a = coarse.when(quantity, value), b = fine.when(quantity, value);
    const double ad = coarse_darcy.when(quantity, value), bd = fine_darcy.when(quantity, value);
    std::printf("t(%s = %g): 1/30 %.2f s, 1/40 %.2f s; Darcy %.2f s, %.2f s\n", quantity, value, a, b, ad, bd);
    EXPECT_LT(differ(a, b), expected("difference between grids")) << quantity;
    for (const double lead : {1 - ad / a, 1 - bd / b}) {
      EXPECT_GT(lead, 0.25 - expected("lead of Darcy")) << quantity;
      EXPECT_LT(lead, 0.25 + expected("lead of Darcy")) << quantity;
    }
  }
  for (const char* quantity : {"water past the toe", "crest settlement"}) {
    const double a = coarse.at(quantity, 14), b = fine.at(quantity, 14);
    std::printf("%s at 14 s: 1/30 %.4f, 1/40 %.4f\n", quantity, a, b);
    EXPECT_LT(differ(a, b), expected("difference between grids")) << quantity;
  }
}

TEST(DikeConstantHead, KeepsItsLevelForAllOfTheFailure) {
  const ReadResult read = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/dike-constant-head/case.toml");
  ASSERT_TRUE(read.ok());
  Simulation<PlaneStrain> simulation(read.model, 1);
  double lowest = 1, highest = 0;
  while (!simulation.finished()) {
    simulation.advance();
    if (simulation.time() <= 0) continue;
    const auto& state = simulation.state();
    double stored = 0;
    for (const auto& cell : state.setup.reservoirs[0].cells)
      stored += state.grid.water_volume[state.setup.lattice.index(cell[0], cell[1])];
    lowest = std::min(lowest, stored / 2);
    highest = std::max(highest, stored / 2);
  }
  std::printf("mean level of the reservoir between %.4f and %.4f m\n", lowest, highest);
  EXPECT_NEAR(lowest, 0.8, 0.002);
  EXPECT_NEAR(highest, 0.8, 0.002);
  EXPECT_LT(simulation.audit().water_balance_error(simulation.state()), 1e-9);
  EXPECT_LT(simulation.audit().flux_balance_error(), 0.01);
}

}  // namespace
}  // namespace polder
