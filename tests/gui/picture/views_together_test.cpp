// Several views in one picture or movie.
#include "gui/picture/views_together.h"

#include <QImage>
#include <QPainter>

#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::views_together_test {
namespace {

TEST(ViewsTogether, AreArrangedAsOnTheScreen) {
  // Two beside each other, a lower one over the whole width; 30 px of other things between.
  const Arrangement found = arrangementOf(
      {QRectF(0, 100, 400, 500), QRectF(0, 630, 1000, 250), QRectF(410, 110, 600, 480)});
  EXPECT_EQ(found.size, QSizeF(1000, 750));
  ASSERT_EQ(found.places.size(), 3u);
  EXPECT_EQ(found.places[0], QRectF(0.0, 0.0, 0.4, 500.0 / 750.0));
  EXPECT_EQ(found.places[2], QRectF(0.4, 0.0, 0.6, 500.0 / 750.0));
  EXPECT_EQ(found.places[1], QRectF(0.0, 500.0 / 750.0, 1.0, 250.0 / 750.0));
  EXPECT_TRUE(arrangementOf({}).places.empty());
}

// A chart in a low dock is higher on paper than on the screen.
TEST(ViewsTogether, HeightsInThePictureMayDiffer) {
  const Arrangement found =
      arrangementOf({QRectF(0, 0, 1000, 400), QRectF(0, 430, 1000, 100)}, {400, 500});
  EXPECT_EQ(found.size, QSizeF(1000, 900));
  EXPECT_EQ(found.places[0], QRectF(0.0, 0.0, 1.0, 400.0 / 900.0));
  EXPECT_EQ(found.places[1], QRectF(0.0, 400.0 / 900.0, 1.0, 500.0 / 900.0));
}

// A part that fills its place with a colour, and one row of it with black for each frame.
FramePictures filled(const QColor& color, std::vector<PictureLook>* looks) {
  FramePictures pictures;
  pictures.numFrames = 3;
  pictures.hasColorBar = color != QColor(Qt::green);
  pictures.painter = [color, looks](const PictureLook& look) {
    looks->push_back(look);
    return [color, size = look.size](QPainter& painter, std::size_t frame) {
      painter.fillRect(QRectF(-1000, -1000, 3000, 3000), color);
      painter.fillRect(QRectF(0, static_cast<double>(frame), size.width(), 1), Qt::black);
    };
  };
  return pictures;
}

TEST(ViewsTogether, EachPartIsPaintedInItsPlace) {
  std::vector<PictureLook> looks;
  const FramePictures all = framesTogether({filled(Qt::red, &looks), filled(Qt::blue, &looks)},
                                           {QRectF(0, 0, 0.5, 0.5), QRectF(0.5, 0.5, 0.5, 0.5)},
                                           Qt::gray);
  PictureLook look;
  look.size = QSizeF(100, 80);
  const FramePictures::Paint paint = all.painter(look);
  ASSERT_EQ(looks.size(), 2u);
  EXPECT_EQ(looks[0].size, QSizeF(50, 40));
  EXPECT_TRUE(looks[0].titled);
  EXPECT_FALSE(looks[1].titled) << "one title is enough";
  QImage image(100, 80, QImage::Format_RGB32);
  image.fill(Qt::magenta);
  QPainter painter(&image);
  paint(painter, 2);
  painter.end();
  EXPECT_EQ(image.pixelColor(10, 10), QColor(Qt::red));
  EXPECT_EQ(image.pixelColor(10, 2), QColor(Qt::black));
  EXPECT_EQ(image.pixelColor(60, 60), QColor(Qt::blue));
  EXPECT_EQ(image.pixelColor(60, 42), QColor(Qt::black));
  EXPECT_EQ(image.pixelColor(60, 10), QColor(Qt::gray)) << "a part stays in its place";
  EXPECT_EQ(image.pixelColor(10, 60), QColor(Qt::gray));
}

TEST(ViewsTogether, OnePartShowsTheColourBar) {
  std::vector<PictureLook> looks;
  const QRectF place(0, 0, 0.25, 1.0);
  const FramePictures all = framesTogether({filled(Qt::green, &looks),
                                            filled(Qt::red, &looks),
                                            filled(Qt::green, &looks),
                                            filled(Qt::blue, &looks)},
                                           {place, place, place, place},
                                           Qt::gray);
  PictureLook look;
  all.painter(look);
  ASSERT_EQ(looks.size(), 4u);
  EXPECT_TRUE(looks[1].colorBar) << "the first one that has one";
  EXPECT_FALSE(looks[3].colorBar);
  look.colorBar = false;
  all.painter(look);
  EXPECT_FALSE(looks[5].colorBar);
}

class ViewsTogetherWindowTest : public WindowTest {
 protected:
  const ExportedView* view() {
    for (const ExportedView* each : window().feature<ExportFeature>().exportController().present())
      if (each->name == "Views together") return each;
    return nullptr;
  }
};

TEST_F(ViewsTogetherWindowTest, MatricesHandAndTimelineMakeAMovie) {
  EXPECT_EQ(view(), nullptr) << "nothing is open";
  open({"good.dsa"});
  ASSERT_NE(view(), nullptr);
  const auto pictures = view()->framePicturesNow();
  ASSERT_TRUE(pictures);
  EXPECT_EQ(pictures->numFrames, playback().numFrames());
  ASSERT_TRUE(pictures->timeUs);
  PictureLook look;
  look.size = QSizeF(640, 400);
  const FramePictures::Paint paint = pictures->painter(look);
  const auto painted = [&](std::size_t frame) {
    QImage image(640, 400, QImage::Format_RGB32);
    image.fill(Qt::magenta);
    QPainter painter(&image);
    paint(painter, frame);
    painter.end();
    return image;
  };
  const QImage first = painted(0), last = painted(pictures->numFrames - 1);
  int left = 0;
  for (int y = 0; y < first.height(); ++y)
    for (int x = 0; x < first.width(); ++x)
      left += first.pixelColor(x, y) == QColor(Qt::magenta) ? 1 : 0;
  EXPECT_EQ(left, 0) << "all of it is painted";
  EXPECT_EQ(painted(0), first);
  // Heat maps (above) and the cursor of the timeline (below) change.
  const auto half = [](const QImage& image, int top) { return image.copy(0, top, 640, 200); };
  EXPECT_NE(half(first, 0), half(last, 0));
  EXPECT_NE(half(first, 200), half(last, 200));
}

TEST_F(ViewsTogetherWindowTest, OneViewAloneIsNotTogether) {
  open({"good.dsa"});
  ASSERT_NE(view(), nullptr);
  press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  QCoreApplication::processEvents();
  EXPECT_EQ(view(), nullptr) << "the comparison has no picture of each frame";
}

}  // namespace
}  // namespace palpate::gui::views_together_test
