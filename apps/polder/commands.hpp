#pragma once
// The frame of the command line. Each sub-command NAME lives in its own command_NAME.cpp, which defines
//
//   void polder::cli::add_NAME(CLI::App& polder, Action& action);
//
// The build lists the files and writes the calls (apps/polder/CMakeLists.txt); nothing else has to be edited. The help
// page, the manual page and the shells' completion all come from what the sub-command tells CLI11.
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace polder::cli {

/// Exit statuses, the same for every sub-command.
enum Status : int {
  status_done = 0,
  status_outside_tolerance = 1,  ///< `verify` and `validate`: a comparison is outside its tolerance
  status_wrong_input = 2,        ///< the case or the command line is wrong; nothing was written
  status_failed = 3,             ///< the run failed numerically; the last good checkpoint is kept
  status_not_written = 4,        ///< output could not be written
  status_interrupted = 130,      ///< SIGINT or SIGTERM; a checkpoint was written
};

/// What the command line asks for, ready to start; returns the exit status.
using Action = std::function<int()>;

/// Ends a sub-command from anywhere below it: the message is printed after `polder: `, the status returned. The message
/// says what, where, and the remedy.
struct Failure : std::runtime_error {
  Failure(Status status_, const std::string& message) : std::runtime_error(message), status(status_) {}
  Status status;
};

/// A sub-command with its one-line description and the examples of its help page, one a line, each as the user types
/// it. Call the positional that takes a case file or the name of a shipped case `CASE`: shells complete it.
CLI::App* add_command(CLI::App& polder, const std::string& name, const std::string& description,
                      const std::string& examples);

/// The whole command line, all sub-commands registered. Parsing it sets `action`, which must outlive it.
std::unique_ptr<CLI::App> command_line(Action& action);

}  // namespace polder::cli
