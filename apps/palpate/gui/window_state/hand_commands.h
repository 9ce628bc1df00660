// What the user asks of the connected hand, for the parts that act on it besides the dock Hand.
#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <string>

#include <palpate/calibration/noise_floor.h>

namespace palpate::gui {

class HandCommands : public QObject {
  Q_OBJECT
 public:
  explicit HandCommands(QObject* parent = nullptr) : QObject(parent) {}

  // The noise lines that the high sensitivity of a hand of this name goes by; nothing, or empty:
  // none are applied.
  std::function<std::optional<NoiseFloor>(const std::string& hand)> noiseLines;

 signals:
  void asked();  // a motion, or Stop
  // High sensitivity begins or ends: thresholds at the noise let ghosts through.
  void highSensitivityChanged(bool on);
};

}  // namespace palpate::gui
