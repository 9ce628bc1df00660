#include "gui/widgets/offer_strip.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>
#include <utility>

#include "gui/appearance/icons.h"
#include "gui/widgets/long_word_label.h"
#include "gui/widgets/make.h"

namespace palpate::gui {

OfferStrip::OfferStrip(QWidget* parent) : QWidget(parent) {
  setObjectName("OfferStrip");
  setAttribute(Qt::WA_StyledBackground);
  text_ = named(new LongWordLabel(this), "offerText");
  accept_ = makeButton(this, "offerAccept", {});
  accept_->setFocusPolicy(Qt::TabFocus);
  auto* close = named(new QToolButton(this), "offerClose", "Not now", "Not now");
  close->setProperty("flat", true);
  close->setIcon(makeIcon(IconShape::kClose));
  close->setIconSize({12, 12});
  close->setFocusPolicy(Qt::TabFocus);
  connect(accept_, &QPushButton::clicked, this, [this] {
    const auto accept = std::exchange(onAccept_, {});
    onDecline_ = {};
    hide();
    if (accept) accept();
  });
  connect(close, &QToolButton::clicked, this, [this] {
    const auto decline = std::exchange(onDecline_, {});
    dismiss();
    if (decline) decline();
  });
  row_ = inRow({{text_, 1}, accept_, close}, Space::kWide);
  others_ = new QHBoxLayout;
  others_->setSpacing(12);
  below_ = inRow({Stretch{}, others_});
  setLayout(inColumn({row_, below_},
                     Space::kNarrow,
                     {.left = Space::kWide,
                      .top = Space::kUsual,
                      .right = Space::kUsual,
                      .bottom = Space::kUsual}));
  hide();
}

void OfferStrip::placeOthers() {
  constexpr double kMaxShare = 0.5;  // of the width for buttons beside the text
  const int buttons = accept_->sizeHint().width() + others_->sizeHint().width();
  const bool beside = buttons < kMaxShare * width();
  if (beside == (others_->parent() == row_)) return;
  if (beside) {
    below_->removeItem(others_);
    row_->insertLayout(row_->indexOf(accept_), others_);
  } else {
    row_->removeItem(others_);
    below_->addLayout(others_);
  }
}

void OfferStrip::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  placeOthers();
}

void OfferStrip::offer(const QString& text,
                       const QString& button,
                       std::function<void()> accept,
                       std::function<void()> decline) {
  removeOthers();
  text_->setText(text);
  warn(false);
  accept_->setText(button);
  accept_->show();
  onAccept_ = std::move(accept);
  onDecline_ = std::move(decline);
  show();
}

void OfferStrip::offerAlso(const QString& button,
                           const QString& tip,
                           std::function<void()> action) {
  auto* made = makeButton(this, "offerOther", button, tip);
  made->setFocusPolicy(Qt::TabFocus);
  connect(made, &QPushButton::clicked, this, std::move(action));
  others_->addWidget(made);
  placeOthers();
}

void OfferStrip::removeOthers() {
  while (QLayoutItem* item = others_->takeAt(0)) {
    // Its own click may have led here.
    item->widget()->hide();
    item->widget()->deleteLater();
    delete item;
  }
}

void OfferStrip::say(const QString& text) {
  removeOthers();
  text_->setText(text);
  warn(false);
  accept_->hide();
  onAccept_ = {};
  onDecline_ = {};
  show();
}

void OfferStrip::dismiss() {
  onAccept_ = {};
  onDecline_ = {};
  hide();
}

void OfferStrip::warn(bool on) {
  if (property("warning").toBool() == on) return;
  setProperty("warning", on);
  for (QWidget* styled : {static_cast<QWidget*>(this), static_cast<QWidget*>(text_)}) {
    style()->unpolish(styled);
    style()->polish(styled);
  }
}

QString OfferStrip::text() const { return text_->text(); }

}  // namespace palpate::gui
