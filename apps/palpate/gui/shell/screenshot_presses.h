// What is pressed before a picture of the window is made: a key of an action ("Ctrl+R") or the
// words on a button ("Check").
#pragma once

#include <QImage>
#include <string>
#include <vector>

class QWidget;

namespace palpate::gui {

struct ScreenshotPress {
  std::string what;
  double atS = 0.0;  // after the window shows what was asked for [s]
};

// "Ctrl+R", "Check@1.5": what follows the last @ is the moment when it is a number >= 0.
ScreenshotPress parsedPress(const std::string& text);

// Runs the event loop for `forS` seconds and presses each at its moment, in what has the keyboard
// then: an open dialogue, else the window. What can't be pressed yet is waited for, up to
// `patienceS`; all that follows is that much later. Returns the picture of the dialogue that is
// open in the end (it is closed), or a null image. Throws Error naming what is neither the key of
// an action that can be used, nor the words of a visible button.
QImage runAndPress(QWidget& window,
                   std::vector<ScreenshotPress> presses,
                   double forS,
                   double patienceS = 30.0);

}  // namespace palpate::gui
