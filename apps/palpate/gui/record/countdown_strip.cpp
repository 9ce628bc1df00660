#include "gui/record/countdown_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

namespace palpate::gui {
namespace {

constexpr double kCountdownDigits = 2.6;  // their size, of that of usual text

}  // namespace

CountdownStrip::CountdownStrip(QWidget* parent) : QWidget(parent) {
  setObjectName("CountdownStrip");
  setAttribute(Qt::WA_StyledBackground);
  digits_ = new QLabel(this);
  digits_->setObjectName("countdownDigits");
  QFont large = digits_->font();
  large.setPointSizeF(large.pointSizeF() * kCountdownDigits);
  large.setBold(true);
  digits_->setFont(large);
  digits_->setMinimumWidth(QFontMetrics(large).horizontalAdvance("00"));
  digits_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  text_ = new QLabel(this);
  text_->setObjectName("countdownText");
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  auto* cancel = new QPushButton("Cancel  (Esc)", this);
  cancel->setObjectName("countdownCancel");
  cancel->setToolTip("Nothing is recorded");
  cancel->setFocusPolicy(Qt::TabFocus);
  cancel->setAutoDefault(false);
  connect(cancel, &QPushButton::clicked, this, &CountdownStrip::cancelRequested);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 4, 14, 4);
  row->setSpacing(12);
  row->addWidget(digits_);
  row->addWidget(text_, 1);
  row->addWidget(cancel);
  hide();
}

void CountdownStrip::setLeft(int leftS, const QString& what) {
  text_->setText(what.isEmpty() ? QString("Recording begins")
                                : what + ": recording begins in " + QString::number(leftS) + " s");
  digits_->setText(leftS > 0 ? QString::number(leftS) : QString());
  setVisible(leftS > 0);
}

}  // namespace palpate::gui
