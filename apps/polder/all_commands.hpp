#pragma once
#include "commands.hpp"

namespace polder::cli {

/// Registers the sub-command of every command_*.cpp, in the order of the help page. Written by the build.
void add_all_commands(CLI::App& polder, Action& action);

}  // namespace polder::cli
