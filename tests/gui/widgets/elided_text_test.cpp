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

TEST(ElidedText, AnotherTextLosesItsEnd) {
  const QFontMetrics metrics{QFont()};
  const QString text = "31.7 frames/s and much more that has no room";
  EXPECT_EQ(withShorterPath(text, metrics, 90), metrics.elidedText(text, Qt::ElideRight, 90));
}

}  // namespace
}  // namespace palpate::gui::elided_text_test
