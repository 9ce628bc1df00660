// The feature with the dock Link: health of the connection, alarms, and the interfaces for other
// programs.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>
#include <memory>

#include "gui/link/alarm_notifier.h"
#include "gui/link/other_programs.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

// The actions that mute alarms and switch the interfaces for other programs.
struct LinkActions {
  explicit LinkActions(ActionRegistry& book);

  QAction* muteAlarms = nullptr;
  // Streams of live data to other programs; the settings store whether they are on.
  QAction* streamSignals = nullptr;
  QAction* streamFoxglove = nullptr;
  QAction* streamTactile = nullptr;
  // Off in every new window. data() is the path of the socket; empty: the default path.
  QAction* remoteControl = nullptr;
};

class LinkPanel;
class MessageBanner;

class LinkFeature : public Feature {
  Q_OBJECT
 public:
  LinkFeature(WindowState& windowState, QWidget* window);

  std::vector<DockSpec> docks() override;
  std::vector<BannerSpec> strips() override;

 private:
  void connectAlarms();
  void connectLog();
  void connectOthers();
  void mute(bool muted);
  void look();

  LinkActions actions_;
  LinkPanel* panel_;
  Dock* dock_;
  MessageBanner* alarms_;
  AlarmNotifier alarmNotifier_;
  // An alarm appeared after the user closed the banner.
  bool alarmIsNew_ = false;
  // Whether it was logged where senders of the stream are awaited.
  bool noticeLogged_ = false;
  std::size_t remarksLogged_ = 0;
  std::unique_ptr<OtherPrograms> others_;
};

}  // namespace palpate::gui
