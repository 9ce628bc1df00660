#include "gui/widgets/opening_strip.h"

#include <QFileInfo>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

#include "gui/widgets/make.h"

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
  name_ = makeLabel(this, {});
  bar_ = named(new QProgressBar(this), part + "Progress");
  bar_->setRange(0, kOpeningStripSteps);
  bar_->setTextVisible(false);
  bar_->setFixedHeight(8);
  auto* cancel = makeButton(this,
                            "cancel" + part.left(1).toUpper() + part.mid(1),
                            "Cancel",
                            "Cancel " + verb.toLower() + " (Esc)");
  cancel->setFocusPolicy(Qt::NoFocus);
  connect(cancel, &QPushButton::clicked, this, &OpeningStrip::cancelRequested);
  setLayout(inRow({name_, {bar_, 1}, cancel}, Space::kWide, kBarEdges));
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
