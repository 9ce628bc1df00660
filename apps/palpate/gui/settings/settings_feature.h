// The feature with the dialog Settings (File > Settings…). It gathers what other features keep in
// the settings, and applies changes at once.
#pragma once

#include "gui/settings/settings_dialog.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class SettingsFeature : public Feature {
  Q_OBJECT
 public:
  SettingsFeature(WindowState& windowState, QWidget* window);

  WindowChoices choices() const;
  void apply(const WindowChoices& choices);

 private:
  void ask();
};

// Whether the start opens what was open at the end of the last session.
bool reopensSession(const QSettings& settings);
// Removes what the user wants to be forgotten; called last, when the window has stored everything.
void forgetChosen(QSettings& settings);

}  // namespace palpate::gui
