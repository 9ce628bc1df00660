#include "gui/widgets/status_strip.h"

#include <QApplication>
#include <QHelpEvent>
#include <QToolTip>

#include <gtest/gtest.h>

namespace palpate::gui::status_strip_test {
namespace {

TEST(StatusStrip, TheToolTipHasWhatIsCutOff) {
  StatusStrip strip;
  strip.setToolTip("nothing is cut off");
  strip.show();
  const auto tipOf = [&](const Status& status, int width) {
    strip.setStatus(status);
    EXPECT_EQ(strip.status(), status);
    strip.resize(width, strip.sizeHint().height());
    strip.grab();
    QToolTip::hideText();
    const QPoint at(5, 5);
    QHelpEvent event(QEvent::ToolTip, at, strip.mapToGlobal(at));
    QApplication::sendEvent(&strip, &event);
    return QToolTip::text();
  };
  const QString notice = QString("no baseline was taken: 1 reading moved ").repeated(3) + "end";
  Status status{.state = "live", .figures = {"rate 30"}, .notice = notice, .right = "pad"};
  EXPECT_EQ(tipOf(status, 3000), "nothing is cut off");
  EXPECT_EQ(tipOf(status, 400), notice);
  status.right = QString("the emulated hand ").repeated(20);
  const QString tip = tipOf(status, 400);
  EXPECT_TRUE(tip.contains(status.right)) << tip.toStdString();
  EXPECT_TRUE(tip.contains(notice)) << tip.toStdString();
  QToolTip::hideText();
}

}  // namespace
}  // namespace palpate::gui::status_strip_test
