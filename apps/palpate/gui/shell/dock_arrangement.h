// The docks of the window: where they stand at first, in each place of the window its own layout,
// and how they come back.
#pragma once

#include <QByteArray>
#include <QList>
#include <QMainWindow>
#include <QObject>
#include <QSettings>
#include <QStringList>
#include <map>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/window_state/displayed_source.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class DockArrangement : public QObject {
  Q_OBJECT
 public:
  // Both must outlive it. Layouts are remembered in the settings.
  DockArrangement(QMainWindow& window, QSettings& settings);

  void add(const DockSpec& offer);
  // Once all are there.
  void begin();

  // With each place its own layout: nothing is looked at (only docks that stay everywhere), a
  // recording, live.
  void setPlace(DisplayedSource::Kind place);
  void reset();  // as they stand at first
  // Out of the way, and back as they were.
  void hideAll();
  void bringBack();
  void remember();
  void setTheme(Theme theme);

  QStringList names() const;
  void show(const QString& name);  // one of names(), with room to be read
  QList<QAction*> toggles() const;

 private:
  void placeDocks();
  void placeSides();
  const DockSpec* leftWhileLive() const;
  const DockSpec* front() const;   // of the tabs on the right
  const DockSpec* bottom() const;  // across the window
  void makeRoomFor(const DockSpec& offer);

  QMainWindow& window_;
  QSettings& settings_;
  std::vector<DockSpec> offers_;
  DisplayedSource::Kind place_ = DisplayedSource::Kind::kNothing;
  bool placed_ = false;
  std::map<DisplayedSource::Kind, QByteArray> layouts_;
  QByteArray hidden_;  // the layout before hideAll()
};

}  // namespace palpate::gui
