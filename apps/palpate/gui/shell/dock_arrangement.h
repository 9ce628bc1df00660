// Arranges the docks of the main window: their default places, one layout for each kind of source
// (nothing, recording, live), and how layouts are stored and restored.
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

  // Switches to the layout of a kind of source: nothing (only docks that are shown everywhere), a
  // recording, or live.
  void setPlace(DisplayedSource::Kind place);
  // Restores the default places.
  void reset();
  // Hides all docks, and shows them again as before.
  void hideAll();
  void bringBack();
  void remember();

  QStringList names() const;
  // Shows one of names() and makes it large enough to be read.
  void show(const QString& name);
  QList<QAction*> toggles() const;

 protected:
  // Watches docks, and the tab bars that the window makes.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  // A dock at another side that became narrower for one that was opened: its width before and
  // after [px].
  struct Opposite {
    Dock* dock;
    int before = 0, after = 0;
  };

  // Sizes before and after makeRoomFor() [px]; 0: unchanged.
  struct Room {
    int widthBefore = 0, width = 0;
    int bottomBefore = 0, bottom = 0;
    // When the dock was closed.
    int lastWidth = 0, lastBottom = 0;
    std::vector<Opposite> opposite;
  };

  // The width of a dock before the text became larger, and the one that it has since [px].
  struct TextWidth {
    int before = 0, after = 0;
  };

  // The window grew because its content didn't fit [px].
  struct Growth {
    QSize from, to;
  };

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
  void noteTextChange();
  void fitToNewText();
  void makeRoomFor(const DockSpec& offer, const Room& before);
  // Gives the room back that makeRoomFor() took, unless the user has changed it since.
  // Height of the place at the bottom, whichever of its tabs is in front: that dock or `dock` [px].
  int heightOfBottom(const Dock& dock) const;
  void giveRoomBack(const Dock& dock);
  // Widens a dock of which another tab or page is shown, so that nothing of it is cut.
  void fitShown(Dock& dock);
  // Widens a dock up to `widthPx`, as far as the views in the centre stay side by side, but at
  // least so far that its content isn't cut.
  void widen(Dock& dock, int widthPx);
  // The docks that are seen at other sides, and their widths.
  std::vector<Opposite> opposite(const Dock& dock) const;
  // A visible dock at the same side; null: there is none.
  Dock* neighbour(const Dock& dock) const;

  QMainWindow& window_;
  const CentralWidget& centre_;
  QSettings& settings_;
  std::vector<DockSpec> offers_;
  DisplayedSource::Kind place_ = DisplayedSource::Kind::kNothing;
  bool placed_ = false;
  std::map<DisplayedSource::Kind, QByteArray> layouts_;
  std::map<const Dock*, Room> rooms_;
  std::map<Dock*, TextWidth> textWidths_;
  // Ends when all parts have their sizes for another size of text.
  QTimer textChange_;
  std::optional<Growth> grown_;
  // The layout before hideAll().
  QByteArray hidden_;
};

}  // namespace palpate::gui
