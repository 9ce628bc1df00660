// The buttons of the dock Hand that choose how sensitivity and thresholds of a connected hand are
// set: manual, high (thresholds just above the noise, following the temperatures), or adaptive (the
// highest sensitivity without saturation).
#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <optional>

#include <palpate/control/sensitivity_control.h>

class QButtonGroup;
class QLabel;

namespace palpate::gui {

class SensitivityModes : public QWidget {
  Q_OBJECT
 public:
  explicit SensitivityModes(QWidget* parent = nullptr);
  // Null: no hand that can be set. Both must outlive this, or be replaced by null before they are
  // destroyed.
  void setHand(CaptureSession* session, GraspControl* control);
  // Runs one control step and shows its status. Call it several times a second.
  void refresh();
  // Switches to manual, because the user set a value.
  void endMode();
  // Other noise lines were applied to the hand.
  void renewNoiseLines();
  SensitivityMode mode() const;
  QString statusText() const;

  // The noise floor applied to the hand with this name; nothing when there is none.
  std::function<std::optional<NoiseFloor>(const std::string& hand)> noiseLines;

 signals:
  // The user chose a mode.
  void asked();
  // A mode begins, which changes the settings; they still have their present values.
  void changing();
  void refused(const QString& why);
  // What was refused with this text is possible now.
  void refusalEnded(const QString& why);
  // High sensitivity was switched on or off; while it is on, a filter must remove ghosts.
  void highChanged(bool on);

 private:
  void choose(SensitivityMode mode);
  void showMode(SensitivityMode mode);
  QString describe(const SensitivityStatus& status) const;

  CaptureSession* session_ = nullptr;
  std::unique_ptr<SensitivityControl> control_;
  QButtonGroup* buttons_;
  QLabel* text_;
  SensitivityMode shown_ = SensitivityMode::kManual;
};

}  // namespace palpate::gui
