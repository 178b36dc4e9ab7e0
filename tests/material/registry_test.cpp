#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "polder/material/law.hpp"

namespace polder {
namespace {

TEST(SoilLaws, HaveDistinctNamesAndTablesThatHoldTheirOwnDefaults) {
  std::set<std::string_view> names;
  for (const LawDescription& law : soil_laws()) {
    EXPECT_TRUE(names.insert(law.name).second) << law.name;
    EXPECT_EQ(find_soil_law(law.name), &law);
    std::set<std::string_view> keys;
    for (const Parameter& p : law.parameters) {
      EXPECT_TRUE(keys.insert(p.key).second) << law.name << " " << p.key;
      EXPECT_LT(p.low, p.high) << law.name << " " << p.key;
      EXPECT_FALSE(p.doc.empty()) << law.name << " " << p.key;
      if (!p.required && !std::isnan(p.standard)) {
        EXPECT_GE(p.standard, p.low) << law.name << " " << p.key;
        EXPECT_LE(p.standard, p.high) << law.name << " " << p.key;
      }
    }
  }
  EXPECT_EQ(find_soil_law("no-such-law"), nullptr);
}

}  // namespace
}  // namespace polder
