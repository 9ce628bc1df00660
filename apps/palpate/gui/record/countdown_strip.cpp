#include "gui/record/countdown_strip.h"

#include <QLabel>
#include <QPushButton>

#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr double kCountdownDigits = 2.6;  // their size, of that of usual text

}  // namespace

CountdownStrip::CountdownStrip(QWidget* parent) : QWidget(parent) {
  setObjectName("CountdownStrip");
  setAttribute(Qt::WA_StyledBackground);
  digits_ = makeLabel(this, "countdownDigits");
  QFont large = digits_->font();
  large.setPointSizeF(large.pointSizeF() * kCountdownDigits);
  large.setBold(true);
  digits_->setFont(large);
  digits_->setMinimumWidth(QFontMetrics(large).horizontalAdvance("00"));
  digits_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  text_ = makeLines(this, "countdownText");
  auto* cancel = makeButton(this, "countdownCancel", "Cancel  (Esc)", "Nothing is recorded");
  cancel->setFocusPolicy(Qt::TabFocus);
  connect(cancel, &QPushButton::clicked, this, &CountdownStrip::cancelRequested);
  setLayout(inRow({digits_, {text_, 1}, cancel}, Space::kWide, kBarEdges));
  hide();
}

void CountdownStrip::setLeft(int leftS, const QString& what) {
  text_->setText(what.isEmpty() ? QString("Recording begins")
                                : what + ": recording begins in " + QString::number(leftS) + " s");
  digits_->setText(leftS > 0 ? QString::number(leftS) : QString());
  setVisible(leftS > 0);
}

}  // namespace palpate::gui
