// Announces what the user commands the connected hand to do, for features other than the dock Hand
// that react to it.
#pragma once

#include <QAction>
#include <QList>
#include <QObject>
#include <QString>
#include <functional>
#include <optional>
#include <string>

#include <palpate/calibration/calibration.h>
#include <palpate/control/hand_condition.h>

namespace palpate::gui {

// What moves the hand by motions that follow each other by themselves.
struct HandTask {
  QString word;      // "sequence runs"; empty: there is no task
  QString sentence;  // what it does now
  bool operator==(const HandTask&) const = default;
};

class HandCommands : public QObject {
  Q_OBJECT
 public:
  explicit HandCommands(QObject* parent = nullptr) : QObject(parent) {}

  // Returns the noise lines to which high sensitivity sets the thresholds of the hand of this name.
  // An empty function, or nothing as its result: no noise lines are applied.
  std::function<std::optional<NoiseFloor>(const std::string& hand)> noiseLines;
  // Returns the calibration that is applied to the hand of this name. An empty function, or nothing
  // as its result: none is applied, it is being read, or it can't be read.
  std::function<std::optional<Calibration>(const std::string& hand)> calibration;
  // Whether the calibration that is applied to the hand of this name is being read;
  // calibrationApplied() follows. An empty function: never.
  std::function<bool(const std::string& hand)> calibrationBeingRead;
  // The task of a feature other than the dock Hand. An empty function: there is none.
  std::function<HandTask()> otherTask;
  // The action that stops the hand, enabled while there is a hand to stop, and the actions that
  // move it; for windows in which the keys of the main window don't work. Null and empty: no dock
  // Hand.
  QAction* stop = nullptr;
  QList<QAction*> motions;

  // The condition of the connected hand; nothing: no hand is connected that can be moved.
  const std::optional<ExplainedCondition>& condition() const noexcept { return condition_; }
  const HandTask& task() const noexcept { return task_; }
  void setCondition(const std::optional<ExplainedCondition>& condition, const HandTask& task) {
    if (condition == condition_ && task == task_) return;
    condition_ = condition;
    task_ = task;
    emit conditionChanged();
  }

  // What the hand does, or why it can't, in the words of the dock Hand.
  const QString& handState() const noexcept { return handState_; }
  bool handStateBad() const noexcept { return handStateBad_; }
  void setHandState(const QString& text, bool bad) {
    if (text == handState_ && bad == handStateBad_) return;
    handState_ = text;
    handStateBad_ = bad;
    emit handStateChanged();
  }

  // The key of a greyed action was pressed.
  void refuseKey(const QString& why, const QAction* action) {
    if (motions.contains(action)) emit keyRefused(why, action);
  }

 signals:
  // Another calibration was applied, or the applied one was removed, is being read, or was read.
  void calibrationApplied();
  // Other noise lines were applied.
  void noiseLinesApplied();
  // The user commands a motion, or Stop.
  void asked();
  // The user commands Stop, by the button or by Escape.
  void stopped();
  // High sensitivity begins or ends. With thresholds at the noise, ghost readings appear.
  void highSensitivityChanged(bool on);
  void handStateChanged();
  void conditionChanged();
  // The key of a motion was pressed that can't begin now: one line that tells why.
  void keyRefused(const QString& why, const QAction* action);

 private:
  std::optional<ExplainedCondition> condition_;
  HandTask task_;
  QString handState_;
  bool handStateBad_ = false;
};

}  // namespace palpate::gui
