// The dock Library: what it lists, how it is searched and sorted, and everything by keyboard.
#include <QClipboard>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QUrl>

#include "palpate/device/sdh2.h"
#include <palpate/core/error.h>
#include <palpate/recording/event_store.h>
#include <palpate/recording/palpate_writer.h>

#include "gui/library/library_panel.h"
#include "gui/testing/fake_ask.h"
#include "testing/testing.h"

namespace palpate::gui::library_test {
namespace {
namespace fs = std::filesystem;

constexpr std::int64_t kStartUs = 1'417'084'265'000'000;

void writeRecording(const fs::path& path,
                    int frames,
                    std::int64_t startUs,
                    const std::map<std::string, std::string>& meta) {
  PalpateWriterOptions options;
  options.synced = false;
  PalpateWriter writer(path, sdh2().layout, meta, options);
  TactileFrame frame(sdh2().layout);
  for (int i = 0; i < frames; ++i) {
    frame.hostUs = startUs + i * 1'000'000;
    writer.addFrame(frame);
  }
  writer.addEvent({startUs, startUs, "label", {}, meta.at("object") + " touched", ""});
  writer.finish();
}

class LibraryTest : public ::testing::Test {
 protected:
  LibraryTest() {
    fs::create_directories(recordings() / "old");
    writeRecording(recordings() / "run_2.palpate",
                   3,
                   kStartUs,
                   {{"object", "foam ball"}, {"operator", "Ada"}, {"run", "2"}});
    writeRecording(recordings() / "run_10.palpate",
                   131,
                   kStartUs + 86'400'000'000,
                   {{"object", "cup"}, {"operator", "Max"}, {"run", "10"}, {"notes", "a\nb"}});
    writeRecording(recordings() / "old" / "run_1.palpate",
                   6,
                   kStartUs - 86'400'000'000,
                   {{"object", "tennis ball"}, {"operator", "Ada"}, {"run", "1"}});
    testing::writeFile(recordings() / "bad.dsa", "nonsense");
    start();
  }
  ~LibraryTest() override { panel_.reset(); }

  void start(LibraryScanner::Catalog catalog = catalogRecordings) {
    panel_.reset();
    panel_ = std::make_unique<LibraryPanel>(
        settings_, ask_, QString::fromStdString((folder_ / "cache").string()), std::move(catalog));
    panel_->resize(900, 400);
    panel_->show();
    panel_->activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(panel_.get()));
  }
  fs::path recordings() const { return folder_ / "recordings"; }
  void look() {
    QSignalSpy settled(panel_.get(), &LibraryPanel::settled);
    panel_->setFolder(QString::fromStdString(recordings().string()));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !settled.isEmpty(); }, 10000));
  }
  void settle() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !panel_->scanning(); }, 10000));
  }
  template <class Widget>
  Widget* find(const char* name) {
    return panel_->findChild<Widget*>(name);
  }
  QTableView* table() { return find<QTableView>("libraryTable"); }
  QStringList column(int column) {
    QStringList texts;
    for (int row = 0; row < table()->model()->rowCount(); ++row)
      texts.append(table()->model()->index(row, column).data().toString());
    return texts;
  }
  QStringList names() { return column(LibraryModel::kName); }
  void search(const QString& text) { find<QLineEdit>("librarySearch")->setText(text); }
  QString empty() {
    auto* label = find<QLabel>("libraryEmpty");
    return label->isVisible() ? label->text() : QString();
  }
  QString path(const char* name) { return QString::fromStdString((recordings() / name).string()); }

  testing::TemporaryFolder folder_;
  QSettings settings_{QString::fromStdString((folder_ / "s.ini").string()), QSettings::IniFormat};
  FakeAsk ask_;
  std::unique_ptr<LibraryPanel> panel_;
};

TEST_F(LibraryTest, ListsWhatLiesInAFolderAndBelowIt) {
  look();
  EXPECT_EQ(names(), (QStringList{"run_10.palpate", "run_2.palpate", "run_1.palpate", "bad.dsa"}))
      << "the newest first";
  EXPECT_EQ(column(LibraryModel::kLength),
            (QStringList{"2 min 10 s", "2.0 s", "5.0 s", "damaged"}));
  EXPECT_EQ(column(LibraryModel::kObject), (QStringList{"cup", "foam ball", "tennis ball", ""}));
  EXPECT_EQ(column(LibraryModel::kOperator), (QStringList{"Max", "Ada", "Ada", ""}));
  EXPECT_EQ(column(LibraryModel::kRun), (QStringList{"10", "2", "1", ""}));
  EXPECT_EQ(column(LibraryModel::kNotes), (QStringList{"a b", "", "", ""}));
  EXPECT_EQ(column(LibraryModel::kLabels).at(1), "foam ball touched");
  EXPECT_EQ(column(LibraryModel::kFolder), (QStringList{"", "", "old", ""}));
  EXPECT_EQ(find<QLabel>("librarySummary")->text(), "4 recordings, 2 min 17 s");
  EXPECT_EQ(empty(), "");
  EXPECT_FALSE(find<QProgressBar>("libraryProgress")->isVisible());
}

TEST_F(LibraryTest, SaysWhatIsWrongWithARecording) {
  look();
  const QModelIndex bad = table()->model()->index(3, 0);
  EXPECT_TRUE(bad.data(Qt::ToolTipRole).toString().contains("damaged"));
  EXPECT_NE(bad.data(Qt::ForegroundRole), table()->model()->index(0, 0).data(Qt::ForegroundRole));
}

TEST_F(LibraryTest, IsSearchedAsItIsTyped) {
  look();
  auto* field = find<QLineEdit>("librarySearch");
  panel_->startSearch();
  QTest::keyClicks(field, "ball ada");
  EXPECT_EQ(names(), (QStringList{"run_2.palpate", "run_1.palpate"}));
  EXPECT_EQ(find<QLabel>("librarySummary")->text(), "2 of 4 recordings");
  QTest::keyClick(field, Qt::Key_Escape);
  EXPECT_EQ(field->text(), "");
  EXPECT_EQ(names().size(), 4);
  search("object:cup");
  EXPECT_EQ(names(), QStringList{"run_10.palpate"});
  search("objct:cup");
  EXPECT_TRUE(empty().contains("Unknown search keyword “objct:”; there are name:"))
      << empty().toStdString();
  EXPECT_TRUE(empty().contains("object:"));
  search("nowhere");
  EXPECT_TRUE(empty().contains("nowhere"));
  EXPECT_FALSE(empty().contains("key"));
  find<QPushButton>("libraryEmptyButton")->click();
  EXPECT_EQ(names().size(), 4);
}

TEST_F(LibraryTest, ItsExampleOfASearchFindsSomething) {
  look();
  const QString example = find<QLineEdit>("librarySearch")->placeholderText();
  ASSERT_TRUE(example.startsWith("Search, as ")) << example.toStdString();
  search(example.mid(QString("Search, as ").size()));
  EXPECT_GE(names().size(), 1);
}

TEST_F(LibraryTest, EveryColumnSorts) {
  look();
  table()->sortByColumn(LibraryModel::kName, Qt::AscendingOrder);
  EXPECT_EQ(names(), (QStringList{"bad.dsa", "run_1.palpate", "run_2.palpate", "run_10.palpate"}))
      << "numbers count as numbers";
  table()->sortByColumn(LibraryModel::kLength, Qt::DescendingOrder);
  EXPECT_EQ(names(), (QStringList{"run_10.palpate", "run_1.palpate", "run_2.palpate", "bad.dsa"}));
  table()->sortByColumn(LibraryModel::kObject, Qt::AscendingOrder);
  EXPECT_EQ(names(), (QStringList{"bad.dsa", "run_10.palpate", "run_2.palpate", "run_1.palpate"}));
  for (int column = 0; column < LibraryModel::kNumColumns; ++column) {
    table()->sortByColumn(column, Qt::AscendingOrder);
    const QStringList up = names();
    table()->sortByColumn(column, Qt::DescendingOrder);
    QStringList down = names();
    std::reverse(down.begin(), down.end());
    EXPECT_EQ(up, down) << column;
  }
}

TEST_F(LibraryTest, OpensByKeyAndByDoubleClick) {
  look();
  QSignalSpy asked(panel_.get(), &LibraryPanel::openRequested);
  table()->setFocus();
  table()->selectRow(0);
  QTest::keyClick(table(), Qt::Key_Down);
  QTest::keyClick(table(), Qt::Key_Return);
  ASSERT_EQ(asked.size(), 1);
  EXPECT_EQ(asked[0][0].toStringList(), QStringList{path("run_2.palpate")});
  QTest::keyClick(table(), Qt::Key_Down, Qt::ShiftModifier);
  QTest::keyClick(table(), Qt::Key_Return);
  EXPECT_EQ(asked[1][0].toStringList(),
            (QStringList{path("run_2.palpate"), path("old/run_1.palpate")}));
  const QPoint first = table()->visualRect(table()->model()->index(0, 0)).center();
  QTest::mouseClick(table()->viewport(), Qt::LeftButton, {}, first);
  QTest::mouseDClick(table()->viewport(), Qt::LeftButton, {}, first);
  EXPECT_EQ(asked.last()[0].toStringList(), QStringList{path("run_10.palpate")});
}

TEST_F(LibraryTest, FromTheSearchIntoTheTableAndBack) {
  look();
  panel_->startSearch();
  auto* field = find<QLineEdit>("librarySearch");
  QTest::keyClicks(field, "cup");
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_TRUE(table()->hasFocus());
  QSignalSpy asked(panel_.get(), &LibraryPanel::openRequested);
  QTest::keyClick(table(), Qt::Key_Return);
  ASSERT_EQ(asked.size(), 1);
  EXPECT_EQ(asked[0][0].toStringList(), QStringList{path("run_10.palpate")});
  QTest::keyClick(table(), Qt::Key_F, Qt::ControlModifier);
  EXPECT_TRUE(field->hasFocus());
  QTest::keyClick(field, Qt::Key_Down);
  EXPECT_TRUE(table()->hasFocus());
  QTest::keyClick(table(), Qt::Key_Slash);
  EXPECT_TRUE(field->hasFocus());
}

TEST_F(LibraryTest, HomeAndEndGoToTheFirstAndTheLastRow) {
  look();
  table()->setFocus();
  QTest::keyClick(table(), Qt::Key_End);
  EXPECT_EQ(table()->currentIndex().row(), 3);
  QTest::keyClick(table(), Qt::Key_Home);
  EXPECT_EQ(table()->currentIndex().row(), 0);
  search("nowhere");  // nothing to go to
  QTest::keyClick(table(), Qt::Key_End);
  EXPECT_FALSE(table()->currentIndex().isValid());
}

TEST_F(LibraryTest, ComparesOneWithWhatIsShown) {
  look();
  QSignalSpy asked(panel_.get(), &LibraryPanel::compareRequested);
  table()->setFocus();
  table()->selectRow(1);
  QTest::keyClick(table(), Qt::Key_Return, Qt::ControlModifier);
  EXPECT_TRUE(asked.isEmpty()) << "nothing is shown";
  panel_->comparable = [] { return true; };
  QTest::keyClick(table(), Qt::Key_Return, Qt::ControlModifier);
  ASSERT_EQ(asked.size(), 1);
  EXPECT_EQ(asked[0][0].toString(), path("run_2.palpate"));
  table()->selectAll();
  QTest::keyClick(table(), Qt::Key_Return, Qt::ControlModifier);
  EXPECT_EQ(asked.size(), 1) << "with one only";
}

TEST_F(LibraryTest, CopiesRowsAsATable) {
  look();
  table()->setFocus();
  table()->selectRow(1);
  QTest::keyClick(table(), Qt::Key_C, Qt::ControlModifier);
  const QStringList lines = QApplication::clipboard()->text().split('\n');
  ASSERT_EQ(lines.size(), 3);
  EXPECT_EQ(lines[0], "name\tlength\tdate\tobject\toperator\trun\tlabels\tnotes\tfolder");
  EXPECT_TRUE(lines[1].startsWith("run_2.palpate\t2.0 s\t2014-11-2"));
  EXPECT_TRUE(lines[1].endsWith("\tfoam ball\tAda\t2\tfoam ball touched\t\t"));
  EXPECT_EQ(lines[2], "");
}

TEST_F(LibraryTest, RowsAreDraggedAsFiles) {
  look();
  const QModelIndexList rows = {table()->model()->index(0, 0), table()->model()->index(0, 1)};
  const std::unique_ptr<QMimeData> data(table()->model()->mimeData(rows));
  EXPECT_EQ(data->urls(), QList<QUrl>{QUrl::fromLocalFile(path("run_10.palpate"))});
}

TEST_F(LibraryTest, FindsWhatChangedAndKeepsTheChosenRow) {
  look();
  table()->selectRow(1);
  fs::remove(recordings() / "bad.dsa");
  fs::remove(recordings() / "run_10.palpate");
  writeRecording(recordings() / "run_3.palpate", 4, kStartUs, {{"object", "pen"}});
  panel_->refresh();
  settle();
  EXPECT_EQ(names(), (QStringList{"run_3.palpate", "run_2.palpate", "run_1.palpate"}));
  ASSERT_EQ(table()->selectionModel()->selectedRows().size(), 1);
  EXPECT_EQ(table()->selectionModel()->selectedRows().first().data().toString(), "run_2.palpate");
}

TEST_F(LibraryTest, SeesByItselfWhatComes) {
  look();
  writeRecording(recordings() / "old" / "new.palpate", 4, kStartUs, {{"object", "pen"}});
  EXPECT_TRUE(QTest::qWaitFor([&] { return names().contains("new.palpate"); }, 20000));
  const EventsReport asRead = {{{kStartUs, kStartUs, "label", {}, "foam ball touched", ""}}, 0};
  saveEvents(recordings() / "run_2.palpate",
             asRead,
             std::vector{Event{kStartUs, kStartUs, "label", {}, "squeezed", ""}});
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return column(LibraryModel::kLabels).contains("squeezed"); }, 20000));
}

TEST_F(LibraryTest, RemembersFolderColumnsAndOrder) {
  look();
  table()->sortByColumn(LibraryModel::kObject, Qt::AscendingOrder);
  table()->horizontalHeader()->resizeSection(LibraryModel::kNotes, 77);
  start();
  settle();
  EXPECT_EQ(panel_->folder(), QString::fromStdString(recordings().string()));
  EXPECT_EQ(names(), (QStringList{"bad.dsa", "run_10.palpate", "run_2.palpate", "run_1.palpate"}));
  EXPECT_EQ(table()->horizontalHeader()->sectionSize(LibraryModel::kNotes), 77);
}

TEST_F(LibraryTest, SaysWhyItIsEmpty) {
  EXPECT_TRUE(empty().contains("recordings of a folder"));
  EXPECT_FALSE(find<QLineEdit>("librarySearch")->isEnabled());
  find<QPushButton>("libraryEmptyButton")->click();
  EXPECT_EQ(panel_->folder(), "") << "cancelled";
  fs::create_directory(folder_ / "empty");
  ask_.folders = {QString::fromStdString((folder_ / "empty").string())};
  find<QPushButton>("libraryEmptyButton")->click();
  settle();
  EXPECT_TRUE(empty().startsWith("No recordings")) << empty().toStdString();
  QSignalSpy said(panel_.get(), &LibraryPanel::said);
  panel_->setFolder(QString::fromStdString((folder_ / "gone").string()));
  settle();
  EXPECT_TRUE(empty().contains("can't be read")) << empty().toStdString();
  EXPECT_EQ(said.size(), 1);
}

TEST_F(LibraryTest, LooksOnlyWhenItIsSeen) {
  std::atomic<int> scans = 0;
  start([&](const auto&, const auto&, const auto&, const auto&) {
    ++scans;
    return CatalogReport{};
  });
  panel_->hide();
  panel_->setFolder("/somewhere");
  panel_->refresh();
  EXPECT_FALSE(panel_->scanning());
  panel_->show();
  settle();
  EXPECT_EQ(scans, 1);
}

TEST_F(LibraryTest, ALongLookShowsHowFarItIsAndCanBeStopped) {
  std::atomic<bool> cancelled = false;
  start([&](const auto&, const auto&, const CatalogSink& sink, const Progress& progress) {
    sink.listed(40);
    RecordingDetails details;
    details.path = "/x/a.dsa";
    sink.take(std::move(details));
    while (progress(0.25)) {
    }
    cancelled = true;
    throw Cancelled();
    return CatalogReport{};
  });
  panel_->setFolder("/x");
  ASSERT_TRUE(QTest::qWaitFor([&] { return names().size() == 1; }, 10000));
  auto* bar = find<QProgressBar>("libraryProgress");
  EXPECT_TRUE(QTest::qWaitFor([&] { return bar->value() == 250; }, 10000));
  EXPECT_TRUE(bar->isVisible());
  EXPECT_EQ(find<QLabel>("librarySummary")->text(), "1 of 40 read");
  find<QToolButton>("libraryStop")->click();
  EXPECT_FALSE(bar->isVisible());
  EXPECT_EQ(names().size(), 1) << "what was found stays";
  EXPECT_EQ(find<QLabel>("librarySummary")->text(),
            "reading stopped: 1 recording so far (Refresh reads all)");
  search("a");
  EXPECT_EQ(find<QLabel>("librarySummary")->text(),
            "reading stopped: 1 of 1 recording so far (Refresh reads all)");
  search("nowhere");
  EXPECT_TRUE(empty().contains("Reading stopped: 1 recording so far. Refresh (F5) reads"))
      << empty().toStdString();
  EXPECT_TRUE(QTest::qWaitFor([&] { return cancelled.load(); }, 10000));
}

TEST_F(LibraryTest, ASecondReturnAfterTheChoiceOfAFolderStopsNothing) {
  std::atomic<bool> goOn = true;
  start([&](const auto&, const auto&, const auto&, const Progress& progress) {
    while (goOn)
      if (!progress(0.25)) throw Cancelled();
    return CatalogReport{};
  });
  ask_.folders = {"/x"};
  auto* choose = find<QPushButton>("libraryEmptyButton");
  choose->setFocus();
  QTest::keyClick(choose, Qt::Key_Return);
  ASSERT_TRUE(panel_->scanning());
  EXPECT_TRUE(find<QLineEdit>("librarySearch")->hasFocus());
  for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Space})
    QTest::keyClick(QApplication::focusWidget(), key);
  EXPECT_TRUE(panel_->scanning());
  goOn = false;
  settle();
}

TEST(LibraryLength, IsReadAtAGlance) {
  EXPECT_EQ(lengthText(0.0), "0.0 s");
  EXPECT_EQ(lengthText(59.94), "59.9 s");
  EXPECT_EQ(lengthText(59.96), "1 min 00 s");
  EXPECT_EQ(lengthText(185.0), "3 min 05 s");
  EXPECT_EQ(lengthText(3599.6), "1 h 00 min");
  EXPECT_EQ(lengthText(86400.0), "24 h 00 min");
}

}  // namespace
}  // namespace palpate::gui::library_test
