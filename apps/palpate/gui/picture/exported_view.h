// Describes how a view of the window is exported: as a picture, as a table, as a picture of each
// frame. The feature that owns the view supplies the functions; export_controller.h writes the
// files.
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

// Height of a chart on paper, of its width: curves in a low dock would be flat lines.
inline constexpr double kChartHeight = 0.5;
// Smallest height of a chart on paper [mm].
inline constexpr double kMinChartMm = 40.0;

// How a picture looks. The painter works in units; their size on paper is set by PicturePaper.
struct PictureLook {
  QSizeF size{900, 720};  // [units]
  // White background and dark ink, whatever the theme.
  bool forPrint = false;
  // Size of text [units]; 0: as on screen, one unit being one pixel.
  int textUnits = 0;
  // Whether the picture has a line with its subject and time.
  bool titled = true;
  // Whether a picture of values has the bar of its colours.
  bool colorBar = true;
  // Device pixels per unit; 0: a vector graphic, which has none.
  double pixelRatio = 0.0;

  // For paper, whose proportions need not be those of the screen.
  bool onPaper() const noexcept { return textUnits > 0; }
};

// Frames from first to last, both inclusive.
struct FrameSpan {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t count() const noexcept { return last - first + 1; }
  bool operator==(const FrameSpan&) const = default;
};

// How to paint a picture of each frame of a recording.
struct FramePictures {
  // Paints one frame. It is called in any thread, by one thread at a time, possibly long after its
  // creation; therefore it owns its data.
  using Paint = std::function<void(QPainter&, std::size_t frame)>;

  // Base of the file names: "ball" gives ball_00042.png.
  QString fileName;
  std::size_t numFrames = 0;
  std::optional<FrameSpan> selected = {};
  std::function<Paint(const PictureLook&)> painter;
  // The pictures have a colour bar, if the look wants one: that of the other such views, too.
  bool hasColorBar = false;
  // Time stamp of a frame [us], ascending; called under the same conditions as Paint. Empty: no
  // movie can be made.
  using TimeUs = std::function<std::int64_t(std::size_t frame)>;
  TimeUs timeUs = {};
};

// A table of the displayed data.
struct ExportedTable {
  // "seen range", "selected range".
  QString name;
  // Makes the table of the present moment; its rows are computed later, in any thread.
  std::function<TextTable()> make;
};

// All functions except those above are called in the thread of the window.
struct ExportedView {
  // Name in the export dialogue, for example "Matrices".
  QString name;
  // Views are offered in ascending rank.
  int rank = 0;
  // The widget that shows this view.
  QPointer<QWidget> widget;
  // Whether there is anything to export now.
  std::function<bool()> isThere;
  // Suggested name without folder and extension: "ball_frame_00042".
  std::function<QString()> fileName;
  // Size of the picture as on screen [px]; empty: that of the widget.
  std::function<QSizeF()> size = {};
  // Of a chart on paper: its smallest height, of its width (kChartHeight); 0: it has no chart.
  double minHeightShare = 0.0;
  // Size whose proportions a picture on paper has [px]; empty: that on screen, with minHeightShare.
  std::function<QSizeF()> proportions = {};
  // Empty: the view has no picture.
  std::function<void(QPainter&, const PictureLook&)> paint = {};
  // As that of FramePictures.
  bool hasColorBar = false;
  // Empty: the view has no tables.
  std::function<std::vector<ExportedTable>()> tables = {};
  // A picture of each frame as a part of several views (views_together.h), for a view that is not
  // offered as a movie of its own. Empty: framePictures.
  std::function<std::optional<FramePictures>()> framePart = {};
  // Empty: the view has no pictures of frames.
  std::function<std::optional<FramePictures>()> framePictures = {};

  QSizeF sizeOnScreen() const;
  // The size of a picture on paper of this width [mm], unless the user types another height.
  QSizeF sizeOnPaperMm(double widthMm) const;
  QSizeF proportionsNow() const;
  std::vector<ExportedTable> tablesNow() const;
  std::optional<FramePictures> framePicturesNow() const;
};

}  // namespace palpate::gui
