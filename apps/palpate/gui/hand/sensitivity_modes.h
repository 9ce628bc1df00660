// How sensitivity and thresholds of a connected hand are held: by hand, high (just above the noise,
// following the temperatures), adaptive (the highest without saturation).
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
  // Null: no hand that could be set. Both must outlive this, or be taken away before.
  void setHand(CaptureSession* session, GraspControl* control);
  // A round; shows how it goes. Several times a second.
  void refresh();
  // Somebody set a value: no mode holds it any more.
  void endMode();
  SensitivityMode mode() const;
  QString statusText() const;

  // The noise lines of the hand with this name; nothing: none are applied to it.
  std::function<std::optional<NoiseFloor>(const std::string& hand)> noiseLines;

 signals:
  void asked();  // a mode was chosen
  void refused(const QString& why);
  // High sensitivity begins or ends: ghosts want a filter.
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
