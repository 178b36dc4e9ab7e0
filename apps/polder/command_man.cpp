// The manual page, from what the sub-commands told CLI11: one source for --help and man.
#include <iostream>

#include "commands.hpp"

namespace polder::cli {
namespace {

/// Text that roff prints as it stands.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool line_start = out.empty() || out.back() == '\n';
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

void print_option(const CLI::Option& option) {
  std::cout << ".TP\n.B " << roff(option.get_name(option.get_positional(), true));
  if (option.get_items_expected_max() > 0 && !option.get_positional()) std::cout << ' ' << roff(option.get_type_name());
  std::cout << '\n' << roff(option.get_description()) << '\n';
}

void print_footer(const CLI::App& app) {
  std::string text = app.get_footer();
  while (!text.empty() && text.front() == '\n') text.erase(0, 1);
  if (!text.empty()) std::cout << ".PP\n.nf\n" << roff(text) << ".fi\n";
}

void print_command(const CLI::App& command) {
  std::cout << ".SS " << roff(command.get_name()) << '\n' << roff(command.get_description()) << '\n';
  for (const CLI::Option* option : command.get_options())
    if (!option->check_name("--help")) print_option(*option);
  print_footer(command);
}

int print_page(const CLI::App& polder) {
  std::cout << ".TH POLDER 1 \"\" \"Polder " POLDER_VERSION "\"\n"
            << ".SH NAME\npolder \\- simulate what water does to soil\n"
            << ".SH SYNOPSIS\n.B polder\n.I COMMAND\n[options]\n"
            << ".SH DESCRIPTION\n"
            << roff(polder.get_description()) << ".SH OPTIONS\n";
  for (const CLI::Option* option : polder.get_options()) print_option(*option);
  std::cout << ".SH COMMANDS\n";
  for (const CLI::App* command : polder.get_subcommands([](const CLI::App*) { return true; })) print_command(*command);
  std::cout << ".SH NOTES\n";
  print_footer(polder);
  return std::cout.flush() ? status_done : status_not_written;
}

}  // namespace

void add_man(CLI::App& polder, Action& action) {
  CLI::App* man = add_command(polder, "man", "Print the manual page", "polder man | man -l -");
  man->callback([&polder, &action] { action = [&polder] { return print_page(polder); }; });
}

}  // namespace polder::cli
