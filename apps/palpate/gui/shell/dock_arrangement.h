// Arranges the docks of the main window: their default places in each preset, and how layouts are
// stored and restored. Each kind of source (nothing, recording, live) has a preset of its own in
// use, and each preset a layout for each kind.
#pragma once

#include <QByteArray>
#include <QList>
#include <QMainWindow>
#include <QObject>
#include <QSettings>
#include <QStringList>
#include <QTimer>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/window_state/displayed_source.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class CentralWidget;
class Dock;

class DockArrangement : public QObject {
  Q_OBJECT
 public:
  // All must outlive this object. The settings store the layouts.
  DockArrangement(QMainWindow& window, const CentralWidget& centre, QSettings& settings);

  void add(const DockSpec& offer);
  // To be called once all docks have been added.
  void begin();

  // Switches to the layout in use for a kind of source: nothing (only docks that are shown
  // everywhere), a recording, or live.
  void setPlace(DisplayedSource::Kind place);
  // The preset in use: one of kAllPresets, or an own one.
  const QString& preset() const { return preset_.at(place_); }
  // Switches to the layout of a preset, as it was left.
  void use(const QString& preset);
  // Names of the user's own presets.
  QStringList ownPresets() const;
  // Makes the present layout an own preset, and uses it. Returns why it can't be; empty: it is.
  QString keepAs(const QString& name);
  // Removes the preset in use, which is an own one, and uses the default preset.
  void removeOwn();
  // Restores the default places of the preset in use.
  void reset();
  // Hides all docks, and shows them again as before.
  void hideAll();
  void bringBack();
  void remember();

  QStringList names() const;
  // Shows one of names() and makes it large enough to be read.
  void show(const QString& name);
  QList<QAction*> toggles() const;

 signals:
  // Another preset is in use, or an own one was made or removed.
  void presetsChanged();

 protected:
  // Watches docks, and the tab bars that the window makes.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  // The layout before a change that took room from the docks around, which is restored when its
  // reason has gone; and the docks that were seen with it. Whoever gives docks other sizes with the
  // mouse, or opens or closes further ones, keeps that.
  struct Change {
    QByteArray before;
    std::vector<const Dock*> seen;
  };

  // The window grew because its content didn't fit [px].
  struct Growth {
    QSize from, to;
  };

  // Restores the layout of the preset in use.
  void restore();
  void store();
  // The preset whose default places the preset in use has.
  Preset standard() const;
  void placeDocks();
  void placeSides();
  const DockSpec* leftWhileLive() const;
  // The front one of the tabs on the right.
  const DockSpec* front() const;
  // The dock across the bottom of the window.
  const DockSpec* bottom() const;
  // What the key of a dock does: brings it to the front; closes it if it is there.
  void toggle(const DockSpec& offer);
  void bringToFront(const DockSpec& offer);
  // Docks above each other become tabs when the window is too small for all of them: Qt would
  // enlarge it, beyond the screen. `most` is the size that the window may have [px]; `inFront` is
  // the tab to be seen, null: any.
  void keepWindowSize(QSize most, Dock* inFront);
  // The window that had to grow nevertheless has its size again, as far as its content allows it.
  void giveSizeBack();
  // Docks that larger text made wider have their widths again, as far as the new text allows it.
  void fitToNewText();
  void fitCorner();
  // Enlarges a dock that the user asked for, so that its content can be read.
  void makeRoomFor(const DockSpec& offer, const QByteArray& before);
  std::vector<const Dock*> seenDocks() const;
  // Gives the room back that a closed dock took.
  void giveRoomBack(const Dock& dock);
  // Widens a dock of which another tab is shown, so that nothing of it is cut.
  void fitShown(Dock& dock);
  // Gives a dock of which another page is shown the width that this page needs.
  void fitPage(Dock& dock);
  // Widens a dock up to `widthPx`, as far as the views in the centre stay side by side, but at
  // least so far that its content isn't cut.
  void widen(Dock& dock, int widthPx);

  QMainWindow& window_;
  const CentralWidget& centre_;
  QSettings& settings_;
  std::vector<DockSpec> offers_;
  DisplayedSource::Kind place_ = DisplayedSource::Kind::kNothing;
  bool placed_ = false;
  std::map<DisplayedSource::Kind, QString> preset_;
  // By preset. A preset without a layout has its default places.
  std::map<DisplayedSource::Kind, std::map<QString, QByteArray>> layouts_;
  std::map<const Dock*, Change> opened_;
  std::set<const Dock*> opening_;  // they get their room by makeRoomFor()
  Change text_;
  // Ends when all parts have their sizes for another size of text.
  QTimer textChange_;
  std::optional<Growth> grown_;
  // The layout before hideAll().
  QByteArray hidden_;
  // The usual widths of docks [px], and what their pages have widened them to.
  struct PageWidth {
    int from = 0, to = 0;
  };
  std::map<const Dock*, PageWidth> pageWidths_;
};

}  // namespace palpate::gui
