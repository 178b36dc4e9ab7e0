#include "commands.hpp"

#include <sstream>

#include "all_commands.hpp"

namespace polder::cli {

CLI::App* add_command(CLI::App& polder, const std::string& name, const std::string& description,
                      const std::string& examples) {
  CLI::App* command = polder.add_subcommand(name, description);
  std::string footer = "Examples:\n";
  std::istringstream lines(examples);
  for (std::string line; std::getline(lines, line);) footer += "  " + line + "\n";
  command->footer(footer)->group("Commands");
  return command;
}

std::unique_ptr<CLI::App> command_line(Action& action) {
  auto polder = std::make_unique<CLI::App>(
      "Polder simulates what water does to soil, from the first seepage to the final run-out.\n", "polder");
  polder->option_defaults()->always_capture_default();
  polder->get_formatter()->column_width(30);
  polder->get_formatter()->label("SUBCOMMAND", "COMMAND");
  polder->set_version_flag("--version", "polder " POLDER_VERSION, "Print the version and exit");
  polder->set_help_flag("-h,--help", "Print this help and exit");
  polder->require_subcommand(1);
  polder->footer(
      "polder COMMAND --help says what a command takes.\n"
      "\n"
      "Examples:\n"
      "  polder list                       which cases come with Polder\n"
      "  polder new my-dike.toml           a commented case file to start from\n"
      "  polder check my-dike.toml         is it right, how does it look, what will it cost\n"
      "  polder run my-dike.toml           compute it; prints where the results are\n"
      "\n"
      "CASE is a case file, a folder with a case.toml, or the name of a shipped case.\n"
      "Exit status: 0 done; 1 a comparison is outside its tolerance; 2 the case or the command line is wrong;\n"
      "3 the run failed numerically; 4 output could not be written; 130 interrupted (a checkpoint was written).\n");
  add_all_commands(*polder, action);
  return polder;
}

}  // namespace polder::cli
