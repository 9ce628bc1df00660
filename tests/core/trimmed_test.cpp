#include "palpate/core/trimmed.h"

#include "testing/testing.h"

namespace palpate::trimmed_test {
namespace {

TEST(Trimmed, TakesTheBlanksAroundATextAndNoneWithin) {
  EXPECT_EQ(trimmed(" \t a b\t "), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \t"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Trimmed, KnowsNoOtherBlanksThanItWasTold) {
  EXPECT_EQ(trimmed("a\n"), "a\n");
  EXPECT_EQ(trimmed("\r a\n", " \r\n"), "a");
}

}  // namespace
}  // namespace palpate::trimmed_test
