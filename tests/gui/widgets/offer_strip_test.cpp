#include "gui/widgets/offer_strip.h"

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

TEST_F(OfferStripTest, MayOfferAgainWhileItIsAccepted) {
  strip_->offer("first", "Recover", [this] { strip_->say("working"); });
  accept()->click();
  EXPECT_FALSE(strip_->isHidden()) << "what was said in between stays";
  EXPECT_EQ(strip_->text(), "working");
  EXPECT_TRUE(accept()->isHidden());
}

TEST_F(OfferStripTest, ALongNameNeedsNoMoreWidthThanAShortOne) {
  offer("Recorded a");
  const int least = strip_->minimumSizeHint().width();
  const QString name = "2026-11-26_ceramic_coffee_mug_with_handle_001.palpate";
  const QString text = "Recorded " + name + ": 108 frames";
  offer(text);
  EXPECT_EQ(strip_->minimumSizeHint().width(), least);
  // All of it is seen: it wraps within the name.
  auto* label = strip_->findChild<QLabel*>("offerText");
  label->resize(label->fontMetrics().horizontalAdvance(name) / 2, 400);
  EXPECT_GE(label->heightForWidth(label->width()), 3 * label->fontMetrics().lineSpacing());
  EXPECT_EQ(strip_->text(), text);
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
