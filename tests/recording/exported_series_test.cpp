#include "palpate/recording/exported_series.h"

#include <gtest/gtest.h>

namespace palpate::exported_series_test {
namespace {

TEST(Provenance, sameOnlyWhereEveryTextIs) {
  const Provenance a{"palpate 1", "a.dsa", "00", "median", "pad", "pad_hand"};
  Provenance b = a;
  EXPECT_EQ(a, b);
  for (std::string* text :
       {&b.program, &b.sourceFile, &b.sourceSha256, &b.filters, &b.calibration, &b.hand}) {
    const std::string before = *text;
    *text += "x";
    EXPECT_NE(a, b);
    *text = before;
  }
}

}  // namespace
}  // namespace palpate::exported_series_test
