// The content of the dock Calibrate: one page for each step from counts to kilopascals and newtons;
// one page is visible at a time.
#pragma once

#include <optional>

#include "gui/widgets/computed_page.h"
#include "gui/widgets/paged_panel.h"

namespace palpate {
class CaptureSession;
}

namespace palpate::gui {

class Ask;
class ForcePage;
class NoisePage;
class PressurePage;
class StepPage;
class TarePage;

class CalibratePanel : public PagedPanel {
  Q_OBJECT
 public:
  CalibratePanel(QSettings& settings, Ask& ask, QWidget* parent = nullptr);

  void setSource(const OpenedRecordingPtr& recording, bool live);
  // Sets the session of the connected hand, which the pages Noise and Tare can measure; null: none,
  // before it is closed. Of another hand than before nothing is measured yet.
  void setSession(CaptureSession* session);
  void setPosition(double seconds);
  bool cancel();
  void settle();

  StepPage& steps() noexcept { return *steps_; }
  PressurePage& pressure() noexcept { return *pressure_; }
  NoisePage& noise() noexcept { return *noise_; }
  TarePage& tare() noexcept { return *tare_; }
  ForcePage& force() noexcept { return *force_; }
  // The visible page.
  ComputedPage& page() const;
  QSize sizeHint() const override { return {640, 560}; }

 signals:
  void said(const QString& text);

 private:
  void add(ComputedPage* page, const QString& name, const QString& tip);

  StepPage* steps_;
  PressurePage* pressure_;
  NoisePage* noise_;
  TarePage* tare_;
  ForcePage* force_;
};

}  // namespace palpate::gui
