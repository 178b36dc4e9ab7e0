#pragma once
#include <gtest/gtest.h>

#include "polder/verify/suite.hpp"

namespace polder::verify {

inline std::string table_of(const Outcome& outcome) {
  std::string text = outcome.trouble;
  for (const Row& row : outcome.rows)
    text += "\n" + row.quantity + " at " + row.at + ": " + std::to_string(row.computed) + " for " +
            (row.reference ? std::to_string(*row.reference) : "–") + ", error " +
            (row.error ? std::to_string(*row.error) : "–") + (row.pass ? "" : "  SHORT");
  return text;
}

/// Problems of `--quick`, or the others.
inline std::vector<std::string> names(bool quick) {
  std::vector<std::string> list;
  for (const Problem& problem : problems())
    if (problem.quick == quick) list.emplace_back(problem.name);
  return list;
}

inline std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

/// Each problem is a test of its own: it stays within the tolerances that stand beside its case.
class VerificationProblem : public testing::TestWithParam<std::string> {};

}  // namespace polder::verify
