#include "gui/widgets/offer_strip.h"

#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <QToolButton>

#include "testing/testing.h"

namespace palpate::gui::offer_strip_test {
namespace {

class OfferStripTest : public ::testing::Test {
 protected:
  OfferStripTest() { parent_.show(); }
  void offer(const QString& text) {
    strip_->offer(
        text, "Open", [this] { ++accepted_; }, [this] { ++declined_; });
  }
  QPushButton* accept() { return strip_->findChild<QPushButton*>("offerAccept"); }
  QToolButton* close() { return strip_->findChild<QToolButton*>("offerClose"); }
  QWidget parent_;
  OfferStrip* strip_ = new OfferStrip(&parent_);
  int accepted_ = 0, declined_ = 0;
};

TEST_F(OfferStripTest, IsAcceptedOnce) {
  EXPECT_TRUE(strip_->isHidden());
  offer("Recorded a.palpate");
  EXPECT_FALSE(strip_->isHidden());
  EXPECT_EQ(strip_->text(), "Recorded a.palpate");
  EXPECT_EQ(accept()->text(), "Open");
  accept()->click();
  accept()->click();
  EXPECT_EQ(accepted_, 1);
  EXPECT_EQ(declined_, 0);
  EXPECT_TRUE(strip_->isHidden());
}

TEST_F(OfferStripTest, ClosedIsDeclinedDismissedIsNeither) {
  offer("a");
  close()->click();
  EXPECT_EQ(declined_, 1);
  offer("b");
  strip_->dismiss();
  EXPECT_EQ(declined_, 1);
  EXPECT_EQ(accepted_, 0);
}

TEST_F(OfferStripTest, ALongNameIsBrokenAndSeenWhole) {
  const QString name(120, 'm');
  parent_.resize(400, 300);
  strip_->resize(400, 100);
  offer("Recorded " + name);
  // Beside the button and the cross: ten letters.
  const int others = accept()->sizeHint().width() + close()->sizeHint().width();
  constexpr int kAround = 60;  // [px] margins and spaces
  EXPECT_LE(strip_->minimumSizeHint().width(),
            others + kAround + 10 * strip_->fontMetrics().averageCharWidth());
  const auto* text = strip_->findChild<QLabel*>("offerText");
  const QFontMetrics metrics = text->fontMetrics();
  // As many lines as its width needs, and ink in the last one.
  const int lines = metrics.horizontalAdvance(name) / text->width();
  ASSERT_GT(lines, 1);
  EXPECT_GE(text->heightForWidth(text->width()), lines * metrics.height());
  QLabel* whole = strip_->findChild<QLabel*>("offerText");
  whole->resize(whole->width(), whole->heightForWidth(whole->width()));
  const QImage picture = whole->grab().toImage();
  const QColor ground = picture.pixelColor(0, 0);
  bool inked = false;
  for (int x = 0; x < picture.width(); ++x)
    for (int y = picture.height() - metrics.height(); y < picture.height(); ++y)
      inked = inked || picture.pixelColor(x, y) != ground;
  EXPECT_TRUE(inked);
}

// Below it in a narrow window, which would have to grow otherwise.
TEST_F(OfferStripTest, FurtherButtonsStandBesideTheTextWhereThereIsRoom) {
  offer("Recorded run_003.palpate: 412 frames");
  for (const char* also : {"Repeat", "Discard"}) strip_->offerAlso(also, {}, [] {});
  const auto top = [this](const char* name) {
    const auto* button = strip_->findChild<QPushButton*>(name);
    return button->mapTo(strip_, QPoint()).y();
  };
  for (const int width : {1000, 300, 1000}) {
    strip_->resize(width, strip_->sizeHint().height());
    strip_->show();
    QCoreApplication::processEvents();
    QCoreApplication::processEvents();
    if (width == 1000)
      EXPECT_EQ(top("offerOther"), top("offerAccept"));
    else
      EXPECT_GT(top("offerOther"), top("offerAccept"));
  }
}

TEST_F(OfferStripTest, MayOfferAgainWhileItIsAccepted) {
  strip_->offer("first", "Recover", [this] { strip_->say("working"); });
  accept()->click();
  EXPECT_FALSE(strip_->isHidden()) << "what was said in between stays";
  EXPECT_EQ(strip_->text(), "working");
  EXPECT_TRUE(accept()->isHidden());
}

TEST_F(OfferStripTest, AWarningIsOfOneLineOnly) {
  offer("Recorded a: 108 frames lost");
  strip_->warn(true);
  EXPECT_TRUE(strip_->property("warning").toBool());
  offer("Recorded b");
  EXPECT_FALSE(strip_->property("warning").toBool());
}

TEST_F(OfferStripTest, FileNamesAreNoMarkUp) {
  offer("<b>bold</b>");
  EXPECT_EQ(strip_->findChild<QLabel*>("offerText")->textFormat(), Qt::PlainText);
}

}  // namespace
}  // namespace palpate::gui::offer_strip_test
