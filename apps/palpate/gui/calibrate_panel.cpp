#include "gui/calibrate_panel.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/force_page.h"
#include "gui/noise_page.h"
#include "gui/pressure_page.h"
#include "gui/step_page.h"
#include "gui/tare_page.h"

namespace palpate::gui {
namespace {

constexpr const char* kPageKey = "calibrate/page";

}  // namespace

CalibratePanel::CalibratePanel(QSettings& settings, QWidget* parent)
    : QWidget(parent), settings_(settings) {
  setObjectName("CalibratePanel");
  header_ = new QWidget(this);
  auto* row = new QHBoxLayout(header_);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  row->addStretch(1);
  chooser_ = new QButtonGroup(this);
  pages_ = new QStackedWidget(this);
  steps_ = new StepPage(pages_);
  pressure_ = new PressurePage(pages_);
  noise_ = new NoisePage(pages_);
  tare_ = new TarePage(pages_);
  force_ = new ForcePage(settings, pages_);
  add(steps_, "Steps", "Responses to loads that are put on: gain, drift, time constants");
  add(pressure_,
      "Pressure",
      "Pressure from gain and temperature, from recordings under known loads");
  add(noise_, "Noise", "What an unloaded hand reads, over its temperature");
  add(tare_, "Tare", "What taxels read when nothing touches them");
  add(force_, "Force", "Kilopascals and newtons of this recording");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(pages_);
  connect(chooser_, &QButtonGroup::idToggled, this, [this](int page, bool on) {
    if (!on) return;
    pages_->setCurrentIndex(page);
    settings_.setValue(kPageKey, pageName());
  });
  const QString last = settings.value(kPageKey).toString();
  showPage(pageNames().contains(last) ? last : pageNames().front());
}

void CalibratePanel::add(CalibratePage* page, const QString& name, const QString& tip) {
  auto* button = new QToolButton(header_);
  button->setText(name);
  button->setToolTip(tip);
  button->setObjectName("calibrate" + name);
  button->setCheckable(true);
  button->setFocusPolicy(Qt::TabFocus);
  chooser_->addButton(button, pages_->addWidget(page));
  header_->layout()->addWidget(button);
  connect(page, &CalibratePage::said, this, &CalibratePanel::said);
}

void CalibratePanel::setSource(const OpenedRecordingPtr& recording, bool live) {
  for (int i = 0; i < pages_->count(); ++i)
    static_cast<CalibratePage*>(pages_->widget(i))->setSource(recording, live);
}

void CalibratePanel::setTheme(Theme theme) {
  if (theme == theme_) return;
  theme_ = theme;
  for (int i = 0; i < pages_->count(); ++i)
    static_cast<CalibratePage*>(pages_->widget(i))->setTheme(theme);
}

void CalibratePanel::setPosition(double seconds) {
  for (int i = 0; i < pages_->count(); ++i)
    static_cast<CalibratePage*>(pages_->widget(i))->setPosition(seconds);
}

bool CalibratePanel::cancel() { return page().cancel(); }

void CalibratePanel::settle() { page().settle(); }

QStringList CalibratePanel::pageNames() const {
  QStringList names;
  for (const QAbstractButton* button : chooser_->buttons()) names.append(button->text());
  return names;
}

void CalibratePanel::showPage(const QString& name) {
  for (QAbstractButton* button : chooser_->buttons())
    if (button->text() == name) button->setChecked(true);
}

CalibratePage& CalibratePanel::page() const {
  return *static_cast<CalibratePage*>(pages_->currentWidget());
}

QString CalibratePanel::pageName() const {
  return chooser_->button(pages_->currentIndex())->text();
}

}  // namespace palpate::gui
