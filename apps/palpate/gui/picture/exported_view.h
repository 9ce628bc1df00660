// A view that can be taken away: as a picture, as a table, as a picture of each frame. Whoever owns
// the view says how; export_controller.h does the rest.
#pragma once

#include <QPointer>
#include <QSizeF>
#include <QString>
#include <QWidget>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <palpate/core/text_table.h>

class QPainter;

namespace palpate::gui {

// How a picture shall look. The painter counts in units; how large one is on paper is not the
// view's business.
struct PictureLook {
  QSizeF size{900, 720};    // [units]
  bool forPrint = false;    // white ground, dark ink, whatever the theme
  int textUnits = 0;        // size of text [units]; 0: as on screen, a unit being a pixel
  bool titled = true;       // with a line that says what of, and when
  double pixelRatio = 0.0;  // device pixels per unit; 0: none, it is a vector graphic
};

// Frames from first to last, both inclusive.
struct FrameSpan {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t count() const noexcept { return last - first + 1; }
  bool operator==(const FrameSpan&) const = default;
};

// A picture of each frame.
struct FramePictures {
  // Paints one frame. Called in any thread, by one at a time, long after it was made: holds its
  // data itself.
  using Paint = std::function<void(QPainter&, std::size_t frame)>;

  QString fileName;  // "ball": its files are ball_00042.png
  std::size_t numFrames = 0;
  std::optional<FrameSpan> selected = {};
  std::function<Paint(const PictureLook&)> painter;
  // Stamp of a frame [us], ascending; called as Paint is. Empty: there is no movie of it.
  using TimeUs = std::function<std::int64_t(std::size_t frame)>;
  TimeUs timeUs = {};
};

// Rows of what is shown.
struct ExportedTable {
  QString name;  // "seen range", "selected range"
  // Of this moment; its rows are made later, in any thread.
  std::function<TextTable()> make;
};

// All functions but those above are called in the window's thread.
struct ExportedView {
  QString name;                       // "Matrices"
  int rank = 0;                       // offered in this order
  QPointer<QWidget> widget;           // whose part of the window is this view
  std::function<bool()> isThere;      // is there anything to take away now
  std::function<QString()> fileName;  // suggested, without folder and ending: "ball_frame_00042"
  std::function<QSizeF()> size = {};  // of the picture as on screen [px]; empty: the widget's
  std::function<void(QPainter&, const PictureLook&)> paint = {};     // empty: no picture
  std::function<std::vector<ExportedTable>()> tables = {};           // empty: none
  std::function<std::optional<FramePictures>()> framePictures = {};  // empty: none

  QSizeF sizeOnScreen() const;
  std::vector<ExportedTable> tablesNow() const;
  std::optional<FramePictures> framePicturesNow() const;
};

}  // namespace palpate::gui
