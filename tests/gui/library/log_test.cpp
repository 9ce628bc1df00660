// The dock Log: what the window said.
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTableView>
#include <QToolButton>

#include "gui/appearance/text_size.h"
#include "gui/library/log_panel.h"
#include "gui/testing/fake_ask.h"
#include "gui/testing/fake_clock.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::log_test {
namespace {

using Severity = LogLine::Severity;

class LogTest : public ::testing::Test {
 protected:
  LogTest() {
    panel_.resize(500, 160);
    panel_.show();
    panel_.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&panel_));
  }
  QStringList shown() {
    QStringList texts;
    for (int row = 0; row < table()->model()->rowCount(); ++row)
      texts.append(table()->model()->index(row, ActivityLog::kText).data().toString());
    return texts;
  }
  // As the table draws a cell with wrapped text.
  QStyleOptionViewItem optionOf(int row) {
    QStyleOptionViewItem option;
    option.initFrom(table());
    option.font = table()->font();
    option.widget = table();
    option.features |= QStyleOptionViewItem::WrapText;
    // Without the padding of the theme, 6 px on both sides.
    option.rect =
        table()->visualRect(table()->model()->index(row, ActivityLog::kText)).adjusted(6, 0, -6, 0);
    return option;
  }
  QTableView* table() { return panel_.findChild<QTableView*>("logTable"); }
  template <class Widget>
  Widget* find(const char* name) {
    return panel_.findChild<Widget*>(name);
  }
  void three() {
    log_.add(Severity::kInfo, "opened a.dsa");
    log_.add(Severity::kWarning, "frames are missing");
    log_.add(Severity::kError, "a.dsa can't be written");
  }
  testing::TemporaryFolder folder_;
  FakeClock clock_;
  ActivityLog log_{clock_};
  FakeAsk ask_;
  LogPanel panel_{log_, ask_};
};

TEST_F(LogTest, TheNewestStandsLast) {
  EXPECT_TRUE(find<QLabel>("logEmpty")->isVisible());
  three();
  EXPECT_EQ(shown(), (QStringList{"opened a.dsa", "frames are missing", "a.dsa can't be written"}));
  EXPECT_FALSE(find<QLabel>("logEmpty")->isVisible());
  EXPECT_EQ(log_.line(1).timeMs, 5000);
}

TEST_F(LogTest, TheSameAgainIsCounted) {
  log_.add(Severity::kInfo, "marked");
  clock_.advanceMs(10);
  log_.add(Severity::kInfo, "marked");
  log_.add(Severity::kWarning, "marked");
  EXPECT_EQ(shown(), (QStringList{"marked (2 times)", "marked"}));
  EXPECT_EQ(log_.line(0).timeMs, 5010);
}

TEST_F(LogTest, NothingAndLineEndsMakeNoLines) {
  log_.add(Severity::kInfo, "  ");
  log_.add(Severity::kInfo, "one\ntwo");
  EXPECT_EQ(shown(), QStringList{"one two"});
}

TEST_F(LogTest, BySeverityAndByWords) {
  three();
  find<QComboBox>("logSeverity")->setCurrentIndex(1);
  EXPECT_EQ(shown(), (QStringList{"frames are missing", "a.dsa can't be written"}));
  find<QComboBox>("logSeverity")->setCurrentIndex(2);
  EXPECT_EQ(shown(), QStringList{"a.dsa can't be written"});
  find<QComboBox>("logSeverity")->setCurrentIndex(0);
  find<QLineEdit>("logSearch")->setText("A.DSA written");
  EXPECT_EQ(shown(), QStringList{"a.dsa can't be written"});
  find<QLineEdit>("logSearch")->setText("nowhere");
  EXPECT_TRUE(find<QLabel>("logEmpty")->isVisible());
  find<QPushButton>("logEmptyButton")->click();
  EXPECT_EQ(shown().size(), 3);
}

TEST_F(LogTest, CopiesWhatIsShownOrChosen) {
  three();
  find<QComboBox>("logSeverity")->setCurrentIndex(1);
  find<QToolButton>("logCopy")->click();
  QStringList lines = QApplication::clipboard()->text().split('\n');
  ASSERT_EQ(lines.size(), 3);
  EXPECT_TRUE(lines[0].endsWith("  warning  frames are missing")) << lines[0].toStdString();
  EXPECT_TRUE(lines[1].endsWith("  error    a.dsa can't be written")) << lines[1].toStdString();
  table()->setFocus();
  QTest::keyClick(table(), Qt::Key_End);
  QTest::keyClick(table(), Qt::Key_C, Qt::ControlModifier);
  lines = QApplication::clipboard()->text().split('\n');
  ASSERT_EQ(lines.size(), 2);
  EXPECT_TRUE(lines[0].endsWith("written"));
}

TEST_F(LogTest, IsSavedAndSaysWhenItCantBe) {
  three();
  // The last time it is cancelled.
  ask_.newFiles = {pathText(folder_ / "log.txt"), pathText(folder_ / "missing/log.txt"), QString()};
  QSignalSpy saved(&panel_, &LogPanel::saved);
  QSignalSpy failed(&panel_, &LogPanel::failed);
  find<QToolButton>("logSave")->click();
  EXPECT_EQ(saved.size(), 1);
  EXPECT_EQ(QString::fromStdString(testing::readFile(folder_ / "log.txt")), panel_.text());
  find<QToolButton>("logSave")->click();
  EXPECT_EQ(failed.size(), 1);
  find<QToolButton>("logSave")->click();
  EXPECT_EQ(saved.size() + failed.size(), 2);
}

TEST_F(LogTest, KeepsTheLastTenThousandLines) {
  for (int i = 0; i < 25'000; ++i) log_.add(Severity::kInfo, QString::number(i));
  EXPECT_LE(log_.rowCount(), ActivityLog::kMaxLines);
  EXPECT_GE(log_.rowCount(), ActivityLog::kMaxLines - 500);
  EXPECT_EQ(log_.line(log_.rowCount() - 1).text, "24999");
  EXPECT_EQ(log_.line(0).text, QString::number(25'000 - log_.rowCount()));
  log_.add(Severity::kInfo, QString(100'000, 'x'));
  EXPECT_EQ(log_.line(log_.rowCount() - 1).text.size(), ActivityLog::kMaxTextLength);
}

// Each line is seen whole, and its time, with text of every size.
TEST_F(LogTest, RowsAndTheColumnOfTimeAreAsLargeAsTheirText) {
  log_.add(Severity::kInfo, "opened a.dsa");
  log_.add(Severity::kWarning, QString("frames are missing ").repeated(20));
  for (const int pt : {12, 15, 18, 0}) {
    applyTextPt(pt);
    for (const int width : {500, 340}) {
      panel_.resize(width, 160);
      QCoreApplication::processEvents();
      QCoreApplication::processEvents();
      log_.add(Severity::kInfo, QString("one more of %1 ").arg(width + pt).repeated(12));
      for (int row = 0; row < table()->model()->rowCount(); ++row) {
        const int needed =
            table()
                ->itemDelegate()
                ->sizeHint(optionOf(row), table()->model()->index(row, ActivityLog::kText))
                .height();
        EXPECT_GE(table()->rowHeight(row), needed) << row << ", " << pt << " pt, " << width;
      }
      EXPECT_GE(table()->columnWidth(ActivityLog::kTime),
                table()->fontMetrics().horizontalAdvance("00:00:00") + 12)
          << "padding of 6 px on both sides, " << pt << " pt";
    }
  }
  EXPECT_GT(table()->rowHeight(1), 3 * table()->rowHeight(0)) << "more than three lines";
}

TEST_F(LogTest, StaysAtTheEndUnlessSomebodyReadsFurtherUp) {
  for (int i = 0; i < 100; ++i) log_.add(Severity::kInfo, QString::number(i));
  QScrollBar* bar = table()->verticalScrollBar();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return bar->maximum() > 0 && bar->value() == bar->maximum(); }));
  bar->setValue(10);
  const int most = bar->maximum();
  for (int i = 0; i < 50; ++i) log_.add(Severity::kInfo, "more " + QString::number(i));
  ASSERT_TRUE(QTest::qWaitFor([&] { return bar->maximum() > most; }));
  EXPECT_EQ(bar->value(), 10);
}

// In the window: what is said anywhere is in the log.
class WindowLogTest : public WindowTest {
 protected:
  bool logHas(Severity severity, const QString& part) {
    const ActivityLog& log = window().state().log;
    for (int row = 0; row < log.rowCount(); ++row)
      if (log.line(row).severity == severity && log.line(row).text.contains(part)) return true;
    return false;
  }
};

TEST_F(WindowLogTest, KeepsWhatTheWindowSays) {
  open({"good.dsa", "bad.dsa"});
  EXPECT_TRUE(logHas(Severity::kInfo, "good.dsa: 20 frames"));
  EXPECT_TRUE(logHas(Severity::kError, "bad.dsa"));
  press(Qt::Key_C, Qt::ControlModifier);
  EXPECT_TRUE(QTest::qWaitFor([&] { return logHas(Severity::kInfo, "copied"); }));
}

TEST_F(WindowLogTest, IsShownByItsKey) {
  open({"good.dsa"});
  auto* panel = find<LogPanel>("LogPanel");
  EXPECT_FALSE(panel->isVisible());
  press(Qt::Key_J, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(panel->isVisible());
  press(Qt::Key_J, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(panel->isVisible());
}

}  // namespace
}  // namespace palpate::gui::log_test
