#include "gui/help/manual_window.h"

#include <QDir>
#include <QRegularExpression>
#include <QScreen>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextImageFormat>

#include "gui/testing/window_fixture.h"

namespace palpate::gui::manual_window_test {
namespace {

class ManualWindowTest : public WindowTest {
 protected:
  ManualWindowTest()
      : folder_(ManualPages::folderFor(testing::dataFolder())), manual_(folder_, nullptr) {
    manual_.QWidget::show();
    QCoreApplication::processEvents();
  }
  ManualBrowser& browser() { return *manual_.findChild<ManualBrowser*>(); }
  QString text() { return browser().toPlainText(); }
  QString firstLine() { return browser().document()->begin().text(); }
  int scroll() { return browser().verticalScrollBar()->value(); }
  // The text at the top of what is shown.
  QString atTheTop() { return browser().cursorForPosition({30, 12}).block().text(); }
  QString status() {
    QString all;
    for (const QLabel* label : manual_.findChildren<QLabel*>()) all += label->text();
    return all;
  }
  std::filesystem::path folder_;
  ManualWindow manual_;
};

TEST_F(ManualWindowTest, BeginsWithItsContents) {
  EXPECT_EQ(manual_.page(), "README.md");
  EXPECT_EQ(firstLine(), "Documentation of Palpate");
  const auto* contents = manual_.findChild<QTreeWidget*>();
  const QDir manual(QString::fromStdString((folder_ / "manual").string()));
  EXPECT_EQ(contents->topLevelItemCount(), 1 + manual.entryList({"*.md"}).size());
}

TEST_F(ManualWindowTest, FollowsLinksAndComesBack) {
  manual_.follow("docks.md#slip");
  EXPECT_EQ(manual_.page(), "manual/docks.md");
  EXPECT_EQ(atTheTop(), "Slip");
  manual_.follow("#hand");
  EXPECT_EQ(atTheTop(), "Hand");
  const int place = scroll();
  manual_.follow("first_hour.md");
  EXPECT_EQ(manual_.page(), "manual/first_hour.md");
  EXPECT_EQ(scroll(), 0);
  manual_.back();
  EXPECT_EQ(manual_.page(), "manual/docks.md");
  EXPECT_EQ(scroll(), place);
  manual_.back();
  manual_.back();
  EXPECT_EQ(manual_.page(), "README.md");
  manual_.back();
  manual_.forward();
  EXPECT_EQ(atTheTop(), "Slip");
}

TEST_F(ManualWindowTest, ANoteIsShownAndBackLeadsToTheManual) {
  manual_.follow("docks.md");
  manual_.follow("../notes/slip.md");
  EXPECT_EQ(manual_.page(), "notes/slip.md");
  manual_.back();
  EXPECT_EQ(manual_.page(), "manual/docks.md");
}

TEST_F(ManualWindowTest, AFileOfTheSourceCodeIsSaidToBeOne) {
  manual_.follow("../include/palpate/no_such_header.h");
  EXPECT_EQ(manual_.page(), "README.md");
  EXPECT_TRUE(status().contains("Only in the source code of Palpate: include/palpate/"))
      << status().toStdString();
}

TEST_F(ManualWindowTest, EveryLinkOfEveryPageLeadsToItsHeading) {
  const ManualPages pages(folder_);
  static const QRegularExpression link(R"(\]\(((?:\.\./)?[a-z0-9_/]*(?:\.md)?)#([^)\s]+)\))");
  int links = 0;
  for (const QString& name : pages.names()) {
    QFile file(QString::fromStdString((folder_ / name.toStdString()).string()));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    auto found = link.globalMatch(QString::fromUtf8(file.readAll()));
    while (found.hasNext()) {
      const auto match = found.next();
      const QString page =
          match.captured(1).isEmpty() ? name : pages.target(match.captured(1), name);
      EXPECT_TRUE(pages.positionOf(page, match.captured(2)))
          << name.toStdString() << ": " << match.captured(0).toStdString();
      ++links;
    }
  }
  EXPECT_GT(links, 30);
}

TEST_F(ManualWindowTest, ShowsPicturesNoWiderThanThePage) {
  manual_.follow("first_hour.md");
  int pictures = 0;
  for (QTextBlock block = browser().document()->begin(); block.isValid(); block = block.next())
    for (auto part = block.begin(); !part.atEnd(); ++part) {
      const QTextImageFormat format = part.fragment().charFormat().toImageFormat();
      if (!format.isValid()) continue;
      const QImage picture = browser()
                                 .document()
                                 ->resource(QTextDocument::ImageResource, format.name())
                                 .value<QImage>();
      EXPECT_FALSE(picture.isNull()) << format.name().toStdString();
      EXPECT_LE(picture.width(), browser().viewport()->width());
      ++pictures;
    }
  EXPECT_GT(pictures, 3);
  EXPECT_EQ(browser().horizontalScrollBar()->maximum(), 0);
}

// A paragraph with the words several times is listed once for each part of it that is shown.
TEST_F(ManualWindowTest, NoPartOfAParagraphIsListedTwice) {
  manual_.findChild<QLineEdit*>()->setText("coherence");
  const auto* found = manual_.findChild<QListWidget*>();
  ASSERT_GT(found->count(), 1);
  QStringList rows;
  for (int i = 0; i < found->count(); ++i) {
    rows << found->item(i)->text();
    EXPECT_TRUE(rows.last().contains("coherence", Qt::CaseInsensitive));
  }
  EXPECT_EQ(rows.removeDuplicates(), 0);
}

// Over a small window in the corner of the screen, too.
TEST_F(ManualWindowTest, ItsTitleBarIsOnTheScreen) {
  QWidget corner;
  corner.setGeometry(0, 0, 300, 200);
  corner.show();
  ManualWindow manual(folder_, &corner);
  manual.QWidget::show();
  QCoreApplication::processEvents();
  const QRect available = manual.screen()->availableGeometry();
  constexpr int kTitleBar = 24;  // [px] at least
  EXPECT_GE(manual.geometry().top(), available.top() + kTitleBar);
  EXPECT_GE(manual.geometry().left(), available.left());
}

TEST_F(ManualWindowTest, SearchGoesThroughAllPages) {
  auto* words = manual_.findChild<QLineEdit*>();
  QTest::keyClick(&manual_, Qt::Key_F, Qt::ControlModifier);
  words->setText("newton");
  auto* found = manual_.findChild<QListWidget*>();
  EXPECT_TRUE(found->isVisible());
  ASSERT_GT(found->count(), 2);
  EXPECT_FALSE(browser().extraSelections().isEmpty() && manual_.page() == "manual/forces.md");
  QTest::keyClick(words, Qt::Key_Return);
  EXPECT_EQ(found->currentRow(), 0);
  const auto marks = browser().extraSelections();
  ASSERT_FALSE(marks.isEmpty());
  EXPECT_EQ(marks.front().cursor.selectedText().toLower(), "newton");
  const int last = found->count() - 1;
  manual_.previousHit();
  EXPECT_EQ(found->currentRow(), last);
  EXPECT_TRUE(status().contains(QString("Place %1 of %1").arg(found->count())));
  words->setText("newton xylophone");
  EXPECT_EQ(found->count(), 0);
  EXPECT_TRUE(status().contains("No page has all these words"));
  words->clear();
  EXPECT_TRUE(manual_.findChild<QTreeWidget*>()->isVisible());
  EXPECT_TRUE(browser().extraSelections().isEmpty());
}

TEST_F(ManualWindowTest, IsReadableInBothThemes) {
  for (const Theme theme : {Theme::kLight, Theme::kDark}) {
    applyTheme(*qApp, theme);
    EXPECT_EQ(browser().palette().color(QPalette::Base), colorsOf(theme).window);
    manual_.follow("docks.md");
    for (QTextBlock block = browser().document()->begin(); block.isValid(); block = block.next())
      for (auto part = block.begin(); !part.atEnd(); ++part) {
        const QTextCharFormat format = part.fragment().charFormat();
        if (format.isAnchor()) {
          ASSERT_EQ(format.foreground().color(), colorsOf(theme).accent);
        }
      }
  }
}

TEST_F(ManualWindowTest, SaysWhereItsPagesShouldBe) {
  ManualWindow none("/nowhere/docs", nullptr);
  EXPECT_TRUE(
      none.findChild<ManualBrowser*>()->toPlainText().contains("there is none in /nowhere/docs"));
}

TEST_F(ManualWindowTest, TheMenuShowsOneBesideTheWindow) {
  press(Qt::Key_F1, Qt::ControlModifier);
  press(Qt::Key_F1, Qt::ControlModifier);
  const auto shown = window().findChildren<ManualWindow*>();
  ASSERT_EQ(shown.size(), 1);
  EXPECT_TRUE(shown.front()->isVisible());
  EXPECT_FALSE(shown.front()->isModal());
  shown.front()->close();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  actions().at("manual")->trigger();
  EXPECT_EQ(window().findChildren<ManualWindow*>().size(), 1);
}

}  // namespace
}  // namespace palpate::gui::manual_window_test
