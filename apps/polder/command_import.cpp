// polder import FILE.stix: a D-Stability model as a case file.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "commands.hpp"
#include "polder/stability/stix.hpp"
#include "polder/stability/stix_case.hpp"

namespace polder::cli {
namespace {

using namespace stability;

struct Options {
  std::string file, out, calculation;
};

const StixCalculation& chosen(const StixModel& model, const Options& options) {
  for (const StixCalculation& calculation : model.calculations)
    if (options.calculation.empty() || calculation.label == options.calculation) return calculation;
  std::string labels;
  for (const StixCalculation& calculation : model.calculations)
    labels += fmt::format("{}\"{}\"", labels.empty() ? "" : ", ", calculation.label);
  throw Failure(status_wrong_input, fmt::format("{}: there is no calculation \"{}\"; it has {}", options.file,
                                                options.calculation, labels.empty() ? "none" : labels));
}

int run(const Options& options) {
  StixModel model;
  std::string text;
  try {
    model = read_stix(options.file);
    text = case_text(chosen(model, options), std::filesystem::path(options.file).filename().string(), model.notes);
  } catch (const std::invalid_argument& error) {
    throw Failure(status_wrong_input, error.what());
  }
  for (const StixCalculation& calculation : model.calculations)
    fmt::print(stderr, "{:<32} {:<24} stage \"{}\"{}\n", calculation.label, calculation.analysis, calculation.stage,
               calculation.stored_factor ? fmt::format(", factor {:.4f}", *calculation.stored_factor) : "");
  for (const std::string& note : model.notes) std::cerr << "note: " << note << '\n';
  if (options.out.empty()) {
    std::cout << text;
    return status_done;
  }
  std::ofstream out(options.out);
  out << text;
  if (!out.flush()) throw Failure(status_not_written, options.out + ": could not be written");
  return status_done;
}

}  // namespace

void add_import(CLI::App& polder, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = add_command(polder, "import", "Turn a D-Stability model into a case",
                                  "polder import dike.stix --out dike.toml\n"
                                  "polder import dike.stix --calculation 'High water' --out dike.toml");
  command->add_option("FILE", options->file, "D-Stability model (.stix)")->required()->check(CLI::ExistingFile);
  command->add_option("--out", options->out, "Write the case here instead of to the screen")->type_name("FILE");
  command->add_option("--calculation", options->calculation, "Which one, by its label; else the first")
      ->type_name("LABEL");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace polder::cli
