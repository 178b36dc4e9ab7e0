// polder stability CASE: factors of safety by every method, beside the references of the case.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "case_argument.hpp"
#include "commands.hpp"
#include "polder/report/stability_page.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/output_error.hpp"
#include "polder/stability/assessment_json.hpp"

namespace polder::cli {
namespace {

using namespace stability;

struct Options {
  std::string name, method = "all", json, report;
  std::vector<std::string> overrides;
  AssessmentDetails details;
  bool probability = false;
  int samples = 0;
};

std::vector<const StabilityMethod*> chosen_methods(const std::string& name) {
  std::vector<const StabilityMethod*> chosen;
  for (const StabilityMethod& method : stability_methods())
    if (name == "all" || name == method.name) chosen.push_back(&method);
  if (chosen.empty())
    throw Failure(status_wrong_input,
                  fmt::format("there is no method '{}'; known: {}, all", name, stability_method_names()));
  return chosen;
}

Study read(const Options& options) {
  ReadResult result = read_case(find_case_file(options.name), options.overrides);
  std::cerr << format(result.diagnostics);
  if (!result.ok()) throw Failure(status_wrong_input, "the case is wrong; nothing was written");
  return {std::move(result.model), std::move(result.stability), std::move(result.seepage)};
}

void print_slices(const Slices& slices) {
  fmt::print("    x_left   x_right    base     top   angle  weight   load   pore   stress  cohesion  tan_phi\n");
  fmt::print("        m         m       m       m     deg    kN/m   kN/m    kPa      kPa       kPa\n");
  for (const Slice& s : slices.list)
    fmt::print("{:10.3f}{:10.3f}{:8.3f}{:8.3f}{:8.2f}{:8.2f}{:7.2f}{:7.2f}{:9.2f}{:10.2f}{:9.4f}\n", s.left, s.right,
               s.base(), s.top(), s.angle * 57.29577951308232, s.weight / 1e3, s.load / 1e3, s.pore_pressure / 1e3,
               s.effective_stress / 1e3, s.cohesion / 1e3, s.tan_friction);
}

void print_head(std::size_t width) {
  fmt::print("{:<{}}{:>8}{:>11}{:>11}{:>6}{:>9}  {}\n", "method", width, "F", "reference", "tolerance", "", "seconds",
             "surface");
}

void print_row(const Factor& row, std::size_t width) {
  const std::string factor = row.outcome ? fmt::format("{:.3f}", row.factor) : "–";
  const std::string reference = row.expected ? fmt::format("{:.3f}", row.expected->reference) : "";
  const std::string tolerance = row.expected ? fmt::format("{:.1f} %", row.expected->tolerance * 100) : "";
  const char* verdict = !row.expected ? "" : row.pass() ? "ok" : "OUT";
  const std::string& problem = row.outcome.problem;
  fmt::print("{:<{}}{:>8}{:>11}{:>11}{:>6}{:>9.2f}  {}\n", row.label, width, factor, reference, tolerance, verdict,
             row.seconds, row.outcome ? row.outcome.remark : problem.substr(0, problem.find('\n')));
  std::fflush(stdout);
}

void print_checks(const std::vector<DikeCheck>& checks, std::size_t width) {
  if (!checks.empty())
    fmt::print("\n{:<{}}{:>8}{:>11}{:>11}{:>6}\n", "dike check", width, "factor", "reference", "tolerance", "");
  for (const DikeCheck& check : checks) {
    const std::string factor = !check.problem.empty()     ? "–"
                               : std::isinf(check.factor) ? "∞"
                                                          : fmt::format("{:.3f}", check.factor);
    const char* verdict = !check.expected ? "" : check.pass() ? "ok" : "OUT";
    fmt::print("{:<{}}{:>8}{:>11}{:>11}{:>6}  {}\n", check.label, width, factor,
               check.expected ? fmt::format("{:.3f}", check.expected->reference) : "",
               check.expected ? fmt::format("{:.1f} %", check.expected->tolerance * 100) : "", verdict, check.remark);
    if (!check.problem.empty()) std::cerr << "polder: " << check.label << ": " << check.problem << '\n';
  }
}

void print_details(const Assessment& all, const AssessmentDetails& details) {
  for (const Factor& row : all.factors) {
    const bool surface = row.outcome.search && *row.outcome.search;
    if (details.slices && surface) {
      fmt::print("\nSlices of {}:\n", row.label);
      print_slices(row.outcome.search->slices);
    }
    if (details.contours && surface && !row.outcome.search->contours.empty()) {
      fmt::print("\nLeast factor with each centre, {}:\n{:>10}{:>10}{:>10}\n", row.label, "x (m)", "y (m)", "F");
      for (const CentreFactor& c : row.outcome.search->contours)
        fmt::print("{:10.2f}{:10.2f}{:10.3f}\n", c.centre[0], c.centre[1], c.factor);
    }
    if (details.curve && row.outcome.reduction) {
      fmt::print("\nStrength reduction, {}:\n{:>8}{:>18}\n", row.label, "F", "displacement (m)");
      for (const auto& p : row.outcome.reduction->result.curve)
        fmt::print("{:8.3f}{:18.4g}{}\n", p.factor, p.displacement,
                   p.converged && !p.runs_away ? "" : "  no equilibrium");
    }
  }
  for (const Probability& p : all.probabilities) {
    const Reliability& r = p.reliability;
    fmt::print("\n{} with {}: reliability index {:.3f}, probability of failure {:.3g}{}{}\n", p.kind, p.method, r.index,
               r.probability, p.kind == "FORM" ? "" : fmt::format(" ± {:.2g}, {} samples", r.deviation, r.evaluations),
               r.converged ? "" : " (not converged)");
    for (std::size_t i = 0; i < r.influence.size(); ++i)
      fmt::print("  {:<32} influence {:.2f}, at failure {:+.2f} standard deviations\n", p.uncertain[i], r.influence[i],
                 r.design_point[i]);
  }
}

int run(const Options& options) {
  const Study study = read(options);
  AssessmentOptions asked{chosen_methods(options.method), options.details.contours || !options.report.empty(),
                          options.probability, options.samples, options.method == "all"};
  const auto expected = expected_factors(std::filesystem::path(study.model.file).parent_path() / "expected.toml");
  const bool quiet = options.json == "-";
  constexpr std::size_t width = 32;
  bool headed = false;
  Assessment all;
  try {
    all = assess(study, asked, expected, [&](const Factor& row) {
      if (!quiet && !headed) print_head(width), headed = true;
      if (!quiet) print_row(row, width);
      if (!row.outcome) std::cerr << "polder: " << row.label << ": " << row.outcome.problem << '\n';
    });
  } catch (const std::invalid_argument& error) {
    throw Failure(status_wrong_input, study.model.file + ": " + error.what());
  } catch (const std::runtime_error& error) {
    throw Failure(status_failed, study.model.file + ": " + error.what());
  }
  for (const std::string& note : all.notes) std::cerr << "note: " << note << '\n';
  if (!quiet) print_checks(all.checks, width), print_details(all, options.details);
  try {
    if (quiet)
      std::cout << assessment_json(all, options.details).dump(2) << '\n';
    else if (!options.json.empty())
      write_atomically(options.json, assessment_json(all, options.details).dump(2) + "\n");
    if (!options.report.empty()) {
      make_folder(options.report);
      const auto page = std::filesystem::path(options.report) / "stability.html";
      write_atomically(page, stability_page(all, POLDER_VERSION));
      std::cerr << "The page is " << page.string() << '\n';
    }
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  }
  bool good = true, found = false;
  for (const Factor& row : all.factors) good = good && (!row.expected || row.pass()), found = found || row.outcome;
  for (const DikeCheck& check : all.checks) {
    if (!check.problem.empty()) return status_wrong_input;
    good = good && check.pass();
  }
  return !found ? status_failed : good ? status_done : status_outside_tolerance;
}

}  // namespace

void add_stability(CLI::App& polder, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      add_command(polder, "stability", "Factor of safety of a section by limit equilibrium and finite elements",
                  "polder stability acads-1a\n"
                  "polder stability griffiths-lane-1 --method bishop --slices\n"
                  "polder stability acads-1c --method srm --curve --report acads-1c\n"
                  "polder stability acads-1c --json factors.json");
  command->add_option("CASE", options->name, "A case file, a folder with a case.toml, or a shipped case")->required();
  command->add_option("--method", options->method, stability_method_names() + ", or all")->type_name("NAME");
  command->add_option("--set", options->overrides, "Override one key, such as material.sand.friction_angle=\"36 deg\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--json", options->json, "Write the rows to this file as well (-: to the screen instead)")
      ->type_name("FILE");
  command->add_option("--report", options->report, "Write stability.html, with pictures, into this folder")
      ->type_name("DIR");
  command->add_flag("--slices", options->details.slices, "Print the slices of each surface; they go into the JSON too");
  command->add_flag("--contours", options->details.contours,
                    "Least factor with each centre of a grid of circles (Bishop)");
  command->add_flag("--curve", options->details.curve, "Displacement at every factor that strength reduction tried");
  command->add_flag("--probability", options->probability, "Reliability index by FORM, with the first of the methods");
  command
      ->add_option("--monte-carlo", options->samples,
                   "Probability of failure by so many samples, with the first method")
      ->type_name("SAMPLES")
      ->check(CLI::Range(1, 10000000));
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace polder::cli
