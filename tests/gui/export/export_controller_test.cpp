// Taking away what the real window shows.
#include "gui/export/export_controller.h"

#include <QApplication>
#include <QClipboard>
#include <QElapsedTimer>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <cmath>
#include <latch>
#include <memory>
#include <set>
#include <sstream>

#include "palpate/device/sdh2.h"
#include <palpate/core/number_text.h>

#include "gui/chart/chart_style.h"
#include "gui/export/export_feature.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/status_strip.h"
#include "testing/time_limit.h"

namespace palpate::gui::export_controller_test {
namespace {

std::vector<std::vector<std::string>> cellsOf(const std::string& text, char separator) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, separator);) rows.back().push_back(cell);
  }
  return rows;
}

class ExportControllerTest : public WindowTest {
 protected:
  ExportControllerTest() { open({"good.dsa"}); }
  ExportController& exportController() {
    return window().feature<ExportFeature>().exportController();
  }
  QString notice() { return find<StatusStrip>("statusStrip")->status().notice; }
  ExportRequest request(const QString& view, ExportFormat form, const QString& name) {
    ExportRequest request;
    request.view = view;
    request.form = form;
    request.folder = QString::fromStdString(folder_.path().string());
    request.name = name;
    return request;
  }
  void write(const ExportRequest& request) {
    exportController().write(request);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  }
  std::string written(const ExportRequest& request) {
    write(request);
    EXPECT_EQ(bannerText(), "");
    return testing::readFile(pathOf(request));
  }
  void clickInto(QWidget* widget) { QTest::mouseClick(widget, Qt::LeftButton); }
};

TEST_F(ExportControllerTest, EveryViewInEveryForm) {
  for (const char* view : {"Matrices", "Timeline", "Inspect"}) {
    ExportRequest asked = request(view, ExportFormat::kPng, view);
    asked.preset = 1;
    asked.sizeMm = {85.0, 60.0};
    asked.dpi = 300;
    write(asked);
    const QImage image(QString::fromStdString(pathOf(asked).string()));
    EXPECT_EQ(image.size(), QSize(1004, 709)) << view;  // 85 and 60 mm at 300 dpi
    EXPECT_EQ(image.dotsPerMeterX(), 11811) << view;
    std::set<QRgb> colors;
    for (int y = 0; y < image.height(); y += 2)
      for (int x = 0; x < image.width(); x += 2) colors.insert(image.pixel(x, y));
    EXPECT_GT(colors.size(), 8u) << view << " isn't empty";
    EXPECT_EQ(image.pixelColor(1, 1), QColor(Qt::white)) << view;

    asked.form = ExportFormat::kSvg;
    const std::string svg = written(asked);
    EXPECT_NE(svg.find("width=\"85mm\" height=\"60mm\""), std::string::npos) << view;
    EXPECT_NE(svg.find("good.dsa"), std::string::npos) << view;

    asked.form = ExportFormat::kPdf;
    const std::string pdf = written(asked);
    // 85 and 60 mm in points: 240.9 and 170.1.
    EXPECT_NE(pdf.find("/MediaBox [0 0 241.000000 170.000000]"), std::string::npos)
        << view << pdf.substr(pdf.find("/MediaBox"), 40);
    EXPECT_NE(pdf.find("/FontFile2"), std::string::npos) << view << ": fonts are embedded";
    asked.form = ExportFormat::kCsv;
    EXPECT_GT(cellsOf(written(asked), ',').size(), 1u) << view;
  }
}

TEST_F(ExportControllerTest, TheViewThatWasExportedOrClickedLastComesFirst) {
  std::vector<ExportRequest> suggested;
  QString chosen = "Timeline";
  exportController().ask = [&](const ExportRequest& suggestion) -> std::optional<ExportRequest> {
    suggested.push_back(suggestion);
    ExportRequest answer = suggestion;
    answer.view = chosen;
    answer.preset = 1;
    answer.sizeMm = {85.0, 55.0};
    answer.folder = QString::fromStdString(folder_.path().string());
    answer.name = "a";
    answer.replace = true;
    return answer;
  };
  const auto exported = [&] {
    exportController().exportNow();
    exportController().settle();
    QCoreApplication::processEvents();
    return suggested.back();
  };
  exported();
  EXPECT_EQ(exported().view, "Timeline");
  EXPECT_EQ(suggested.back().sizeMm, QSizeF(85.0, 55.0));
  clickInto(&window().feature<MatricesFeature>().panel().view());
  const ExportRequest ofMatrices = exported();
  EXPECT_EQ(ofMatrices.view, "Matrices");
  EXPECT_NE(ofMatrices.sizeMm, QSizeF(85.0, 55.0)) << "the height is that of the timeline";
  EXPECT_EQ(exported().view, "Timeline");
}

TEST_F(ExportControllerTest, TheTimelineIsCurvesAndTextNotPixels) {
  const std::string svg = written(request("Timeline", ExportFormat::kSvg, "a"));
  EXPECT_EQ(svg.find("<image"), std::string::npos);
  for (const char* part : {"time from the first frame in s", "counts", ">finger 0 distal<"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  const std::string ink = curvePen(1, false).color().name().toStdString();
  EXPECT_NE(svg.find("stroke=\"" + ink), std::string::npos) << "the curve, in ink";
}

TEST_F(ExportControllerTest, TheSeenRangeOfTheTimelineAsNumbers) {
  auto* chart = window().findChild<TimelineChart*>();
  chart->xAxis->setRange(0.19, 0.31);  // frames at 0.2, 0.25, 0.3 s
  ExportRequest asked = request("Timeline", ExportFormat::kCsv, "a");
  const auto rows = cellsOf(written(asked), ',');
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(
      rows[0],
      (std::vector<std::string>{"frame", "time_ms", "time_s", "finger 0 distal sum [counts]"}));
  EXPECT_EQ(rows[1], (std::vector<std::string>{"4", "1400000000200", "0.2", "50"}));
  EXPECT_EQ(rows[3], (std::vector<std::string>{"6", "1400000000300", "0.3", "70"}));
  asked.table = "the whole recording";
  asked.name = "b";
  EXPECT_EQ(cellsOf(written(asked), ',').size(), 21u);
  window().state().selection.setSpan(TimeSpan{0.49, 0.56});  // frames 10 and 11
  asked.table = "the selected range";
  asked.name = "c";
  const auto selected = cellsOf(written(asked), ',');
  ASSERT_EQ(selected.size(), 3u);
  EXPECT_EQ(selected[2][0], "11");
}

TEST_F(ExportControllerTest, NumbersReadBackToTheSameDoubles) {
  open({"rich.dsa"});
  playback().seekFrame(60);
  const auto rows = cellsOf(written(request("Inspect", ExportFormat::kCsv, "a")), ',');
  const auto expected =
      characteristicSignals(window().state().displayed.unfilteredRecording()->profile.frame(60));
  ASSERT_EQ(rows.size(), expected.size() + 2);
  EXPECT_EQ(rows[0][2], "mean [counts]");
  bool anyFraction = false;
  for (std::size_t m = 0; m < expected.size(); ++m) {
    EXPECT_EQ(parseDouble(rows[m + 1][2]), expected[m].mean);
    EXPECT_EQ(parseDouble(rows[m + 1][3]), expected[m].filteredMean);
    EXPECT_EQ(parseDouble(rows[m + 1][7]), expected[m].areaMm2);
    anyFraction = anyFraction || expected[m].mean != std::floor(expected[m].mean);
  }
  EXPECT_TRUE(anyFraction) << "whole numbers would prove nothing";
  EXPECT_EQ(rows.back()[0], "all");
}

TEST_F(ExportControllerTest, TheFramesTaxelsAsNumbers) {
  playback().seekFrame(7);
  const auto rows = cellsOf(written(request("Matrices", ExportFormat::kCsv, "a")), ',');
  ASSERT_EQ(rows.size(), sdh2().layout->numTaxels() + 1) << "those at rest, too";
  const std::vector<std::string> touched = {"7", "1400000000350", "1", "7", "2", "80"};
  EXPECT_EQ(std::count(rows.begin(), rows.end(), touched), 1);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row[5] == "0"; }),
            static_cast<std::ptrdiff_t>(sdh2().layout->numTaxels()) - 1);
}

TEST_F(ExportControllerTest, ASeriesOfTheSelectedRange) {
  window().state().selection.setSpan(TimeSpan{0.14, 0.36});  // frames 3 to 7
  ExportRequest asked = request("Matrices", ExportFormat::kPng, "good");
  asked.frames = ExportFrames::kSelected;
  asked.preset = 1;
  asked.sizeMm = {85.0, 60.0};
  asked.dpi = 150;
  write(asked);
  EXPECT_EQ(notice(), "written: 5 pictures in " + asked.folder + "/good");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "good"))
    names.insert(entry.path().filename().string());
  ASSERT_EQ(names.size(), 5u);
  EXPECT_EQ(*names.begin(), "good_00003.png");
  EXPECT_EQ(*names.rbegin(), "good_00007.png");
  // The picture of the series is the picture of the frame.
  playback().seekFrame(5);
  ExportRequest one = asked;
  one.frames = ExportFrames::kShown;
  one.name = "one";
  write(one);
  EXPECT_EQ(QImage(QString::fromStdString((folder_ / "one.png").string())),
            QImage(QString::fromStdString((folder_ / "good" / "good_00005.png").string())));
  // Once more: refused, and nothing is changed.
  write(asked);
  EXPECT_TRUE(bannerText().contains("5 of these pictures")) << bannerText().toStdString();
}

TEST_F(ExportControllerTest, EscapeCancelsASeries) {
  ExportRequest asked = request("Matrices", ExportFormat::kPng, "good");
  asked.frames = ExportFrames::kAll;
  asked.preset = kOwnPreset;
  asked.sizeMm = {300.0, 200.0};  // large enough to take its time
  QSignalSpy progressed(&exportController(), &ExportController::progressed);
  exportController().write(asked);
  ASSERT_TRUE(QTest::qWaitFor([&] { return progressed.size() >= 2; }, 20'000));
  press(Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "good")) {
    ++files;
    EXPECT_FALSE(QImage(QString::fromStdString(entry.path().string())).isNull());
  }
  EXPECT_GE(files, 1u);
  EXPECT_LT(files, 20u);
  EXPECT_TRUE(notice().startsWith(QString("cancelled: %1 of 20 pictures").arg(files)))
      << notice().toStdString();
}

TEST_F(ExportControllerTest, TheStripShowsProgressAndCancels) {
  ExportRequest asked = request("Matrices", ExportFormat::kPng, "good");
  asked.frames = ExportFrames::kAll;
  asked.preset = kOwnPreset;
  asked.sizeMm = {300.0, 200.0};
  exportController().write(asked);
  auto* bar = find<QProgressBar>("exportingProgress");
  ASSERT_TRUE(QTest::qWaitFor([&] { return bar->isVisible() && bar->value() > 0; }, 20'000));
  find<QPushButton>("cancelExporting")->click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  EXPECT_FALSE(bar->isVisible());
  EXPECT_TRUE(notice().startsWith("cancelled: ")) << notice().toStdString();
}

TEST_F(ExportControllerTest, ClosingTheWindowLeavesNoHalfFile) {
  ExportRequest asked = request("Matrices", ExportFormat::kPng, "good");
  asked.frames = ExportFrames::kAll;
  exportController().write(asked);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return std::filesystem::exists(folder_ / "good" / "good_00000.png"); }, 20'000));
  window_.reset();
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "good"))
    EXPECT_FALSE(QImage(QString::fromStdString(entry.path().string())).isNull());
}

TEST_F(ExportControllerTest, OnceMoreTakesTheNextFreeName) {
  int asked = 0;
  exportController().ask = [&](const ExportRequest& suggestion) {
    ++asked;
    ExportRequest chosen = suggestion;
    chosen.form = ExportFormat::kSvg;
    chosen.folder = QString::fromStdString(folder_.path().string());
    return chosen;
  };
  const auto wait = [&] {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  };
  const auto again = Qt::ControlModifier | Qt::ShiftModifier;
  playback().seekFrame(7);
  press(Qt::Key_E, again);  // nothing to repeat yet: asks
  wait();
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "good_frame_00007.svg"));
  press(Qt::Key_E, again);
  wait();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "good_frame_00007_2.svg"));
  press(Qt::Key_Right);
  press(Qt::Key_E, again);
  wait();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "good_frame_00008.svg"));
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(bannerText(), "");
  // As after a restart of the program.
  start();
  open({"good.dsa"});
  press(Qt::Key_E, again);
  wait();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "good_frame_00000.svg"));
}

TEST_F(ExportControllerTest, CopyTakesTheViewThatWasClickedInto) {
  press(Qt::Key_C, Qt::ControlModifier);
  exportController().settle();
  EXPECT_EQ(notice(), "copied: Matrices as picture");
  EXPECT_FALSE(QApplication::clipboard()->mimeData()->hasText());
  auto* chart = window().findChild<TimelineChart*>();
  clickInto(chart);
  press(Qt::Key_C, Qt::ControlModifier);
  exportController().settle();
  const QMimeData* data = QApplication::clipboard()->mimeData();
  EXPECT_TRUE(data->hasImage());
  EXPECT_EQ(QApplication::clipboard()->image().size(), 2 * chart->size());
  const auto tabbed = cellsOf(data->text().toStdString(), '\t');
  ASSERT_EQ(tabbed.size(), 21u);
  EXPECT_EQ(tabbed[20][3], "200");
  EXPECT_EQ(cellsOf(data->data("text/csv").toStdString(), ','), tabbed);
  EXPECT_EQ(notice(), "copied: Timeline as picture and 20 rows");
  clickInto(&window().feature<MatricesFeature>().panel().view());
  press(Qt::Key_C, Qt::ControlModifier);
  exportController().settle();
  EXPECT_EQ(notice(), "copied: Matrices as picture");
}

TEST_F(ExportControllerTest, CopyTableTakesTheRowsAlone) {
  playback().seekFrame(7);
  trigger("copyTable");
  exportController().settle();
  const QMimeData* data = QApplication::clipboard()->mimeData();
  EXPECT_FALSE(data->hasImage());
  EXPECT_EQ(cellsOf(data->text().toStdString(), '\t').size(), sdh2().layout->numTaxels() + 1);
  EXPECT_TRUE(notice().startsWith("copied: Matrices, taxels of the frame, "));
}

TEST_F(ExportControllerTest, ANameThatWasTypedIsForItsViewAndRecording) {
  clickInto(&window().feature<MatricesFeature>().panel().view());
  exportController().ask = [&](ExportRequest asked) -> std::optional<ExportRequest> {
    asked.form = ExportFormat::kCsv;
    asked.folder = QString::fromStdString(folder_.path().string());
    asked.name = "whole";
    asked.nameIsOwn = true;
    return asked;
  };
  exportController().exportNow();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  playback().seekFrame(3);
  EXPECT_EQ(exportController().suggestion().name, "whole") << "also of another frame";
  clickInto(window().findChild<TimelineChart*>());
  EXPECT_NE(exportController().suggestion().name, "whole");
  EXPECT_FALSE(exportController().suggestion().nameIsOwn);
  clickInto(&window().feature<MatricesFeature>().panel().view());
  EXPECT_EQ(exportController().suggestion().name, "whole");
  open({"good2.dsa"});
  EXPECT_EQ(exportController().suggestion().name, "good2_frame_00000");
  exportController().repeatLast();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "good2_frame_00000.csv"));
}

TEST_F(ExportControllerTest, NothingOpenNothingToTake) {
  start();
  EXPECT_FALSE(exportController().anything());
  int asked = 0;
  exportController().ask = [&](const ExportRequest&) {
    ++asked;
    return std::nullopt;
  };
  press(Qt::Key_E, Qt::ControlModifier);
  press(Qt::Key_E, Qt::ControlModifier | Qt::ShiftModifier);
  press(Qt::Key_C, Qt::ControlModifier);
  exportController().exportNow();
  exportController().repeatLast();
  exportController().copyPicture();
  exportController().copyTable();
  EXPECT_EQ(asked, 0);
  open({"empty.dsa"});
  EXPECT_FALSE(exportController().anything());
}

TEST_F(ExportControllerTest, AFolderThatMayNotBeWrittenIsSaid) {
  ExportRequest asked = request("Timeline", ExportFormat::kPdf, "a");
  asked.folder = "/proc";
  write(asked);
  EXPECT_NE(bannerText(), "");
  EXPECT_FALSE(std::filesystem::exists("/proc/a.pdf"));
}

// Window F13: of a long recording each row is read from its file.
TEST_F(ExportControllerTest, CopyingDoesNotWaitForTheRows) {
  const auto end = std::make_shared<std::latch>(1);
  ExportedView view;
  view.name = "Rows";
  view.isThere = [] { return true; };
  view.tables = [end] {
    const TextTable table{{"n"}, 2, [end](std::size_t row) {
                            end->wait();
                            return std::vector<std::string>{std::to_string(row)};
                          }};
    return std::vector<ExportedTable>{{"rows", [table] { return table; }}};
  };
  ExportController controller(window().state().settings, ask_, &window());
  controller.add(view);
  QSignalSpy said(&controller, &ExportController::said);
  QApplication::clipboard()->setText("before");
  controller.copyTable();
  EXPECT_EQ(QApplication::clipboard()->text(), "before");
  controller.cancel();
  EXPECT_FALSE(controller.busy()) << "Esc waits for nothing";
  controller.copyTable();
  end->count_down();
  controller.settle();
  EXPECT_EQ(QApplication::clipboard()->text(), "n\n0\n1\n");
  ASSERT_EQ(said.count(), 2);
  EXPECT_EQ(said[0][0].toString(), "copying was cancelled");
  EXPECT_EQ(said[1][0].toString(), "copied: Rows, rows, 2 rows");
}

TEST_F(ExportControllerTest, MakingThePictureDoesntBlockTheWindow) {
  ExportRequest asked = request("Timeline", ExportFormat::kPng, "a");
  asked.preset = 3;
  asked.sizeMm = {174.0, 80.0};
  asked.dpi = 600;
  QElapsedTimer timer;
  timer.start();
  exportController().write(asked);
  const qint64 blockedMs = timer.elapsed();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  EXPECT_LT(blockedMs, testing::timeLimit<qint64>(50));
}

}  // namespace
}  // namespace palpate::gui::export_controller_test
