// The import in the window: the action asks, a worker writes, the recording opens.
#include <QAction>
#include <QTimer>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/recording.h"

#include "gui/import/import_dialog.h"
#include "gui/import/import_request.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::import_window_test {
namespace {

class ImportWindowTest : public WindowTest {
 protected:
  // A table of the flat pad; in line 5 `bad`.
  std::string table(const char* name, int rows, const std::string& bad = "") {
    std::string text;
    for (int row = 0; row < rows; ++row) {
      text += std::to_string(row * 10);
      for (int i = 0; i < 256; ++i) text += "," + std::to_string((row + i) % 90);
      text += "\n" + (row == 3 ? bad : "");
    }
    testing::writeFile(folder_ / name, text);
    return folder_ / name;
  }
  // Triggers the action, and answers its dialog with a file.
  void import(const std::string& data) {
    QTimer timer;
    bool accepted = false;
    QObject::connect(&timer, &QTimer::timeout, [&] {
      auto* dialog = qobject_cast<ImportDialog*>(QApplication::activeModalWidget());
      if (!dialog) return;
      if (dialog->request().data.toStdString() != data) {
        dialog->setHand("flat_pad_16x16");
        dialog->setData(QString::fromStdString(data));
      }
      if (!dialog->busy() && dialog->problem().isEmpty() && !accepted) {
        accepted = true;
        dialog->accept();
      }
    });
    timer.start(5);
    actions().at("importTable")->trigger();
    EXPECT_TRUE(accepted);
  }
};

TEST_F(ImportWindowTest, TheRecordingIsShownAndTheChoicesAreRemembered) {
  import(table("good_pad.csv", 20));
  const std::string out = folder_ / "good_pad.palpate";
  ASSERT_TRUE(QTest::qWaitFor([&] { return std::filesystem::exists(out); }, 30'000));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return window().state().messages.flashed().contains("(20 frames)"); }, 30'000));
  EXPECT_EQ(openRecording(out).numFrames(), 20u);
  EXPECT_EQ(loadImportRequest(window().state().settings).hand, "flat_pad_16x16");
}

// Another process reads it, so that it may be damaged, also while a hand moves.
TEST(ImportRequest, DamagedHdf5IsAProblemOfOneLine) {
  const testing::TemporaryFolder folder;
  for (const std::size_t userBlock : {0u, 512u}) {
    testing::writeFile(folder / "a.h5",
                       std::string(userBlock, ' ') + "\x89HDF\r\n\x1a\n" + std::string(600, '\0'));
    ImportRequest request;
    request.data = QString::fromStdString(folder / "a.h5");
    request.hand = "flat_pad_16x16";
    request.out = QString::fromStdString(folder / "a.palpate");
    const auto folders = handFolders(testing::dataFolder());
    EXPECT_TRUE(lookAtImport(request, folders).problem.contains("can't be opened as HDF5"));
    EXPECT_THROW(runImport(request, folders, {}), FormatError);
  }
}

TEST_F(ImportWindowTest, WhatWasRefusedStaysInTheBanner) {
  import(table("good_bad.csv", 20, "15,oops\n"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return bannerText().contains("1 row refused"); }, 30'000))
      << bannerText().toStdString();
  EXPECT_TRUE(bannerText().contains("line 5 has 2 cells instead of 257"));
}

TEST_F(ImportWindowTest, AnImportTakesAnEarlierFailureAway) {
  open({"bad.dsa"});
  ASSERT_NE(bannerText(), "");
  import(table("good_pad.csv", 20));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return window().state().messages.flashed().contains("(20 frames)"); }, 30'000));
  waitUntilOpened();
  EXPECT_EQ(bannerText(), "");
}

TEST_F(ImportWindowTest, EscapeCancelsAndNothingIsWritten) {
  import(table("good_long.csv", 20'000));
  press(Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window().state().messages.flashed().contains("cancelled"); }, 60'000));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "good_long.palpate"));
}

}  // namespace
}  // namespace palpate::gui::import_window_test
