#include "gui/widgets/status_lines.h"

#include <QCoreApplication>
#include <QScrollBar>

#include <gtest/gtest.h>

namespace palpate::gui::status_lines_test {
namespace {

TEST(StatusLinesTest, ALongTextIsReadWholeInTheSamePlace) {
  StatusLines lines(2, "state");
  lines.resize(150, lines.height());
  lines.show();
  const int height = lines.height();
  lines.setText("short");
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.verticalScrollBar()->maximum(), 0);
  EXPECT_EQ(lines.label().toolTip(), "short");
  lines.setText(QString("a long sentence that needs several lines ").repeated(4), "all of it");
  QCoreApplication::processEvents();
  EXPECT_EQ(lines.height(), height);
  EXPECT_GT(lines.verticalScrollBar()->maximum(), 0);
  EXPECT_GE(lines.label().height(), lines.label().heightForWidth(lines.label().width()));
  EXPECT_EQ(lines.label().toolTip(), "all of it");
  lines.verticalScrollBar()->setValue(5);
  lines.setText(QString("another long sentence that needs several lines ").repeated(4));
  EXPECT_EQ(lines.verticalScrollBar()->value(), 0) << "from its begin";
}

}  // namespace
}  // namespace palpate::gui::status_lines_test
