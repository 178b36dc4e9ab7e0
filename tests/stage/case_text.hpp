#pragma once
// A case written out in a test.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "polder/case/reader.hpp"

namespace polder {

/// The model of a case's text; fails the running test where the case has mistakes.
inline Model read_text(const std::string& text) {
  const std::string path =
      testing::TempDir() + "/" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
  std::ofstream(path) << text;
  const ReadResult result = read_case(path);
  EXPECT_TRUE(result.ok()) << format(result.diagnostics);
  return result.model;
}

}  // namespace polder
