// polder schema: what a case file may say, as a page or as a JSON Schema for editors.
#include <iostream>

#include "commands.hpp"
#include "polder/case/schema_pages.hpp"

namespace polder::cli {

void add_schema(CLI::App& polder, Action& action) {
  CLI::App* command = add_command(polder, "schema", "Print what a case file may say",
                                  "polder schema --docs > docs/case-file.md\n"
                                  "polder schema --json > docs/case.schema.json");
  const auto json = std::make_shared<bool>(false);
  const auto docs = std::make_shared<bool>(false);
  CLI::Option* page = command->add_flag("--docs", *docs, "As a Markdown page (the default)");
  command->add_flag("--json", *json, "As a JSON Schema, for editors that complete and check TOML")->excludes(page);
  command->callback([&action, json] {
    action = [json] {
      std::cout << (*json ? case_json_schema() : case_file_page());
      return std::cout.flush() ? status_done : status_not_written;
    };
  });
}

}  // namespace polder::cli
