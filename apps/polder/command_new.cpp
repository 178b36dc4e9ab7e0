// polder new: a commented case file to start from.
#include <filesystem>
#include <iostream>

#include "case_argument.hpp"
#include "commands.hpp"
#include "polder/case/schema_pages.hpp"
#include "polder/result/atomic_file.hpp"
#include "polder/result/output_error.hpp"

namespace polder::cli {
namespace {

int write_new(const std::string& name, const std::string& from) {
  namespace fs = std::filesystem;
  const fs::path path = fs::path(name).extension() == ".toml" ? fs::path(name) : fs::path(name) / "case.toml";
  if (fs::exists(path))
    throw Failure(status_wrong_input, "\"" + path.string() + "\" exists already; choose another name, or remove it");
  std::string text = from.empty() ? new_case() : "";
  if (!from.empty()) {
    Diagnostics diagnostics;
    text = new_case_from(find_case_file(from), path.has_parent_path() ? path.parent_path().string() : ".", diagnostics);
    std::cerr << format(diagnostics);
    if (has_errors(diagnostics)) return status_wrong_input;
  }
  try {
    if (path.has_parent_path()) make_folder(path.parent_path());
    write_atomically(path, text);
  } catch (const OutputError& error) {
    throw Failure(status_not_written, error.what());
  }
  std::cout << "wrote " << path.string() << "; next: polder check " << path.string() << '\n';
  return status_done;
}

}  // namespace

void add_new(CLI::App& polder, Action& action) {
  struct Options {
    std::string name, from;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = add_command(polder, "new", "Write a commented case file to start from",
                                  "polder new my-dike.toml\n"
                                  "polder new my-dike                      writes my-dike/case.toml\n"
                                  "polder new my-dike.toml --from dike-seepage");
  command->add_option("NAME", options->name, "A file that ends with .toml, or a folder for a case.toml")->required();
  command->add_option("--from", options->from, "Start from this case: a file or the name of a shipped one")
      ->type_name("CASE");
  command->callback([&action, options] { action = [options] { return write_new(options->name, options->from); }; });
}

}  // namespace polder::cli
