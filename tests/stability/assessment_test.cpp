#include "polder/stability/assessment_json.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "polder/case/reader.hpp"
#include "polder/stability/lines.hpp"
#include "polder/stability/piping.hpp"

namespace polder::stability {
namespace {

Study griffiths_lane_1(const std::vector<std::string>& overrides = {}) {
  ReadResult read = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/griffiths-lane-1/case.toml", overrides);
  EXPECT_TRUE(read.ok());
  return {read.model, read.stability, read.seepage};
}

AssessmentOptions only(const char* method) { return {{find_stability_method(method)}, false, false, 0}; }

TEST(Assessment, DesignFactorIsThePlainOneOverThePartialFactors) {
  // Strengths divided by 1.25 alike lower the factor of every surface 1.25-fold; the factor of the model divides it.
  const Assessment all = assess(griffiths_lane_1({"stability.partial_cohesion=1.25", "stability.partial_friction=1.25",
                                                  "stability.partial_model=1.1"}),
                                only("bishop"), {});
  ASSERT_EQ(all.factors.size(), 2u);
  EXPECT_EQ(all.factors[1].label, "bishop (design)");
  EXPECT_NEAR(all.factors[1].factor, all.factors[0].factor / 1.25 / 1.1, 1e-3 * all.factors[0].factor);
}

TEST(Assessment, CharacteristicStrengthsAreLowerByTheFractileOfTheLognormal) {
  Study study = griffiths_lane_1();
  MaterialStrength strength;
  strength.material = "soil";
  strength.strength.cohesion = 10e3;
  strength.strength.friction_angle = 20 * 3.14159265358979 / 180;
  strength.variation = 0.2;
  strength.unit_weight = strength.saturated_unit_weight = 20e3;
  study.input.strengths = {strength};
  study.input.circle = Circle{{15, 24}, 23.9};  // one surface, so that the samples are quick
  AssessmentOptions options = only("bishop");
  options.form = true;
  options.samples = 400;
  const Assessment all = assess(study, options, {});
  ASSERT_EQ(all.factors.size(), 2u);
  EXPECT_EQ(all.factors[1].label, "bishop (characteristic)");
  EXPECT_NEAR(all.factors[1].factor / all.factors[0].factor, characteristic_value(1, 0.2), 1e-3);
  // One lognormal factor on all strength: β = ln(F exp(−σ²/2))/σ, exactly.
  const double sigma = std::sqrt(std::log(1 + 0.04));
  const double index = (std::log(all.factors[0].factor) - sigma * sigma / 2) / sigma;
  ASSERT_EQ(all.probabilities.size(), 2u);
  EXPECT_NEAR(all.probabilities[0].reliability.index, index, 0.02);
  const Reliability& sampled = all.probabilities[1].reliability;
  EXPECT_NEAR(sampled.probability, normal_probability(-index), 3 * sampled.deviation);
}

TEST(Assessment, ContoursAreLeastAtTheCriticalCentre) {
  AssessmentOptions options = only("bishop");
  options.contours = true;
  const Assessment all = assess(griffiths_lane_1(), options, {});
  const SearchResult& found = *all.factors.front().outcome.search;
  ASSERT_GT(found.contours.size(), 100u);
  double least = 1e300;
  for (const CentreFactor& c : found.contours) least = std::min(least, c.factor);
  EXPECT_GE(least, found.equilibrium.factor - 2e-3);
  EXPECT_LE(least, 1.02 * found.equilibrium.factor);
}

std::string case_of(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << "base = \"" POLDER_SOURCE_DIR "/cases/griffiths-lane-1/case.toml\"\n" << text;
  return path;
}

TEST(Assessment, ALineLoadAddsItsMomentAboutTheCentre) {
  const std::string undrained =
      "[stability]\ncircle_centre = [[\"18 m\", \"22 m\"]]\ncircle_radius = \"21 m\"\n"
      "[[strength]]\nmaterial = \"soil\"\nmodel = \"undrained\"\nundrained_strength = \"60 kPa\"\nunit_weight = "
      "20000\n";
  const auto circle = [](const std::string& path) {
    const ReadResult read = read_case(path);
    EXPECT_TRUE(read.ok()) << format(read.diagnostics);
    const Study study{read.model, read.stability, read.seepage};
    const Assessment all = assess(study, only("bishop"), {});
    EXPECT_TRUE(all.factors.at(0).outcome) << all.factors.at(0).outcome.problem;
    return all.factors.at(0);
  };
  const Factor plain = circle(case_of("plain.toml", undrained));
  const Slices& slices = plain.outcome.search->slices;
  double resisting = 0;
  for (const Slice& s : slices.list) resisting += 60e3 * s.length * 21;
  // On the ground at x, h: 30 kN/m, 20 deg towards the foot. Without friction F = ΣM_r / ΣM_d.
  const Slice& loaded = slices.list.at(slices.list.size() / 4);
  const double x = loaded.middle(), h = loaded.top(), a = slices.direction * 20 * 3.14159265358979 / 180;
  const auto with = [&](double height) {
    return circle(case_of("line-load.toml", fmt::format("{}[[line_load]]\nname = \"rail\"\nat = [[{:.9f}, {:.9f}]]\n"
                                                        "force = \"30 kN/m\"\nangle = \"{} deg\"\n",
                                                        undrained, x, height, 20 * slices.direction)))
        .factor;
  };
  const double moment = 30e3 * (slices.direction * (18 - x) * std::cos(a) + slices.direction * std::sin(a) * (22 - h));
  EXPECT_NEAR(1 / with(h) - 1 / plain.factor, moment / resisting, 2e-3 * moment / resisting);
  EXPECT_NEAR(with(loaded.base() - 0.5), plain.factor, 1e-12);  // under the surface it does not slide with it
}

TEST(Assessment, ALineLoadBesideTheSectionIsRefused) {
  const auto refusal = [](const std::string& at) -> std::string {
    const ReadResult read = read_case(
        case_of("line-load-off.toml", "[[line_load]]\nname = \"rail\"\nat = " + at + "\nforce = \"5 kN/m\"\n"));
    if (!read.ok()) return format(read.diagnostics);
    try {
      study_sections({read.model, read.stability, read.seepage});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(refusal("[[\"-2 m\", \"1 m\"]]").find("outside the section"), std::string::npos);
  EXPECT_NE(refusal("[[\"2 m\", \"1 m\"], [\"3 m\", \"1 m\"]]").find("has 2 points"), std::string::npos);
}

TEST(Assessment, DikeChecksTakeWeightsAndHeadsFromTheSection) {
  // 3.6 m of clay, 73.44 kPa, over sand whose head gives 102 kPa at its base, 2.36 m lower.
  ReadResult read =
      read_case(std::string(POLDER_SOURCE_DIR) + "/cases/levee-stability-2/case.toml",
                {"stability.pressures=\"water-net\"", "dike_check.bare clay.d70=\"200 um\"",
                 "dike_check.bare clay.seepage_length=\"31 m\"", "dike_check.bare clay.outside_head=\"9 m\""});
  ASSERT_TRUE(read.ok()) << format(read.diagnostics);
  const Study study{read.model, read.stability, read.seepage};
  const auto checks = dike_checks(study, study_sections(study).front());
  ASSERT_EQ(checks.size(), 3u);
  const double pressure = 102e3 - 9810 * 2.36, head = 102e3 / 9810;
  EXPECT_NEAR(checks[0].factor, 3.6 * 20398.8 / pressure, 1e-4);
  EXPECT_NEAR(checks[1].factor, 0.3 / ((head - 5.96) / 3.6), 1e-4);
  PipingInput piping;
  piping.seepage_length = 31, piping.aquifer_thickness = 2.36, piping.conductivity = 7.44e-3, piping.d70 = 200e-6;
  EXPECT_NEAR(checks[2].factor, sellmeijer(piping).critical_head / (9 - 5.96 - 0.3 * 3.6), 1e-6);
}

TEST(Assessment, DikeChecksSayWhatTheyMiss) {
  ReadResult read = read_case(std::string(POLDER_SOURCE_DIR) + "/cases/levee-stability-2/case.toml",
                              {"stability.pressures=\"water-net\""});
  ASSERT_TRUE(read.ok());
  Study study{read.model, read.stability, read.seepage};
  const auto problem = [&] { return dike_checks(study, study_sections(study).front()).front().problem; };
  study.input.dike_checks.front().at = 60;
  EXPECT_NE(problem().find("x = 60 m lies outside the section (0 to 50 m)"), std::string::npos) << problem();
  study.input.dike_checks.front().at = 35;
  study.input.dike_checks.front().aquifer = "clay";
  EXPECT_NE(problem().find("nothing lies on 'clay'"), std::string::npos) << problem();
}

TEST(Assessment, JsonHasTheContractsKeys) {
  const auto json = assessment_json(assess(griffiths_lane_1(), only("bishop"), {{"bishop", 1.378, 0.02, ""}}));
  ASSERT_EQ(json.size(), 1u);
  for (const char* key : {"case", "method", "factor_of_safety", "reference", "tolerance", "pass", "seconds"})
    EXPECT_TRUE(json[0].contains(key)) << key;
  EXPECT_TRUE(json[0]["pass"].get<bool>());
  EXPECT_FALSE(json[0].contains("slices"));
}

TEST(Assessment, SaysThatNothingIsUncertain) {
  AssessmentOptions options = only("bishop");
  options.form = true;
  EXPECT_THROW(assess(griffiths_lane_1(), options, {}), std::invalid_argument);
}

TEST(Simplified, StaysWithinItsTolerance) {
  Line line;
  for (int i = 0; i <= 200; ++i) line.push_back({0.05 * i, std::sin(0.05 * i)});
  const Line few = simplified(line, 1e-2);
  EXPECT_LT(few.size(), 50u);
  for (const Point& p : line) EXPECT_NEAR(level(few, p[0]), p[1], 1.5e-2);
}

}  // namespace
}  // namespace polder::stability
