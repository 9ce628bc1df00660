#include "gui/calibrate/calibrate_panel.h"

#include <QStackedWidget>

#include "gui/calibrate/force_page.h"
#include "gui/calibrate/measure_row.h"
#include "gui/calibrate/noise_page.h"
#include "gui/calibrate/pressure_page.h"
#include "gui/calibrate/step_page.h"
#include "gui/calibrate/tare_page.h"
#include "gui/widgets/make.h"

namespace palpate::gui {

CalibratePanel::CalibratePanel(QSettings& settings, Ask& ask, QWidget* parent)
    : PagedPanel(settings, "calibrate", parent) {
  setObjectName("CalibratePanel");
  QWidget* parentOfPages = &pages();
  steps_ = new StepPage(parentOfPages);
  pressure_ = new PressurePage(ask, parentOfPages);
  noise_ = new NoisePage(settings, ask, parentOfPages);
  tare_ = new TarePage(settings, parentOfPages);
  force_ = new ForcePage(settings, ask, parentOfPages);
  add(steps_, "Steps", "Responses to applied loads: gain, drift, time constants");
  add(pressure_,
      "Pressure",
      "Pressure from gain and temperature, from recordings under known loads");
  add(noise_, "Noise", "Readings of an unloaded hand, over its temperature");
  add(tare_, "Tare", "Readings of taxels that nothing touches");
  add(force_, "Force", "Kilopascals and newtons of this recording");
  setLayout(inColumn({parentOfPages}));
  showLastPage();
}

void CalibratePanel::add(ComputedPage* page, const QString& name, const QString& tip) {
  addPage(page, name, tip);
  connect(page, &ComputedPage::said, this, &CalibratePanel::said);
}

void CalibratePanel::setSource(const OpenedRecordingPtr& recording, bool live) {
  for (int i = 0; i < pages().count(); ++i)
    static_cast<ComputedPage*>(pages().widget(i))->setSource(recording, live);
  for (MeasureRow* row : {&noise_->measureRow(), &tare_->measureRow()}) row->setLive(live);
  // A connected hand has no steps. A page that is being looked at stays.
  if (live && !isVisible() && pageName() == "Steps") showPage("Noise");
}

void CalibratePanel::setSession(CaptureSession* session) {
  for (MeasureRow* row : {&noise_->measureRow(), &tare_->measureRow()}) row->setSession(session);
  if (!session) return;
  noise_->setMeasured(nullptr);
  tare_->setMeasured(nullptr);
}

void CalibratePanel::setPosition(double seconds) {
  for (int i = 0; i < pages().count(); ++i)
    static_cast<ComputedPage*>(pages().widget(i))->setPosition(seconds);
}

bool CalibratePanel::cancel() {
  return page().cancel() || tare_->measureRow().cancel() || noise_->measureRow().cancel();
}

void CalibratePanel::settle() {
  noise_->measureRow().settle();
  tare_->measureRow().settle();
  page().settle();
}

ComputedPage& CalibratePanel::page() const {
  return *static_cast<ComputedPage*>(pages().currentWidget());
}

}  // namespace palpate::gui
