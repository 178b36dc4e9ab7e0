// polder: reads the command line, hands over to one sub-command, and turns what it threw into a message and a status.
#include <exception>
#include <filesystem>
#include <iostream>

#include "commands.hpp"
#include "polder/case/diagnostic.hpp"
#include "polder/math/huge_pages.hpp"
#include "polder/result/output_error.hpp"

namespace {

using namespace polder::cli;

int report(int status, const std::string& message) {
  std::cerr << "polder: " << message << '\n';
  return status;
}

std::string unknown_command(const CLI::App& polder, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : polder.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  const std::string meant = polder::nearest(word, names);
  return "unknown command '" + word + "'" + (meant.empty() ? "" : "; did you mean '" + meant + "'?");
}

/// CLI11 throws for --help and --version, too; those print to stdout and are no error.
int explain(const CLI::App& polder, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return polder.exit(error);
  std::string message = error.what(), help = "polder";
  for (const CLI::App* command : polder.get_subcommands()) help += " " + command->get_name();
  const std::vector<std::string> unknown = polder.remaining();
  if (polder.get_subcommands().empty() && !unknown.empty()) message = unknown_command(polder, unknown.front());
  return report(status_wrong_input, message + "\n'" + help + " --help' says what is expected");
}

int start(int argc, char** argv) {
  Action action;
  const auto polder = command_line(action);
  if (argc == 1) {
    std::cout << polder->help();
    return status_wrong_input;
  }
  try {
    polder->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return explain(*polder, error);
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  polder::keep_arrays_together();
  try {
    return start(argc, argv);
  } catch (const Failure& failure) {
    return report(failure.status, failure.what());
  } catch (const polder::OutputError& error) {
    return report(status_not_written, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return report(status_not_written, error.what());
  } catch (const std::exception& error) {
    return report(status_failed, error.what());
  }
}
