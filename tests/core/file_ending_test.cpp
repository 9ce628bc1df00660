#include "palpate/core/file_ending.h"

#include "testing/testing.h"

namespace palpate::file_ending_test {
namespace {

TEST(FileEnding, IsTheLastOneInSmallLettersWithItsDot) {
  EXPECT_EQ(lowerEndingOf("folder.x/Run_1.PALPATE"), ".palpate");
  EXPECT_EQ(lowerEndingOf("a.tar.Gz"), ".gz");
  EXPECT_EQ(lowerEndingOf("folder.x/name"), "");
  EXPECT_EQ(lowerEndingOf(".hidden"), "");
}

}  // namespace
}  // namespace palpate::file_ending_test
