// Completion of commands, options and names of shipped cases in bash and zsh, from what the sub-commands told CLI11.
#include <iostream>
#include <string>
#include <vector>

#include "commands.hpp"
#include "polder/case/locate.hpp"

namespace polder::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& polder) {
  return polder.get_subcommands([](const CLI::App*) { return true; });
}

std::string case_names() {
  std::string names;
  for (const ShippedCase& shipped : shipped_cases()) names += (names.empty() ? "" : " ") + shipped.name;
  return names;
}

bool takes_case(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional() && option->get_name(true) == "CASE") return true;
  return false;
}

std::string flags_of(const CLI::App& app) {
  std::string flags;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) flags += (flags.empty() ? "--" : " --") + name;
  return flags;
}

void print_bash(const CLI::App& polder) {
  std::string names = flags_of(polder);
  for (const CLI::App* command : commands_of(polder)) names += " " + command->get_name();
  std::cout << "_polder() {\n"
               "  local word=${COMP_WORDS[COMP_CWORD]} options= cases=\n"
               "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
               "    mapfile -t COMPREPLY < <(compgen -W '"
            << names
            << "' -- \"$word\")\n"
               "    return\n"
               "  fi\n"
               "  case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : commands_of(polder)) {
    std::cout << "    " << command->get_name() << ") options='" << flags_of(*command) << "'";
    if (takes_case(*command)) std::cout << " cases='" << case_names() << "'";
    std::cout << " ;;\n";
  }
  std::cout << "  esac\n"
               "  if [[ $word == -* ]]; then\n"
               "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
               "  else\n"
               "    mapfile -t COMPREPLY < <(compgen -f -W \"$cases\" -- \"$word\")\n"
               "  fi\n"
               "}\n"
               "complete -o filenames -F _polder polder\n";
}

/// Text inside the brackets of a zsh specification, itself inside single quotes.
std::string zsh(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

void print_zsh_options(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) {
      std::cout << " \\\n      '*--" << name << "[" << zsh(option->get_description()) << "]";
      if (option->get_items_expected_max() > 0) std::cout << ":" << zsh(option->get_type_name()) << ":_files";
      std::cout << "'";
    }
  if (takes_case(command))
    std::cout << " \\\n      '*:case:_alternative \"cases:shipped case:(" << case_names()
              << ")\" \"files:case file:_files\"'";
  else
    std::cout << " \\\n      '*:file:_files'";
}

void print_zsh(const CLI::App& polder) {
  std::cout << "#compdef polder\n"
               "_polder() {\n"
               "  local -a commands=(\n";
  for (const CLI::App* command : commands_of(polder))
    std::cout << "    '" << command->get_name() << ":" << zsh(command->get_description()) << "'\n";
  std::cout << "  )\n"
               "  if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
               "  shift words; (( CURRENT-- ))\n"
               "  case $words[1] in\n";
  for (const CLI::App* command : commands_of(polder)) {
    std::cout << "    " << command->get_name() << ") _arguments";
    print_zsh_options(*command);
    std::cout << " ;;\n";
  }
  std::cout << "  esac\n"
               "}\n"
               "compdef _polder polder\n";
}

}  // namespace

void add_completion(CLI::App& polder, Action& action) {
  CLI::App* completion = add_command(polder, "completion", "Print what makes a shell complete polder's command line",
                                     "source <(polder completion bash)");
  CLI::Option* shell =
      completion->add_option("SHELL", "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  completion->callback([&polder, &action, shell] {
    action = [&polder, shell] {
      shell->as<std::string>() == "bash" ? print_bash(polder) : print_zsh(polder);
      return std::cout.flush() ? status_done : status_not_written;
    };
  });
}

}  // namespace polder::cli
