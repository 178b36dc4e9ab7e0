// polder verify [NAME...]: analytical problems, each a case, each compared with its exact answer.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "polder/case/diagnostic.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/verify/pages.hpp"
#include "polder/verify/suite.hpp"

namespace polder::cli {
namespace {

using verify::Outcome;
using verify::Problem;
using verify::Row;

struct Options {
  std::vector<std::string> names, overrides;
  std::string json;
  std::filesystem::path report;
  bool quick = false, list = false, docs = false;
};

std::vector<const Problem*> chosen(const Options& options) {
  std::vector<const Problem*> list;
  for (const std::string& name : options.names) {
    const Problem* problem = verify::find_problem(name);
    if (!problem) {
      std::vector<std::string> known;
      for (const Problem& p : verify::problems()) known.emplace_back(p.name);
      const std::string near = nearest(name, known);
      throw Failure(status_wrong_input,
                    fmt::format("there is no problem '{}'{}; 'polder verify --list' names all", name,
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
    list.push_back(problem);
  }
  if (options.names.empty())
    for (const Problem& problem : verify::problems())
      if (problem.quick || !options.quick) list.push_back(&problem);
  return list;
}

void print_list() {
  for (const Problem& problem : verify::problems())
    fmt::print("{:<28}{:<7}{}\n", problem.name, problem.quick ? "quick" : "", problem.title);
}

void print_header() {
  fmt::print("{:<26} {:<20} {:<34} {:>12} {:>12} {:>10} {:>10} {:>5} {:>7}\n", "problem", "quantity", "place",
             "reference", "computed", "error", "tolerance", "", "seconds");
}

void print_rows(const Outcome& outcome) {
  const auto number = [](const std::optional<double>& value, int digits) {
    return value ? fmt::format("{:.{}g}", *value, digits) : std::string();
  };
  for (const Row& row : outcome.rows)
    fmt::print("{:<26} {:<20} {:<34} {:>12} {:>12.5g} {:>10} {:>10} {:>5} {:>7.2f}\n", row.problem, row.quantity,
               row.at, number(row.reference, 5), row.computed, number(row.error, 2), number(row.tolerance, 2),
               !row.pass       ? "OUT"
               : row.tolerance ? "ok"
                               : "",
               row.seconds);
  if (!outcome.trouble.empty()) fmt::print("  {}\n", outcome.trouble);
  std::cout.flush();
  std::fflush(stdout);
}

nlohmann::ordered_json json_of(const std::vector<Outcome>& outcomes) {
  auto list = nlohmann::ordered_json::array();
  const auto number = [](const std::optional<double>& value) {
    return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  for (const Outcome& outcome : outcomes)
    for (const Row& row : outcome.rows)
      list.push_back({{"problem", row.problem},
                      {"quantity", row.quantity},
                      {"at", row.at},
                      {"reference", number(row.reference)},
                      {"computed", number(row.computed)},
                      {"error", number(row.error)},
                      {"tolerance", number(row.tolerance)},
                      {"pass", row.pass},
                      {"seconds", row.seconds}});
  return list;
}

int verify_all(const Options& options) {
  if (options.list) {
    print_list();
    return status_done;
  }
  const std::vector<const Problem*> problems = chosen(options);
  const bool table = options.json != "-" && !options.docs;
  if (table) print_header();
  std::vector<Outcome> outcomes;
  int short_of = 0;
  double seconds = 0;
  for (const Problem* problem : problems) {
    outcomes.push_back(verify::run_problem(*problem, {options.overrides, !options.quick}));
    if (table) print_rows(outcomes.back());
    short_of += !outcomes.back().pass();
    if (!outcomes.back().rows.empty()) seconds += outcomes.back().rows.front().seconds;
  }
  if (table)
    fmt::print("{} of {} problems within their tolerances, {:.1f} s\n", problems.size() - short_of, problems.size(),
               seconds);
  if (options.json == "-")
    std::cout << json_of(outcomes).dump(2) << '\n';
  else if (!options.json.empty())
    write_atomically(options.json, json_of(outcomes).dump(2) + "\n");
  if (options.docs) std::cout << verify::verification_page(problems, outcomes);
  if (!options.report.empty()) {
    make_folder(options.report);
    write_atomically(options.report / "index.html", verify::report_page(problems, outcomes));
    if (table) fmt::print("{}\n", (options.report / "index.html").string());
  }
  if (!std::cout.flush()) return status_not_written;
  return short_of > 0 ? status_outside_tolerance : status_done;
}

}  // namespace

void add_verify(CLI::App& polder, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = add_command(polder, "verify", "Analytical verification: every claim recomputed on this machine",
                                  "polder verify --quick\n"
                                  "polder verify hydrostatic dupuit --report verification\n"
                                  "polder verify hydrostatic --set model.gravity=10.3   (must fall short)");
  command->add_option("NAME", options->names, "Problems to run; left out: all");
  command->add_flag("--quick", options->quick, "Only those that take seconds, without orders of convergence");
  command->add_option("--json", options->json, "Write the rows to this file as well (-: to the screen instead)")
      ->type_name("FILE");
  command->add_option("--report", options->report, "Folder for a page with one figure per problem")->type_name("DIR");
  command
      ->add_option("--set", options->overrides,
                   "key=value of the case, for the run but not for the exact answer: to see an error being caught")
      ->take_all();
  command->add_flag("--list", options->list, "Name the problems");
  command->add_flag("--docs", options->docs, "Print docs/verification.md instead of the table");
  command->callback([options, &action] { action = [options] { return verify_all(*options); }; });
}

}  // namespace polder::cli
