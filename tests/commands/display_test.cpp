#include "commands/display.h"

#include <QtGlobal>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace palpate::commands::display_test {
namespace {

// A second call must not put the handler of messages behind itself.
TEST(DrawWithoutDisplay, MayBeCalledAgain) {
  drawWithoutDisplay();
  drawWithoutDisplay();
  EXPECT_STREQ(std::getenv("QT_QPA_PLATFORM"), "offscreen");
  ::testing::internal::CaptureStderr();
  qWarning("said once");
  qWarning("This plugin does not support propagateSizeHints()");
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("said once"), std::string::npos);
  EXPECT_EQ(said.find("propagateSizeHints"), std::string::npos);
}

}  // namespace
}  // namespace palpate::commands::display_test
