#include "case_argument.hpp"

#include <iostream>

#include "commands.hpp"
#include "polder/case/locate.hpp"

namespace polder::cli {

std::string find_case_file(const std::string& name_or_path) {
  if (const auto file = find_case(name_or_path)) return file->string();
  std::vector<std::string> names;
  for (const ShippedCase& shipped : shipped_cases()) names.push_back(shipped.name);
  const std::string near = nearest(name_or_path, names);
  throw Failure(status_wrong_input,
                "there is no case \"" + name_or_path +
                    "\": neither a file, nor a folder with a case.toml, nor a shipped case; " +
                    (near.empty() ? "'polder list' names those" : "did you mean \"" + near + "\"?"));
}

Model read_case_or_fail(const std::string& name_or_path, const std::vector<std::string>& overrides) {
  ReadResult result = read_case(find_case_file(name_or_path), overrides);
  std::cerr << format(result.diagnostics);
  if (!result.ok()) throw Failure(status_wrong_input, "the case is wrong; nothing was written");
  return std::move(result.model);
}

}  // namespace polder::cli
