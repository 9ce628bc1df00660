#include "gui/widgets/opening_strip.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

namespace palpate::gui {
namespace {

// For quicker work the strip would only flicker.
constexpr int kAppearAfterMs = 150;
constexpr int kOpeningStripSteps = 1000;

}  // namespace

OpeningStrip::OpeningStrip(QWidget* parent, const QString& verb, const QString& part)
    : QWidget(parent), verb_(verb) {
  setObjectName("OpeningStrip");
  setAttribute(Qt::WA_StyledBackground);
  name_ = new QLabel(this);
  name_->setTextFormat(Qt::PlainText);
  bar_ = new QProgressBar(this);
  bar_->setObjectName(part + "Progress");
  bar_->setRange(0, kOpeningStripSteps);
  bar_->setTextVisible(false);
  bar_->setFixedHeight(8);
  auto* cancel = new QPushButton("Cancel", this);
  cancel->setObjectName("cancel" + part.left(1).toUpper() + part.mid(1));
  cancel->setFocusPolicy(Qt::NoFocus);
  cancel->setToolTip("Cancel " + verb.toLower() + " (Esc)");
  connect(cancel, &QPushButton::clicked, this, &OpeningStrip::cancelRequested);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 5, 10, 5);
  row->setSpacing(12);
  row->addWidget(name_);
  row->addWidget(bar_, 1);
  row->addWidget(cancel);
  appear_.setSingleShot(true);
  appear_.setInterval(kAppearAfterMs);
  connect(&appear_, &QTimer::timeout, this, &QWidget::show);
  hide();
}

void OpeningStrip::begin(const QString& path) {
  name_->setText(verb_ + " " + QFileInfo(path).fileName());
  bar_->setValue(0);
  if (isHidden()) appear_.start();
}

void OpeningStrip::setProgress(double fraction) {
  bar_->setValue(static_cast<int>(fraction * kOpeningStripSteps));
}

void OpeningStrip::end() {
  appear_.stop();
  hide();
}

}  // namespace palpate::gui
