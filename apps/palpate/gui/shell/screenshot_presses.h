// Presses keys and buttons before a picture of the window is taken: a key of an action ("Ctrl+R")
// or the text of a button ("Check").
#pragma once

#include <QImage>
#include <string>
#include <vector>

class QWidget;

namespace palpate::gui {

struct ScreenshotPress {
  std::string what;
  // Time after the window shows the requested content [s].
  double atS = 0.0;
};

// Parses "Ctrl+R" or "Check@1.5": a number >= 0 after the last @ is the time of the press [s].
ScreenshotPress parsedPress(const std::string& text);

// Runs the event loop for `forS` seconds and does each press at its time, in the window that has
// the keyboard then: an open dialogue, else the main window. A press that isn't possible yet is
// retried for up to `patienceS` [s]; all later ones are delayed by as much. Returns the picture of
// the dialogue that is open in the end (and closes it), or a null image. Throws Error that names a
// press which is neither the key of an enabled action nor the text of a visible button.
QImage runAndPress(QWidget& window,
                   std::vector<ScreenshotPress> presses,
                   double forS,
                   double patienceS = 30.0);

}  // namespace palpate::gui
