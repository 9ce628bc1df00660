// The content of the dock Hand: motions, settings of the matrices, joint angles and temperatures.
// The Stop button is always visible, however the dock is scrolled or folded; Escape stops the hand
// from anywhere in the program.
#pragma once

#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/control/grasp_control.h>

#include "gui/appearance/display_units.h"
#include "gui/appearance/theme.h"
#include "gui/window_state/hand_commands.h"

class QAction;
class QLabel;
class QPushButton;
class QScrollArea;
class QTabBar;

namespace palpate::gui {

class Ask;
struct HandActions;
class FittingPages;
class GraspPanel;
class JointPanel;
class SequencePanel;
class SensitivityModes;
class StatusLines;
class StopKey;
class TactileSettingsPanel;
class TouchStore;

class HandDock : public QWidget {
  Q_OBJECT
 public:
  // Stores choices and named settings in `settings`, which must outlive this. The actions do what
  // the buttons do.
  HandDock(QSettings& settings, Ask& ask, const HandActions& actions, QWidget* parent = nullptr);
  ~HandDock() override;
  // Sets the connected hand; null when there is none. Both must outlive this, or be replaced by
  // null before they are destroyed.
  void setHand(CaptureSession* session, GraspControl* control);
  // The close ratio of a plain grasp while the user has chosen none.
  void setUsualClose(double ratio);
  // Whether the window shows the hand, and not a recording: only then keys and menu move it.
  void setInSight(bool on);
  // The connected hand was found to be another one, or scans other taxels.
  void updateHand();
  QStringList pageNames() const;
  // A name that no page has changes nothing.
  void showPage(const QString& name);
  // The units of the present angles and temperatures; targets and velocities stay in degrees.
  void setUnits(const DisplayUnits& units);
  TactileSettingsPanel& tactileSettings() noexcept { return *tactile_; }
  // As in unmeasurableChanged().
  const std::vector<QString>& unmeasurable() const noexcept { return unmeasurable_; }
  SensitivityModes& sensitivity() noexcept { return *sensitivity_; }
  JointPanel& joints() noexcept { return *joint_; }
  // What is remembered of named objects.
  TouchStore& touches() noexcept { return *touches_; }
  // The calibration applied to the hand with this name, for limits in newtons; nothing: none, or it
  // is being read.
  std::function<std::optional<Calibration>(const std::string& hand)> calibrationOf;
  std::function<bool(const std::string& hand)> calibrationBeingRead;
  // What the connected hand does by itself, as HandModel::ownMotion(); empty: it moves on orders
  // only.
  std::function<QString()> ownMotion;
  // What moves the hand by itself, if it isn't the sequence of this dock.
  std::function<HandTask()> otherTask;
  // The user has seen that a protection ended.
  void acknowledge();
  // The key of an action was pressed that can't begin now: says why.
  void answerKey(const QString& why, const QAction* action);
  // Call this when another calibration was applied, or was read.
  void renewCalibration();
  // Updates the dock; a timer calls it while a hand is connected.
  void refresh();
  QSize sizeHint() const override { return {455, 640}; }

 signals:
  void stopPressed();
  // The dock started a motion, or it was refused.
  void asked();
  // Whether the hand answers, so that a stop reaches it.
  void reachedChanged(bool reached);
  // What the hand does, or why it can't; `bad`: it needs attention.
  void stateShown(const QString& text, bool bad);
  // The condition of the connected hand now; nothing: none is connected that can be moved, or it
  // has not answered yet. The task goes on whatever the hand does at the moment.
  void conditionShown(const std::optional<ExplainedCondition>& condition, const HandTask& task);
  // Another word became true, in the order in which that happened.
  void conditionChanged(const ExplainedCondition& condition);
  // Whether there is something that acknowledge() acknowledges.
  void unacknowledged(bool on);
  // A motion was refused, or has ended by itself in another way than asked for: why. Once for each.
  void explained(const QString& why);
  // Why matrices cannot detect the chosen limit: one text for each matrix, empty when it can; an
  // empty vector when all can.
  void unmeasurableChanged(const std::vector<QString>& why);

 protected:
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  // Sets the minimum width, so that nothing is cut off at the side, where the dock does not scroll.
  void fitWidth();
  // The size of text has just changed, and parts of the dock change their sizes.
  bool textChanged_ = false;
  QWidget* makeHead();
  QWidget* makeBody(QSettings& settings, Ask& ask);
  void makePages(QSettings& settings, Ask& ask, QWidget* content);
  void connectMotions();
  bool isReadOnly() const { return session_ && !control_; }
  // `more` is told by the tool tip only.
  void say(const QString& what, bool bad, const QString& more = {});
  void showRefusedNumber(const QString& what);
  // Says for some seconds why something was pressed in vain, or until it can be pressed.
  void answer(const QString& why, std::function<bool()> canBePressed);
  // The texts that belong to what was pressed before.
  void clearAnswers();
  void showState(const GraspStatus& status);
  void showCondition(const GraspStatus& status, const std::vector<GraspChange>& changes);
  void followScene(const GraspStatus& status);
  void followRefusal(const GraspStatus& status, const std::vector<MatrixSettings>& settings);
  void showUnmeasurable(const std::vector<MatrixSettings>& settings);
  void showSamples();
  // Warns of sensors that are too hot.
  void showHeat(const Sample& temperatures);

  const HandActions& actions_;
  QScrollArea* body_ = nullptr;
  CaptureSession* session_ = nullptr;
  GraspControl* control_ = nullptr;
  std::shared_ptr<CaptureQueue> queue_;
  std::vector<CaptureItem> items_;
  StatusLines* state_;
  QLabel* heat_;
  QPushButton* stop_;
  // What is absent for a hand that is read only.
  std::vector<QWidget*> controls_;
  // The pages Grasp, Joints, Sequence and Sensors.
  QTabBar* chooser_;
  FittingPages* pages_;
  TouchStore* touches_;
  GraspPanel* grasp_;
  JointPanel* joint_;
  SequencePanel* sequence_;
  SensitivityModes* sensitivity_;
  TactileSettingsPanel* tactile_;
  DisplayUnits units_;
  std::vector<TemperatureSensorDescription> sensors_;
  // The last ones.
  std::optional<Sample> shownTemperatures_;
  StopKey* stopKey_;
  // What the hand did by itself, and GraspStatus::stopsAsked, at the last refresh; whether a stop
  // ended it, and when the last grasp had ended then [us since 1970].
  QString own_;
  std::uint64_t stopsAsked_ = 0;
  bool sceneStopped_ = false;
  std::int64_t sceneLastUs_ = 0;
  // Of the connected hand, once it could be moved: the condition that was told last.
  std::optional<HandCondition> toldCondition_;
  QTimer timer_;
  // When the motion port was last missing [us since 1970]; 0: never.
  std::int64_t goneUs_ = 0;
  // Why a motion was refused; shown until another motion is requested.
  QString said_;
  // When the last grasp was refused [us since 1970]; whether because matrices can't measure its
  // limit; whether they can by now.
  std::int64_t refusedUs_ = 0;
  bool limitRefused_ = false;
  bool limitMeasurable_ = false;
  // GraspReport::endUs of the last motion that was told by explained().
  std::int64_t explainedEndUs_ = 0;
  // What was typed into a field and isn't used; shown below or above what the hand does.
  QString refusedNumber_;
  const QObject* refusedBy_ = nullptr;  // the RefusedNumber of that field
  // It was found in the event that is being handled.
  bool refusalIsNew_ = false;
  // Why a button or key was pressed in vain, and whether it can be pressed by now; shown like
  // refusedNumber_.
  QString answer_;
  std::function<bool()> canBePressed_;
  QTimer answerTimer_;
  std::vector<QString> unmeasurable_;
  // The inputs that unmeasurable_ was computed from.
  struct Judged {
    std::vector<MatrixSettings> settings;
    std::shared_ptr<const SensorLayout> layout;
    std::string preshape;
    int limitCounts = 0;
    int maxLimitCounts = 0;
    std::vector<int> fingerLimitCounts;
    bool operator==(const Judged&) const = default;
  };
  std::optional<Judged> judged_;
  // The layout with the masks of the newest frame; null before the first frame.
  std::shared_ptr<const SensorLayout> layout_;
};

}  // namespace palpate::gui
