#include "gui/export/export_dialog.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include "gui/appearance/text_size.h"
#include "gui/export/export_place.h"
#include "gui/export/export_preview.h"
#include "gui/testing/fake_ask.h"
#include "testing/fake_ffmpeg.h"
#include "testing/testing.h"

namespace palpate::gui::export_dialog_test {
namespace {

// Two views: a picture of frames with a table, and a table alone.
class ExportDialogTest : public ::testing::Test {
 protected:
  ExportDialogTest() {
    pictures_.name = "Pictures";
    pictures_.isThere = [] { return true; };
    pictures_.fileName = [] { return "ball_frame_00007"; };
    pictures_.size = [] { return QSizeF(800, 400); };
    pictures_.paint = [this](QPainter& painter, const PictureLook& look) {
      look_ = look;
      painter.fillRect(QRectF(QPointF(), look.size), look.forPrint ? Qt::white : Qt::black);
    };
    pictures_.tables = [] { return tables(); };
    pictures_.framePictures = [this] {
      FramePictures frames;
      frames.fileName = "ball";
      frames.numFrames = 200;
      frames.selected = selected_;
      frames.timeUs = [](std::size_t frame) { return static_cast<std::int64_t>(frame) * 50'000; };
      frames.painter = [](const PictureLook&) { return [](QPainter&, std::size_t) {}; };
      return std::optional(frames);
    };
    rows_.name = "Rows";
    rows_.isThere = [] { return true; };
    rows_.fileName = [] { return "ball_rows"; };
    rows_.tables = [] { return tables(); };
    request_.view = "Pictures";
    request_.folder = QString::fromStdString(folder_.path().string());
    request_.name = "ball_frame_00007";
  }
  static std::vector<ExportedTable> tables() {
    const auto numbers = [](std::size_t rows) {
      return TextTable{.header = {"n"}, .numRows = rows, .row = [](std::size_t row) {
                         return std::vector<std::string>{std::to_string(row)};
                       }};
    };
    return {{"seen", [=] { return numbers(3); }}, {"all", [=] { return numbers(1000); }}};
  }
  ExportDialog& open() {
    dialog_ = std::make_unique<ExportDialog>(
        std::vector<const ExportedView*>{&pictures_, &rows_}, request_, ask_);
    dialog_->show();
    QCoreApplication::processEvents();
    return *dialog_;
  }
  template <class Widget>
  Widget* find(const char* name) {
    return dialog_->findChild<Widget*>(name);
  }
  // The preview paints the picture when it is painted itself.
  const PictureLook& paintedLook() {
    find<ExportPreview>("exportPreview")->grab();
    return look_;
  }
  void click(const char* button) { find<QAbstractButton>(button)->click(); }
  QString summary() { return find<QLabel>("exportSummary")->text(); }
  bool canExport() { return find<QPushButton>("exportOk")->isEnabled(); }

  testing::TemporaryFolder folder_;
  ExportedView pictures_;
  ExportedView rows_;
  ExportRequest request_;
  std::optional<FrameSpan> selected_ = FrameSpan{10, 29};
  PictureLook look_;
  FakeAsk ask_;
  std::unique_ptr<ExportDialog> dialog_;
};

TEST_F(ExportDialogTest, AsksForWhatWasSuggested) {
  request_.form = ExportFormat::kPdf;
  request_.preset = 1;
  request_.sizeMm = {85.0, 50.0};
  request_.textPt = 6.5;
  request_.forPrint = false;
  request_.titled = false;
  request_.table = "all";
  open();
  EXPECT_EQ(dialog_->request(), request_);
  EXPECT_TRUE(canExport());
}

TEST_F(ExportDialogTest, APresetSetsSizeAndTextInProportionToTheView) {
  open();
  EXPECT_FALSE(find<QDoubleSpinBox>("exportWidth")->isVisible()) << "as on screen";
  auto* preset = find<QComboBox>("exportPreset");
  preset->setCurrentIndex(preset->findText("double column, 174 mm"));
  EXPECT_EQ(dialog_->request().sizeMm, QSizeF(174.0, 87.0)) << "the view is 800 x 400";
  EXPECT_TRUE(find<QDoubleSpinBox>("exportWidth")->isVisible());
  preset->setCurrentIndex(preset->findText("slide 16:9"));
  EXPECT_EQ(dialog_->request().sizeMm, QSizeF(254.0, 143.0));
  EXPECT_EQ(paintedLook().textUnits, 32) << "16 pt in halves";
  EXPECT_NEAR(look_.size.width(), 254.0 / 25.4 * 144.0, 1e-9);
}

TEST_F(ExportDialogTest, AWidthOfOnesOwnIsAnOwnSize) {
  request_.preset = 1;
  request_.sizeMm = {85.0, 50.0};
  open();
  find<QDoubleSpinBox>("exportHeight")->setValue(40.0);
  EXPECT_EQ(dialog_->request().preset, 1) << "a column may have any height";
  find<QDoubleSpinBox>("exportWidth")->setValue(100.0);
  EXPECT_EQ(dialog_->request().preset, kOwnPreset);
  EXPECT_EQ(dialog_->request().sizeMm, QSizeF(100.0, 40.0));
}

TEST_F(ExportDialogTest, EachViewHasTheSizeOfItsLastExport) {
  request_.preset = 1;
  request_.sizeMm = {85.0, 42.5};
  request_.sizes["Rows"] = {kOwnPreset, {60.0, 55.0}, 9.0};
  open();
  auto* view = find<QComboBox>("exportView");
  view->setCurrentIndex(view->findText("Rows"));
  EXPECT_EQ(dialog_->request().size(), request_.sizes["Rows"]);
  view->setCurrentIndex(view->findText("Pictures"));
  EXPECT_EQ(dialog_->request().size(), request_.size());
  // What is chosen now is for whichever view is exported.
  auto* preset = find<QComboBox>("exportPreset");
  preset->setCurrentIndex(preset->findText("double column, 174 mm"));
  view->setCurrentIndex(view->findText("Rows"));
  EXPECT_EQ(dialog_->request().preset, 3);
}

TEST_F(ExportDialogTest, SaysPixelsMillimetresAndBytes) {
  request_.preset = kOwnPreset;
  request_.sizeMm = {127.0, 63.5};  // 5 x 2.5 inches
  request_.dpi = 300;
  open();
  EXPECT_TRUE(summary().startsWith("1500 × 750 px · 127.0 × 63.5 mm")) << summary().toStdString();
  ASSERT_TRUE(QTest::qWaitFor([&] { return summary().contains("about"); }, 10'000));
  auto* dpi = find<QComboBox>("exportDpi");
  dpi->setCurrentIndex(dpi->findText("600 dpi"));
  EXPECT_TRUE(summary().startsWith("3000 × 1500 px")) << summary().toStdString();
  click("exportFormSVG");
  EXPECT_FALSE(dpi->isVisible());
  EXPECT_TRUE(summary().startsWith("127.0 × 63.5 mm")) << summary().toStdString();
}

TEST_F(ExportDialogTest, ColoursOfPaperOrScreen) {
  open();
  EXPECT_TRUE(paintedLook().forPrint);
  find<QComboBox>("exportColors")->setCurrentIndex(1);
  EXPECT_FALSE(paintedLook().forPrint);
  EXPECT_FALSE(dialog_->request().forPrint);
  find<QCheckBox>("exportTitled")->setChecked(false);
  EXPECT_FALSE(paintedLook().titled);
}

TEST_F(ExportDialogTest, ASeriesGoesIntoAFolderOfItsName) {
  open();
  auto* frames = find<QComboBox>("exportFrames");
  ASSERT_EQ(frames->count(), 3);
  EXPECT_EQ(frames->itemText(1), "the selected 20, 10 to 29");
  frames->setCurrentIndex(1);
  EXPECT_EQ(find<QLineEdit>("exportName")->text(), "ball");
  EXPECT_TRUE(summary().contains("20 pictures")) << summary().toStdString();
  EXPECT_TRUE(find<QLabel>("exportTarget")->text().endsWith("a new folder"));
  EXPECT_TRUE(canExport());
  std::filesystem::create_directory(folder_ / "ball");
  testing::writeFile(folder_ / "ball" / "ball_00029.png", "");
  find<QLineEdit>("exportName")->setText("ball ");  // looks again
  EXPECT_FALSE(canExport());
  EXPECT_TRUE(dialog_->problem().contains("1 of these pictures"))
      << dialog_->problem().toStdString();
  click("exportReplace");
  EXPECT_TRUE(canExport());
  click("exportFormSVG");
  EXPECT_FALSE(frames->isVisible()) << "a series is of PNG";
  EXPECT_EQ(find<QLineEdit>("exportName")->text(), "ball_frame_00007");
}

TEST_F(ExportDialogTest, WithoutASelectionNoneIsOffered) {
  selected_.reset();
  open();
  EXPECT_EQ(find<QComboBox>("exportFrames")->count(), 2);
}

TEST_F(ExportDialogTest, AMovieIsOfManyFrames) {
  const testing::FakeFfmpeg fake;
  open();
  click("exportFormMP4");
  auto* frames = find<QComboBox>("exportFrames");
  ASSERT_EQ(frames->count(), 2) << "not of the one that is shown";
  EXPECT_EQ(frames->itemText(0), "the selected 20, 10 to 29");
  EXPECT_EQ(find<QLineEdit>("exportName")->text(), "ball");
  EXPECT_EQ(find<QLabel>("exportEnding")->text(), ".mp4");
  EXPECT_FALSE(find<QComboBox>("exportDpi")->isVisible());
  EXPECT_TRUE(summary().startsWith("2160 × 1080 px")) << summary().toStdString();
  // 20 frames of 50 ms.
  ASSERT_TRUE(QTest::qWaitFor([&] { return summary().endsWith("1.0 s · 30 pictures"); }, 10'000))
      << summary().toStdString();
  auto* speed = find<QComboBox>("exportSpeed");
  speed->setCurrentIndex(speed->findText("0.5×"));
  auto* rate = find<QComboBox>("exportRate");
  rate->setCurrentIndex(rate->findText("50 pictures/s"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return summary().endsWith("2.0 s · 100 pictures"); }, 10'000))
      << summary().toStdString();
  auto* height = find<QComboBox>("exportMovieHeight");
  height->setCurrentIndex(height->findText("720 px high"));
  EXPECT_TRUE(summary().startsWith("1440 × 720 px")) << summary().toStdString();
  const ExportRequest asked = dialog_->request();
  EXPECT_EQ(asked.form, ExportFormat::kMovie);
  EXPECT_EQ(asked.frames, ExportFrames::kSelected);
  EXPECT_EQ(asked.movieSpeed, 0.5);
  EXPECT_EQ(asked.moviePicturesPerS, 50);
  EXPECT_EQ(asked.movieHeightPx, 720);
  EXPECT_TRUE(canExport());
  click("exportFormPNG");
  EXPECT_EQ(dialog_->request().frames, ExportFrames::kShown) << "as before";
  EXPECT_FALSE(speed->isVisible());
  dialog_.reset();
  request_ = asked;
  EXPECT_EQ(open().request(), asked);
}

TEST_F(ExportDialogTest, ShortenedGapsOfAMovieAreSaid) {
  const testing::FakeFfmpeg fake;
  request_.form = ExportFormat::kMovie;
  const auto pictures = pictures_.framePictures;
  pictures_.framePictures = [pictures] {
    auto frames = pictures();
    frames->timeUs = [](std::size_t frame) {
      return static_cast<std::int64_t>(frame) * 50'000 + (frame < 20 ? 0 : 60'000'000);
    };
    return frames;
  };
  open();
  ASSERT_TRUE(QTest::qWaitFor([&] { return summary().endsWith("1 gap shortened"); }, 10'000))
      << summary().toStdString();
}

TEST_F(ExportDialogTest, WithoutFfmpegAMovieIsGreyAndSaysWhy) {
  const testing::FakeFfmpeg fake;
  qputenv("PALPATE_FFMPEG", "/no/such/ffmpeg");
  request_.form = ExportFormat::kMovie;
  open();
  EXPECT_FALSE(find<QToolButton>("exportFormMP4")->isEnabled());
  EXPECT_TRUE(find<QToolButton>("exportFormMP4")->toolTip().contains("/no/such/ffmpeg"));
  EXPECT_EQ(dialog_->request().form, ExportFormat::kPng);
  EXPECT_TRUE(canExport());
}

TEST_F(ExportDialogTest, AViewWithoutFramesHasNoMovie) {
  const testing::FakeFfmpeg fake;
  pictures_.framePictures = nullptr;
  open();
  EXPECT_FALSE(find<QToolButton>("exportFormMP4")->isEnabled());
  pictures_.framePictures = [] { return std::nullopt; };
  open();
  EXPECT_FALSE(find<QToolButton>("exportFormMP4")->isEnabled()) << "live";
  EXPECT_TRUE(find<QToolButton>("exportFormMP4")->toolTip().contains("recording"));
}

TEST_F(ExportDialogTest, ATableIsShownByItsFirstRows) {
  request_.form = ExportFormat::kCsv;
  open();
  EXPECT_FALSE(find<QComboBox>("exportPreset")->isVisible());
  find<ExportPreview>("exportPreview")->settle();
  EXPECT_TRUE(summary().startsWith("3 rows · about 8 B")) << summary().toStdString();  // n, 0, 1, 2
  auto* table = find<QComboBox>("exportTable");
  table->setCurrentIndex(table->findText("all"));
  EXPECT_EQ(dialog_->request().table, "all");
  EXPECT_TRUE(summary().startsWith("1000 rows")) << summary().toStdString();
}

TEST_F(ExportDialogTest, AViewWithoutPictureIsATable) {
  open();
  auto* view = find<QComboBox>("exportView");
  view->setCurrentIndex(view->findText("Rows"));
  EXPECT_FALSE(find<QToolButton>("exportFormPNG")->isEnabled());
  EXPECT_EQ(dialog_->request().form, ExportFormat::kCsv);
  EXPECT_EQ(find<QLineEdit>("exportName")->text(), "ball_rows");
}

TEST_F(ExportDialogTest, ANameThatWasTypedStays) {
  open();
  auto* name = find<QLineEdit>("exportName");
  name->selectAll();
  QTest::keyClicks(name, "figure 3");
  find<QComboBox>("exportFrames")->setCurrentIndex(2);
  EXPECT_EQ(name->text(), "figure 3");
  EXPECT_TRUE(dialog_->request().nameIsOwn);
}

TEST_F(ExportDialogTest, ANameOfAnEarlierExportIsForItsViewOnly) {
  request_.name = "figure 3";
  request_.nameIsOwn = true;
  open();
  auto* name = find<QLineEdit>("exportName");
  EXPECT_EQ(name->text(), "figure 3");
  auto* view = find<QComboBox>("exportView");
  view->setCurrentIndex(view->findText("Rows"));
  EXPECT_EQ(name->text(), "ball_rows");
  EXPECT_FALSE(dialog_->request().nameIsOwn);
  name->selectAll();
  QTest::keyClicks(name, "mine");
  view->setCurrentIndex(view->findText("Pictures"));
  EXPECT_EQ(name->text(), "mine") << "it was typed for this export";
}

TEST_F(ExportDialogTest, WhatStandsInTheWayIsSaid) {
  open();
  auto* name = find<QLineEdit>("exportName");
  name->setText("");
  EXPECT_FALSE(canExport());
  EXPECT_EQ(dialog_->problem(), "Enter a name.");
  name->setText("a/b");
  EXPECT_FALSE(canExport());
  name->setText("a");
  EXPECT_TRUE(canExport());
  EXPECT_FALSE(find<QCheckBox>("exportReplace")->isVisible());
  testing::writeFile(folder_ / "a.png", "precious");
  dialog_->accept();
  EXPECT_TRUE(dialog_->isVisible()) << "a file that came since";
  EXPECT_TRUE(find<QCheckBox>("exportReplace")->isVisible());
  click("exportReplace");
  EXPECT_TRUE(canExport());
  find<QLineEdit>("exportFolder")->setText("/no/such/folder");
  EXPECT_FALSE(canExport());
  EXPECT_TRUE(find<QLabel>("exportProblem")->text().contains("/no/such/folder"));
  find<QLineEdit>("exportFolder")->setText(request_.folder);
  find<QComboBox>("exportPreset")->setCurrentIndex(kOwnPreset);
  find<QDoubleSpinBox>("exportWidth")->setValue(1200.0);
  auto* dpi = find<QComboBox>("exportDpi");
  dpi->setCurrentIndex(dpi->findText("600 dpi"));
  EXPECT_TRUE(dialog_->problem().contains("pixels are too many")) << "28346 wide";
}

TEST_F(ExportDialogTest, BrowseBeginsWhereTheFolderIs) {
  request_.folder = QString::fromStdString((folder_ / "gone").string());
  open();
  ask_.folders = {"/chosen"};
  click("exportBrowse");
  EXPECT_EQ(ask_.folders.began, QStringList(QString::fromStdString(folder_.path().string())));
  EXPECT_EQ(find<QLineEdit>("exportFolder")->text(), "/chosen");
}

TEST_F(ExportDialogTest, LargerTextHasRoom) {
  applyTextPt(15);
  open();
  for (const QToolButton* button :
       find<QWidget>("exportFormPNG")->parentWidget()->findChildren<QToolButton*>())
    EXPECT_GE(button->width(), button->sizeHint().width()) << button->text().toStdString();
  const auto* colors = find<QComboBox>("exportColors");
  EXPECT_GE(colors->width(), colors->sizeHint().width());
  applyTextPt(0);
}

TEST_F(ExportDialogTest, TheFolderIsWrittenAsFarAsThereIsRoom) {
  open();
  const auto* target = find<QLabel>("exportTarget");
  const QString whole = "in " + request_.folder;
  ASSERT_LT(target->fontMetrics().horizontalAdvance(whole), target->width());
  EXPECT_EQ(target->text(), whole);
}

TEST_F(ExportDialogTest, ThePreviewIsThePicture) {
  request_.forPrint = false;
  open();
  const auto* preview = find<ExportPreview>("exportPreview");
  const QImage seen =
      dialog_->grab(QRect(preview->mapTo(dialog_.get(), QPoint()), preview->size())).toImage();
  EXPECT_EQ(seen.pixelColor(seen.rect().center()), QColor(Qt::black));
  find<QComboBox>("exportColors")->setCurrentIndex(0);
  const QImage printed =
      dialog_->grab(QRect(preview->mapTo(dialog_.get(), QPoint()), preview->size())).toImage();
  EXPECT_EQ(printed.pixelColor(printed.rect().center()), QColor(Qt::white));
}

}  // namespace
}  // namespace palpate::gui::export_dialog_test
