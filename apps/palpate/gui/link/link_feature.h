// The dock Link, its alarms, and the doors to other programs.
#pragma once

#include <memory>

#include "gui/link/alarm_notifier.h"
#include "gui/link/link_actions.h"
#include "gui/link/other_programs.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

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
  bool alarmIsNew_ = false;  // since what is in the strip was closed
  std::unique_ptr<OtherPrograms> others_;
};

}  // namespace palpate::gui
