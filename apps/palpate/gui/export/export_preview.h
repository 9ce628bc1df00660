// What will be written, as it will look: the picture on its paper, or the first rows of a table;
// with its size in pixels, millimetres and bytes.
#pragma once

#include <QImage>
#include <QPicture>
#include <QStringList>
#include <QThreadPool>
#include <QTimer>
#include <QWidget>
#include <atomic>

#include "gui/export/export_request.h"
#include "gui/picture/exported_view.h"

namespace palpate::gui {

class ExportPreview : public QWidget {
  Q_OBJECT
 public:
  explicit ExportPreview(QWidget* parent = nullptr);
  ~ExportPreview() override;

  // `view` must outlive this or be replaced before.
  void show(const ExportedView& view, const ExportRequest& request);
  // "1004 × 803 px · 85.0 × 68.0 mm · about 142 kB", "1350 × 1080 px · 12.4 s · 372 pictures";
  // bytes and seconds come a moment later.
  QString summary() const;
  // Bytes of one file; 0 while they aren't known.
  double bytes() const noexcept { return bytes_; }
  // Files that will be written.
  std::size_t numFiles() const noexcept { return numFiles_; }

  QSize sizeHint() const override { return {460, 420}; }
  QSize minimumSizeHint() const override { return {300, 260}; }

 signals:
  void summaryChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void drawPreview();
  void showTable(const ExportedView& view, const ExportRequest& request);
  void measure();
  void measureMovie();
  QRectF paperRect() const;
  void paintRows(QPainter& painter) const;

  ExportRequest request_;
  PicturePaper paper_;
  QPicture picture_;
  QImage preview_;  // as large as its place on screen
  bool isTable_ = false;
  QStringList rows_;  // first lines of a table
  std::size_t numRows_ = 0;
  std::size_t numFiles_ = 1;
  double bytes_ = 0.0;
  FramePictures::TimeUs timeUs_;  // of a movie
  FrameSpan frames_;
  MovieTiming movie_;                // once it is known; its shots are not kept
  std::atomic<int> generation_ = 0;  // of what is measured
  QTimer soon_;
  QThreadPool worker_;
};

}  // namespace palpate::gui
