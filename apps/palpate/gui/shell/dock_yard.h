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

#include "gui/bench/feature.h"
#include "gui/bench/subject.h"
#include "gui/look/theme.h"

namespace palpate::gui {

class DockYard : public QObject {
  Q_OBJECT
 public:
  // Both must outlive it. Layouts are remembered in the settings.
  DockYard(QMainWindow& window, QSettings& settings);

  void add(const DockOffer& offer);
  // Once all are there.
  void begin();

  // With each place its own layout: nothing is looked at (only docks that stay everywhere), a
  // recording, live.
  void setPlace(Subject::Kind place);
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
  const DockOffer* leftWhileLive() const;
  const DockOffer* front() const;   // of the tabs on the right
  const DockOffer* bottom() const;  // across the window
  void makeRoomFor(const DockOffer& offer);

  QMainWindow& window_;
  QSettings& settings_;
  std::vector<DockOffer> offers_;
  Subject::Kind place_ = Subject::Kind::kNothing;
  bool placed_ = false;
  std::map<Subject::Kind, QByteArray> layouts_;
  QByteArray hidden_;  // the layout before hideAll()
};

}  // namespace palpate::gui
