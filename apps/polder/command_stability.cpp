// polder stability CASE: factors of safety by every method, beside the references of the case.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.hpp"
#include "polder/case/locate.hpp"
#include "polder/case/reader.hpp"
#include "polder/stability/check_section.hpp"
#include "polder/stability/expected.hpp"
#include "polder/stability/methods.hpp"
#include "polder/stability/reliability.hpp"
#include "polder/stability/section_from_model.hpp"

namespace polder::cli {
namespace {

using namespace stability;

struct Options {
  std::string name, method = "all", json;
  bool slices = false, probability = false;
};

struct Row {
  std::string method, remark, problem;
  double factor = 0, seconds = 0;
  std::optional<ExpectedFactor> expected;
  bool pass() const {
    return problem.empty() &&
           (!expected || std::abs(factor - expected->reference) <= expected->tolerance * expected->reference);
  }
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

Study read(const std::string& name) {
  const auto file = find_case(name);
  if (!file)
    throw Failure(status_wrong_input,
                  fmt::format("'{}' is neither a case file nor a shipped case; 'polder list' shows those", name));
  ReadResult result = read_case(file->string());
  if (!result.diagnostics.empty()) std::cerr << format(result.diagnostics);
  if (!result.ok()) throw Failure(status_wrong_input, file->string() + ": the case is wrong, see above");
  return {std::move(result.model), std::move(result.stability)};
}

PreparedSection prepare_or_refuse(Section section, const std::string& file) {
  try {
    return prepare(std::move(section));
  } catch (const std::invalid_argument& error) {
    throw Failure(status_wrong_input, file + ": " + error.what());
  }
}

Section section_or_refuse(const Study& study) {
  try {
    return section_from_model(study.model, study.input);
  } catch (const std::invalid_argument& error) {
    throw Failure(status_wrong_input, study.model.file + ": " + error.what());
  }
}

void print_slices(const Slices& slices) {
  fmt::print("    x_left   x_right    base     top   angle  weight   load   pore   stress  cohesion  tan_phi\n");
  fmt::print("        m         m       m       m     deg    kN/m   kN/m    kPa      kPa       kPa\n");
  for (const Slice& s : slices.list)
    fmt::print("{:10.3f}{:10.3f}{:8.3f}{:8.3f}{:8.2f}{:8.2f}{:7.2f}{:7.2f}{:9.2f}{:10.2f}{:9.4f}\n", s.left, s.right,
               s.base(), s.top(), s.angle * 57.29577951308232, s.weight / 1e3, s.load / 1e3, s.pore_pressure / 1e3,
               s.effective_stress / 1e3, s.cohesion / 1e3, s.tan_friction);
}

void print_table(const std::vector<Row>& rows) {
  fmt::print("{:<24}{:>8}{:>11}{:>11}{:>6}{:>9}  {}\n", "method", "F", "reference", "tolerance", "", "seconds",
             "surface");
  for (const Row& row : rows) {
    const std::string factor = row.problem.empty() ? fmt::format("{:.3f}", row.factor) : "–";
    const std::string reference = row.expected ? fmt::format("{:.3f}", row.expected->reference) : "";
    const std::string tolerance = row.expected ? fmt::format("{:.1f} %", row.expected->tolerance * 100) : "";
    const char* verdict = !row.expected ? "" : row.pass() ? "ok" : "OUT";
    fmt::print("{:<24}{:>8}{:>11}{:>11}{:>6}{:>9.2f}  {}\n", row.method, factor, reference, tolerance, verdict,
               row.seconds, row.problem.empty() ? row.remark : row.problem.substr(0, row.problem.find('\n')));
  }
}

void write_json(const std::string& file, const std::string& name, const std::vector<Row>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json entry{{"case", name}, {"method", row.method}};
    entry["factor_of_safety"] = row.problem.empty() ? nlohmann::ordered_json(row.factor) : nullptr;
    entry["reference"] = row.expected ? nlohmann::ordered_json(row.expected->reference) : nullptr;
    entry["tolerance"] = row.expected ? nlohmann::ordered_json(row.expected->tolerance) : nullptr;
    entry["pass"] = row.pass();
    entry["seconds"] = row.seconds;
    if (!row.problem.empty()) entry["problem"] = row.problem;
    list.push_back(entry);
  }
  if (file == "-") {
    std::cout << list.dump(2) << '\n';
    return;
  }
  std::ofstream out(file);
  out << list.dump(2) << '\n';
  if (!out.flush()) throw Failure(status_not_written, file + ": could not be written");
}

void print_probability(const Study& study, const PreparedSection& prepared, const StabilityMethod& method) {
  const std::vector<Uncertainty> uncertain = uncertainties(study.model, study.input);
  if (uncertain.empty())
    throw Failure(status_wrong_input,
                  study.model.file + ": nothing is uncertain; give strength.variation or stability.head_deviation");
  Section base = prepared.section;
  for (const PreparedSection& before : prepared.before) base.before.push_back(before.section);
  const FactorOf factor = [&](const Section& section) {
    const Outcome outcome = method.run(study, prepare(section));
    return outcome ? outcome.factor : std::nan("");
  };
  const Reliability result = form(base, uncertain, factor);
  fmt::print("\nFORM with {}: reliability index {:.3f}, probability of failure {:.3g}{}\n", method.name, result.index,
             result.probability, result.converged ? "" : " (not converged)");
  for (std::size_t i = 0; i < uncertain.size(); ++i)
    fmt::print("  {:<32} influence {:.2f}, at failure {:+.2f} standard deviations\n", uncertain[i].name,
               result.influence[i], result.design_point[i]);
}

bool has_design_values(const PartialFactors& f) {
  return f.cohesion != 1 || f.tan_friction != 1 || f.undrained != 1 || f.load != 1 || f.model != 1;
}

int run(const Options& options) {
  const std::vector<const StabilityMethod*> methods = chosen_methods(options.method);
  const Study study = read(options.name);
  const Model& model = study.model;
  const Section section = section_or_refuse(study);
  const PreparedSection prepared = prepare_or_refuse(section, model.file);
  for (const std::string& note : notes(prepared)) std::cerr << "note: " << note << '\n';
  const auto expected = expected_factors(std::filesystem::path(model.file).parent_path() / "expected.toml");

  std::vector<Row> rows;
  const auto compute = [&](const StabilityMethod& method, const PreparedSection& on, const std::string& label,
                           double over) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = method.run(study, on);
    Row row{label, outcome.remark, outcome.problem, outcome.factor / over, 0, {}};
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const ExpectedFactor& e : expected)
      if (e.method == label) row.expected = e;
    rows.push_back(row);
    if (!outcome.problem.empty()) std::cerr << "polder: " << label << ": " << outcome.problem << '\n';
    if (options.slices && outcome.search && *outcome.search) print_slices(outcome.search->slices);
  };
  for (const StabilityMethod* method : methods) {
    // Of several methods, those that the case does not expect are still shown.
    compute(*method, prepared, std::string(method->name), 1);
    const PartialFactors& factors = study.input.partial_factors;
    if (has_design_values(factors))
      compute(*method, prepare(design_section(section, factors)), std::string(method->name) + " (design)",
              factors.model);
  }
  if (options.json != "-") print_table(rows);
  if (options.probability) print_probability(study, prepared, *methods.front());
  if (!options.json.empty()) write_json(options.json, model.name, rows);
  bool good = true, found = false;
  for (const Row& row : rows) good = good && (!row.expected || row.pass()), found = found || row.problem.empty();
  return !found ? status_failed : good ? status_done : status_outside_tolerance;
}

}  // namespace

void add_stability(CLI::App& polder, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = add_command(polder, "stability", "Factor of safety of a section by limit equilibrium",
                                  "polder stability acads-1a\n"
                                  "polder stability griffiths-lane-1 --method bishop --slices\n"
                                  "polder stability acads-1c --json factors.json");
  command->add_option("CASE", options->name, "Case file or name of a shipped case")->required();
  command->add_option("--method", options->method, stability_method_names() + ", or all")->type_name("NAME");
  command->add_option("--json", options->json, "Write the rows to this file as well (-: to the screen instead)")
      ->type_name("FILE");
  command->add_flag("--slices", options->slices, "Print the slices of each surface");
  command->add_flag("--probability", options->probability, "Reliability index by FORM, with the first of the methods");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace polder::cli
