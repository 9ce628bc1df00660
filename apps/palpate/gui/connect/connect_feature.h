// The feature that connects to a hand: the Connect dialog, the menu of the button Connect, and the
// actions that show the live hand or hold its picture.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>
#include <optional>

#include <palpate/capture/recorder.h>
#include <palpate/control/grasp_control.h>

#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions that connect to a hand and show the connected hand.
struct ConnectActions {
  explicit ConnectActions(ActionRegistry& book);

  QAction* connectHand = nullptr;
  QAction* tryEmulated = nullptr;
  QAction* addSensor = nullptr;
  QAction* disconnectHand = nullptr;
  // Checked while the connection is shown instead of a recording.
  QAction* live = nullptr;
  QAction* hold = nullptr;
};

class ConnectFeature : public Feature {
  Q_OBJECT
 public:
  ConnectFeature(WindowState& windowState, QWidget* window);

 private:
  void addQuestions();
  void connectActions();
  void fillMenu();
  // The status of the connected hand while it moves or holds.
  std::optional<GraspStatus> movingHand() const;
  void connectSensors();
  void addSensor(const Sensor& sensor, std::shared_ptr<void> preview = {});
  void removeSensor(const QString& name);
  // Of the connected session.
  QStringList sensorNames() const;
  void disconnectHand();
  bool mayEndRecording(UserPrompts::Ending ending);
  bool moveRecording();
  std::filesystem::path scenesFolder() const;

  ConnectActions actions_;
};

// What is asked before a recording that can be written ends with its connection: what becomes of
// it, and of the hand. `hand`: while it moves or holds.
QString endRecordingText(const RecorderStatus& recorder,
                         const std::optional<GraspStatus>& hand,
                         UserPrompts::Ending ending);

// A connection to an emulated hand that grasps a ball by itself.
Connection emulatedBallConnection();

}  // namespace palpate::gui
