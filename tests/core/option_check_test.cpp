#include "palpate/core/option_check.h"

#include <gtest/gtest.h>

namespace palpate::option_check_test {
namespace {

TEST(OptionCheck, SaysWhatIsWrong) {
  constexpr OptionCheck check{"ShapeOptions"};
  EXPECT_NO_THROW(check(true, "widthMm", -1.0));
  try {
    check(false, "widthMm", -1.0);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "ShapeOptions: widthMm is -1.000000");
  }
}

}  // namespace
}  // namespace palpate::option_check_test
