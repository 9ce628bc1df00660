// A movie of what the real window shows.
#include <string_view>

#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/testing/window_fixture.h"
#include "gui/widgets/status_strip.h"
#include "testing/fake_ffmpeg.h"

namespace palpate::gui::movie_window_test {
namespace {

using testing::FakeFfmpeg;

class MovieWindowTest : public WindowTest {
 protected:
  MovieWindowTest() { open({"good.dsa"}); }
  ExportController& exportController() {
    return window().feature<ExportFeature>().exportController();
  }
  QString notice() { return find<StatusStrip>("statusStrip")->status().notice; }
  ExportRequest request() {
    ExportRequest request;
    request.view = "Matrices";
    request.form = ExportFormat::kMovie;
    request.frames = ExportFrames::kAll;
    request.folder = QString::fromStdString(folder_.path().string());
    request.name = "good";
    request.movieHeightPx = 480;
    return request;
  }
  void wait() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !exportController().busy(); }, 20'000));
  }
  bool isThere() const { return std::filesystem::exists(folder_ / "good.mp4"); }
};

// Twenty frames, 50 ms apart.
TEST_F(MovieWindowTest, TheHeatMapsAsTheyCame) {
  const FakeFfmpeg fake;
  ExportRequest asked = request();
  asked.preset = kOwnPreset;
  asked.sizeMm = {100.0, 75.0};
  exportController().write(asked);
  wait();
  EXPECT_EQ(bannerText(), "");
  EXPECT_EQ(testing::readFile(folder_ / "good.mp4"), "whole");
  EXPECT_EQ(fake.wordAfter("-s"), "640x480");
  const std::string pixels = testing::readFile(fake.file("pixels"));
  constexpr std::size_t kPicture = 640 * 480 * 4;
  ASSERT_EQ(pixels.size(), 30u * kPicture) << "a second";
  // The middle of picture k is at (k + 1/2) / 30 s; each frame, with its caption, looks different.
  const auto picture = [&](std::size_t k) {
    return std::string_view(pixels).substr(k * kPicture, kPicture);
  };
  const auto frameOf = [](std::size_t k) { return (2 * k + 1) * 20 / 60; };
  for (std::size_t k = 1; k < 30; ++k)
    EXPECT_EQ(picture(k) == picture(k - 1), frameOf(k) == frameOf(k - 1)) << k;
}

TEST_F(MovieWindowTest, OnceMoreTakesTheNextFreeName) {
  const FakeFfmpeg fake;
  exportController().ask = [&](const ExportRequest&) { return request(); };
  press(Qt::Key_E, Qt::ControlModifier);
  wait();
  press(Qt::Key_E, Qt::ControlModifier | Qt::ShiftModifier);
  wait();
  EXPECT_TRUE(isThere());
  EXPECT_EQ(testing::readFile(folder_ / "good_2.mp4"), "whole");
}

TEST_F(MovieWindowTest, EscapeCancelsIt) {
  const FakeFfmpeg fake("sleep 1000");
  exportController().write(request());
  ASSERT_TRUE(QTest::qWaitFor([&] { return fake.wasCalled(); }, 20'000));
  press(Qt::Key_Escape);
  wait();
  EXPECT_EQ(notice(), "cancelled: good.mp4 was not written");
  EXPECT_FALSE(isThere());
  EXPECT_FALSE(fake.runs("pid"));
}

TEST_F(MovieWindowTest, ClosingTheWindowEndsIt) {
  const FakeFfmpeg fake("cat > /dev/null; sleep 1000");
  exportController().write(request());
  ASSERT_TRUE(QTest::qWaitFor([&] { return fake.wasCalled(); }, 20'000));
  window_.reset();
  EXPECT_FALSE(isThere());
  EXPECT_FALSE(fake.runs("pid"));
}

TEST_F(MovieWindowTest, WhatFfmpegSaidIsOnTheBanner) {
  const FakeFfmpeg fake("cat > /dev/null; echo 'No space left on device' >&2; exit 1");
  exportController().write(request());
  wait();
  EXPECT_TRUE(bannerText().contains("good.mp4")) << bannerText().toStdString();
  EXPECT_TRUE(bannerText().contains("No space left on device")) << bannerText().toStdString();
  EXPECT_FALSE(isThere());
}

TEST_F(MovieWindowTest, WhereFfmpegIsGoneAPictureIsSuggested) {
  const FakeFfmpeg fake;
  exportController().ask = [&](const ExportRequest&) { return request(); };
  exportController().exportNow();
  wait();
  EXPECT_EQ(exportController().suggestion().form, ExportFormat::kMovie);
  EXPECT_EQ(exportController().suggestion().name, "good");
  qputenv("PALPATE_FFMPEG", "/no/such/ffmpeg");
  EXPECT_EQ(exportController().suggestion().form, ExportFormat::kPng);
  ExportRequest again = request();
  again.name = "other";
  exportController().write(again);
  wait();
  EXPECT_TRUE(bannerText().contains("/no/such/ffmpeg")) << bannerText().toStdString();
}

}  // namespace
}  // namespace palpate::gui::movie_window_test
