// polder validate [NAME...]: shipped cases against experiments and against what the studies state.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "commands.hpp"
#include "polder/case/diagnostic.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/output_error.hpp"
#include "polder/result/summary.hpp"
#include "polder/verify/validation_pages.hpp"

namespace polder::cli {
namespace {

namespace fs = std::filesystem;
using validate::Result;
using validate::Validation;

struct Options {
  std::vector<std::string> names, overrides;
  fs::path folder = "results/validation";
  int threads = 1;
  bool list = false, docs = false, reuse = false;
};

std::vector<const Validation*> chosen(const Options& options) {
  std::vector<const Validation*> list;
  for (const std::string& name : options.names) {
    const Validation* validation = validate::find_validation(name);
    if (!validation) {
      std::vector<std::string> known;
      for (const Validation& v : validate::validations()) known.emplace_back(v.name);
      const std::string near = nearest(name, known);
      throw Failure(status_wrong_input,
                    fmt::format("there is no validation '{}'{}; 'polder validate --list' names all", name,
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
    list.push_back(validation);
  }
  if (options.names.empty())
    for (const Validation& validation : validate::validations()) list.push_back(&validation);
  return list;
}

void print_result(const Validation& validation, const Result& result) {
  for (const validate::Row& row : result.rows)
    fmt::print("{:<29} {:<46} {:<40} {:>12} {:>12} {:>10} {}\n", validation.name, row.quantity, row.at,
               validate::value_text(row.computed, row.unit),
               row.words.empty() ? validate::value_text(row.reference, row.unit) : row.words,
               row.tolerance ? validate::value_text(row.tolerance, row.unit) : "", validate::verdict_text(row));
  fmt::print("{:<29} {:.0f} points, {:.0f} steps, {:.0f} s{}\n", validation.name, result.points, result.steps,
             result.seconds, result.trouble.empty() ? "" : ": " + result.trouble);
  std::fflush(stdout);
}

/// What earlier calls left in the folder.
std::map<std::string, Result> kept(const fs::path& folder) {
  std::map<std::string, Result> results;
  for (const Validation& validation : validate::validations())
    if (const fs::path file = folder / (std::string(validation.name) + ".json"); fs::exists(file))
      results[std::string(validation.name)] = validate::result_of(read_json(file));
  return results;
}

int validate_all(const Options& options) {
  if (options.list) {
    for (const Validation& validation : validate::validations())
      fmt::print("{:<30}{}\n", validation.name, validation.against);
    return status_done;
  }
  try {
    std::map<std::string, Result> results = kept(options.folder);
    if (options.docs) {
      std::cout << validate::validation_page(results);
      return std::cout.flush() ? status_done : status_not_written;
    }
    make_folder(options.folder);
    int short_of = 0;
    const auto list = chosen(options);
    for (const Validation* validation : list) {
      const std::string name(validation->name);
      if (!options.reuse || !results.contains(name)) {
        results[name] = validate::run_validation(*validation, options.overrides, options.threads);
        if (options.overrides.empty())
          write_atomically(options.folder / (name + ".json"), validate::json_of(results[name]).dump(2) + "\n");
      }
      print_result(*validation, results[name]);
      short_of += !results[name].pass();
    }
    write_atomically(options.folder / "report.html", validate::validation_report(results));
    fmt::print("{} of {} cases within their tolerances; {}\n", list.size() - static_cast<std::size_t>(short_of),
               list.size(), (options.folder / "report.html").string());
    return short_of > 0 ? status_outside_tolerance : status_done;
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  }
}

}  // namespace

void add_validate(CLI::App& polder, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = add_command(polder, "validate", "Shipped cases against experiments and published numbers",
                                  "polder validate porous-block water-column\n"
                                  "polder validate --reuse                     (only what has no result yet)\n"
                                  "polder validate --docs > docs/validation.md (from the results there are)");
  command->add_option("NAME", options->names, "Cases to run; left out: all");
  command->add_option("--out", options->folder, "Folder of the results")->type_name("DIR");
  command->add_option("--threads", options->threads, "Threads of each run")->check(CLI::Range(1, 1024));
  command->add_option("--set", options->overrides, "Override a key of the cases; such results are not kept")
      ->allow_extra_args(false);
  command->add_flag("--reuse", options->reuse, "Take results that are in the folder instead of computing them again");
  command->add_flag("--list", options->list, "Name the validations");
  command->add_flag("--docs", options->docs, "Print docs/validation.md from the results in the folder");
  command->callback([options, &action] { action = [options] { return validate_all(*options); }; });
}

}  // namespace polder::cli
