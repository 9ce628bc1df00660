// The preview of the Export dialog: shows the picture on its paper or the first rows of a table as
// they will be written, with the size in pixels, millimetres and bytes.
#pragma once

#include <QImage>
#include <QStringList>
#include <QTimer>
#include <QWidget>
#include <functional>

#include "gui/export/export_request.h"
#include "gui/picture/exported_view.h"
#include "gui/source/latest_answer.h"

namespace palpate::gui {

class ExportPreview : public QWidget {
  Q_OBJECT
 public:
  explicit ExportPreview(QWidget* parent = nullptr);

  // `view` must outlive this or be replaced before it is destroyed.
  void show(const ExportedView& view, const ExportRequest& request);
  // "1004 × 803 px · 85.0 × 68.0 mm · about 142 kB", "1350 × 1080 px · 12.4 s · 372 pictures";
  // bytes and seconds are added once they are computed.
  QString summary() const;
  // Size of one file [bytes]; 0 while it is unknown.
  double bytes() const noexcept { return bytes_; }
  // Number of files that will be written.
  std::size_t numFiles() const noexcept { return numFiles_; }

  // Waits for what is being measured, with events; for tests.
  void settle() { measuring_.settle(); }

  QSize sizeHint() const override { return {460, 420}; }
  QSize minimumSizeHint() const override { return {300, 260}; }

 signals:
  void summaryChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  // What takes long to find out.
  struct Measured {
    // The first lines of a table.
    QStringList rows = {};
    double bytes = 0.0;
    // Without its shots.
    MovieTiming movie = {};
  };
  using Measure = std::function<Measured(const Progress&)>;

  void drawPreview();
  void showTable(const ExportedView& view, const ExportRequest& request);
  void measure();
  void measureMovie();
  QRectF paperRect() const;
  void paintRows(QPainter& painter) const;

  ExportRequest request_;
  PicturePaper paper_;
  // What is exported; null: a table. It lives longer than the dialogue.
  const ExportedView* view_ = nullptr;
  PictureLook look_;
  // The picture at the size of its place on the screen, once it is painted.
  QImage preview_;
  bool isDrawn_ = false;
  bool isTable_ = false;
  QStringList rows_;
  std::size_t numRows_ = 0;
  std::size_t numFiles_ = 1;
  double bytes_ = 0.0;
  // Time stamps of the frames of a movie.
  FramePictures::TimeUs timeUs_;
  FrameSpan frames_;
  // Once it is computed.
  MovieTiming movie_;
  QTimer soon_;
  LatestAnswer<Measure, Measured> measuring_;
};

}  // namespace palpate::gui
