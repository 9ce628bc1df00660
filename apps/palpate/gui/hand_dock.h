// The content of the dock Hand: moving it, what its matrices are set to, its joints and temperatures. A Stop that
// is always there, whatever is scrolled or folded away, and by Escape from everywhere.
#pragma once

#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <memory>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>

#include "gui/theme.h"

class QLabel;
class QPushButton;
class QScrollArea;

namespace palpate::gui {

class FactsView;
class GraspPanel;
class SensitivityModes;
class StopKey;
class TactileSettingsPanel;

class HandDock : public QWidget {
  Q_OBJECT
 public:
  // Remembers choices and named settings in `settings`, which must outlive it.
  explicit HandDock(QSettings& settings, QWidget* parent = nullptr);
  ~HandDock() override;
  // The hand that is connected, null: none. Both must outlive this, or be taken away by null before they end.
  void setHand(CaptureSession* session, GraspControl* control);
  void setTheme(Theme theme);
  TactileSettingsPanel& tactileSettings() noexcept { return *tactile_; }
  SensitivityModes& sensitivity() noexcept { return *sensitivity_; }
  // What the timer does while a hand is connected.
  void refresh();
  QSize sizeHint() const override { return {455, 640}; }

 signals:
  void stopPressed();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeHead();
  QWidget* makeBody(QSettings& settings);
  void say(const QString& text, bool bad);
  void showState(const GraspStatus& status);
  void showSamples();
  void showTemperatures(const Temperatures& temperatures);

  QScrollArea* body_ = nullptr;
  CaptureSession* session_ = nullptr;
  GraspControl* control_ = nullptr;
  std::shared_ptr<CaptureFeed> feed_;
  std::vector<CaptureItem> items_;
  QLabel* state_;
  QLabel* heat_;
  QPushButton* stop_;
  GraspPanel* grasp_;
  SensitivityModes* sensitivity_;
  TactileSettingsPanel* tactile_;
  FactsView* angles_;
  FactsView* temperatures_;
  StopKey* stopKey_;
  QTimer timer_;
  QString said_;  // a refusal, until something else happens
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
