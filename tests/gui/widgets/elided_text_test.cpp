#include "gui/widgets/elided_text.h"

#include <QFont>
#include <QFontMetrics>

#include <gtest/gtest.h>

namespace palpate::gui::elided_text_test {
namespace {

TEST(ElidedText, OfAPathTheFoldersAreLeftOutFirst) {
  const QFontMetrics metrics{QFont()};
  const QString text = "written: /tmp/some/where/else/hockey_ball.csv (3 labels)";
  const int whole = metrics.horizontalAdvance(text);
  EXPECT_EQ(withShorterPath(text, metrics, whole), text);
  const QString shorter = withShorterPath(text, metrics, whole - 20);
  EXPECT_TRUE(shorter.startsWith("written: /tmp")) << shorter.toStdString();
  EXPECT_TRUE(shorter.endsWith("…/hockey_ball.csv (3 labels)")) << shorter.toStdString();
  EXPECT_LE(metrics.horizontalAdvance(shorter), whole - 20);
  const int name = metrics.horizontalAdvance("…/hockey_ball.csv (3 labels)");
  EXPECT_EQ(withShorterPath(text, metrics, name + 1), "…/hockey_ball.csv (3 labels)");
}

TEST(ElidedText, OfTwoPathsTheFirstOneIsShortened) {
  const QFontMetrics metrics{QFont()};
  const QString text = "renamed /tmp/some/where/else/ball.csv to /tmp/cup.csv";
  const int whole = metrics.horizontalAdvance(text);
  const QString shorter = withShorterPath(text, metrics, whole - 20);
  EXPECT_TRUE(shorter.endsWith("…/ball.csv to /tmp/cup.csv")) << shorter.toStdString();
  EXPECT_LE(metrics.horizontalAdvance(shorter), whole - 20);
}

TEST(ElidedText, AnotherTextLosesItsEnd) {
  const QFontMetrics metrics{QFont()};
  for (const char* text : {"31.7 frames/s and much more that has no room",
                           "10 deg/s, closed until 3 counts/s of the finger"})
    EXPECT_EQ(withShorterPath(text, metrics, 90), metrics.elidedText(text, Qt::ElideRight, 90));
}

}  // namespace
}  // namespace palpate::gui::elided_text_test
