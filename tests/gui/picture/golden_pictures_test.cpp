// Pictures of the window against pictures that people have looked at (tests/gui/golden): a tenth of
// their size, so that fonts don't matter, and with a tolerance. PALPATE_RENEW_GOLDEN=1 writes them
// anew, to be looked at before they are committed.
#include <QImage>
#include <cstdlib>

#include <palpate/emulator/synthetic_profile.h>
#include <palpate/recording/recording.h>

#include "gui/hand3d/hand3d_feature.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/event_rows.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"

namespace palpate::gui::golden_pictures_test {
namespace {

constexpr int kSmaller = 10;
constexpr int kNear = 24;           // of 255, per colour
constexpr double kMaxOther = 0.03;  // part of the pixels that may be further off

QImage small(const QImage& image) {
  return image
      .scaled(image.width() / kSmaller,
              image.height() / kSmaller,
              Qt::IgnoreAspectRatio,
              Qt::SmoothTransformation)
      .convertToFormat(QImage::Format_RGB32);
}

double partThatDiffers(const QImage& a, const QImage& b) {
  int other = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      if (std::abs(qRed(p) - qRed(q)) > kNear || std::abs(qGreen(p) - qGreen(q)) > kNear ||
          std::abs(qBlue(p) - qBlue(q)) > kNear)
        ++other;
    }
  return static_cast<double>(other) / (a.width() * a.height());
}

void compare(const QImage& picture, const std::string& name) {
  const QImage now = small(picture);
  const QString path = QString(PALPATE_GOLDEN_PICTURES) + "/" + QString::fromStdString(name);
  if (std::getenv("PALPATE_RENEW_GOLDEN")) {
    ASSERT_TRUE(now.save(path));
  }
  const QImage golden = QImage(path).convertToFormat(QImage::Format_RGB32);
  ASSERT_FALSE(golden.isNull()) << path.toStdString();
  ASSERT_EQ(now.size(), golden.size());
  EXPECT_LE(partThatDiffers(now, golden), kMaxOther) << name;
}

class GoldenPicturesTest : public WindowTest {
 protected:
  GoldenPicturesTest() {
    environment_.read = asRecording([](const std::filesystem::path&, const Progress&) {
      return synthesize({.durationS = 12.0, .grasps = 3});
    });
  }
  void show(const QSize& size, ThemeChoice theme) {
    window().state().appearance.setTheme(theme);
    window().setFixedSize(size);
    open({"any.dsa"});
    playback().seekFrame(
        window().state().displayed.unfilteredRecording()->table.frameOfLargestSum());
    window().feature<TimelineFeature>().panel().chart().setSelection(TimeSpan{4.0, 6.0});
    for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();
  }
};

TEST_F(GoldenPicturesTest, HeatMapsDark) {
  show({1440, 900}, ThemeChoice::kDark);
  trigger("handShown");  // the hand in 3-D stands beside them
  window().feature<MatricesFeature>().panel().view().setFixedSize(945, 525);
  QCoreApplication::processEvents();
  compare(window().feature<MatricesFeature>().panel().view().grab().toImage(), "matrices_dark.png");
}

TEST_F(GoldenPicturesTest, TimelineLight) {
  show({1440, 900}, ThemeChoice::kLight);
  window().feature<TimelineFeature>().panel().setFixedHeight(175);
  QCoreApplication::processEvents();
  compare(window().feature<TimelineFeature>().panel().grab().toImage(), "timeline_light.png");
}

TEST_F(GoldenPicturesTest, HandDark) {
  show({1440, 900}, ThemeChoice::kDark);
  window().feature<Hand3dFeature>().panel().view().setFixedSize(600, 600);
  compare(window().feature<Hand3dFeature>().panel().view().grab().toImage(), "hand_dark.png");
}

TEST_F(GoldenPicturesTest, HandAsBarsLight) {
  show({1440, 900}, ThemeChoice::kLight);
  choose("taxelShapes", 1);
  trigger("axes");
  window().feature<Hand3dFeature>().panel().view().setFixedSize(600, 600);
  compare(window().feature<Hand3dFeature>().panel().view().grab().toImage(), "hand_bars_light.png");
}

TEST_F(GoldenPicturesTest, AnotherPictureIsTold) {
  show({1440, 900}, ThemeChoice::kDark);
  const QImage before = small(window().feature<MatricesFeature>().panel().view().grab().toImage());
  playback().seekFrame(0);
  QCoreApplication::processEvents();
  EXPECT_GT(partThatDiffers(
                small(window().feature<MatricesFeature>().panel().view().grab().toImage()), before),
            kMaxOther);
}

}  // namespace
}  // namespace palpate::gui::golden_pictures_test
