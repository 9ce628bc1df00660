#include "gui/export/export_preview.h"

#include <QFontDatabase>
#include <QFontMetricsF>
#include <QPainter>
#include <QPicture>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/export/export_work.h"
#include "gui/picture/movie_writer.h"

namespace palpate::gui {
namespace {

constexpr double kExportPreviewAround = 16.0;  // [px] around the paper
constexpr int kMeasureAfterMs = 200;           // waits for several steps of a spin box
constexpr std::size_t kPreviewRows = 40;
constexpr std::size_t kMeasuredRows = 400;  // sample for the mean length of a row

}  // namespace

ExportPreview::ExportPreview(QWidget* parent)
    : QWidget(parent),
      measuring_(
          [](const Measure& measure, const Progress& progress, const auto&) {
            return measure(progress);
          },
          [this](const Measured& measured) {
            rows_ = measured.rows;
            bytes_ = measured.bytes;
            movie_ = measured.movie;
            update();
            emit summaryChanged();
          },
          // The picture is too large for the memory, or the file is gone: the export reports
          // it, and the size in pixels is still shown.
          [](const QString&) {}) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  soon_.setSingleShot(true);
  soon_.setInterval(kMeasureAfterMs);
  connect(&soon_, &QTimer::timeout, this, &ExportPreview::measure);
}

void ExportPreview::show(const ExportedView& view, const ExportRequest& request) {
  // Until its rows are read again, those of the same table stay.
  if (request.view != request_.view || request.table != request_.table) rows_.clear();
  request_ = request;
  isTable_ = request.form == ExportFormat::kCsv;
  bytes_ = 0.0;
  numFiles_ = 1;
  movie_ = {};
  measuring_.abandon();
  soon_.stop();
  view_ = nullptr;
  if (isTable_) {
    showTable(view, request);
  } else if (view.paint) {
    paper_ = paperOf(request, view.sizeOnScreen());
    view_ = &view;
    look_ = lookOf(request, view.sizeOnScreen());
    const auto pictures = request.ofFrames() ? view.framePicturesNow() : std::nullopt;
    const auto span = pictures ? spanOf(request, *pictures) : std::nullopt;
    if (request.isSeries() && span) numFiles_ = span->count();
    timeUs_ = span ? pictures->timeUs : nullptr;
    if (span) frames_ = *span;
    isDrawn_ = false;
    soon_.start();
  }
  update();
  emit summaryChanged();
}

// Rows of a long recording are read from its file: in the background, as all that is measured.
void ExportPreview::showTable(const ExportedView& view, const ExportRequest& request) {
  numRows_ = 0;
  const auto tables = view.tablesNow();
  const ExportedTable* chosen = nullptr;
  for (const ExportedTable& table : tables)
    if (!chosen || table.name == request.table) chosen = &table;
  if (!chosen) return rows_.clear();
  const TextTable table = chosen->make();
  numRows_ = table.numRows;
  measuring_.ask([table](const Progress& progress) {
    Measured measured;
    measured.rows =
        QString::fromStdString(csvText(table, kPreviewRows)).split('\n', Qt::SkipEmptyParts);
    const std::size_t count = std::min(table.numRows, kMeasuredRows);
    double length = 0.0;
    // Samples rows from the whole table, because later rows have longer numbers.
    for (std::size_t i = 0; i < count; ++i) {
      reportProgress(progress, i, count);
      length += static_cast<double>(csvLine(table.row(i * table.numRows / count)).size());
    }
    measured.bytes = static_cast<double>(csvLine(table.header).size());
    if (count > 0)
      measured.bytes += length / static_cast<double>(count) * static_cast<double>(table.numRows);
    return measured;
  });
}

void ExportPreview::measure() {
  if (request_.isMovie()) return measureMovie();
  if (!view_) return;
  const ImageFormat form = request_.form == ExportFormat::kSvg   ? ImageFormat::kSvg
                           : request_.form == ExportFormat::kPdf ? ImageFormat::kPdf
                                                                 : ImageFormat::kPng;
  // Writes the file in memory.
  measuring_.ask([picture = pictureOf(*view_, look_), paper = paper_, form](const Progress&) {
    const auto paint = [&](QPainter& painter) { replay(painter, picture); };
    Measured measured;
    measured.bytes = static_cast<double>(pictureBytes(form, paint, paper, "preview").size());
    return measured;
  });
}

// A recording of a day has millions of time stamps.
void ExportPreview::measureMovie() {
  if (!timeUs_) return;
  measuring_.ask([timeUs = timeUs_, frames = frames_, options = movieOptionsOf(request_)](
                     const Progress& progress) {
    Measured measured;
    measured.movie = plannedMovie(frames, timeUs, options, progress).timing;
    measured.movie.shots.clear();
    return measured;
  });
}

QString ExportPreview::summary() const {
  QStringList parts;
  if (request_.isMovie()) {
    const QSize pixels = moviePixels(paper_);
    parts << QString("%1 × %2 px").arg(pixels.width()).arg(pixels.height());
    if (movie_.numPictures > 0)
      parts << figure(movie_.seconds, 1) + " s"
            << (movie_.numPictures == 1 ? QString("1 picture")
                                        : QString("%1 pictures").arg(movie_.numPictures));
    if (movie_.numGaps > 0)
      parts << (movie_.numGaps == 1 ? QString("1 gap shortened")
                                    : QString("%1 gaps shortened").arg(movie_.numGaps));
    return parts.join(" · ");
  }
  if (isTable_) {
    parts << (numRows_ == 1 ? QString("1 row") : QString("%1 rows").arg(numRows_));
  } else {
    const QSizeF mm = paper_.sizeMm();
    if (request_.form == ExportFormat::kPng)
      parts << QString("%1 × %2 px").arg(paper_.pixels().width()).arg(paper_.pixels().height());
    parts << figure(mm.width(), 1) + " × " + figure(mm.height(), 1) + " mm";
  }
  if (numFiles_ > 1) parts << QString("%1 pictures").arg(numFiles_);
  if (bytes_ > 0.0)
    parts << "about " + bytesText(bytes_ * static_cast<double>(numFiles_)) +
                 (numFiles_ > 1 ? " in all" : "");
  return parts.join(" · ");
}

QRectF ExportPreview::paperRect() const {
  const QRectF room = QRectF(rect()).adjusted(
      kExportPreviewAround, kExportPreviewAround, -kExportPreviewAround, -kExportPreviewAround);
  const QSizeF size = paper_.size.scaled(room.size(), Qt::KeepAspectRatio);
  return {room.center() - QPointF(size.width() / 2, size.height() / 2), size};
}

// Draws the picture larger than shown and scales it down, so that details finer than a screen pixel
// look as in the file. Images in it, as of the hand, have the pixels that are shown, not all of the
// file: they would take longer than all the rest.
void ExportPreview::drawPreview() {
  constexpr double kFiner = 3.0;
  const QSizeF place = paperRect().size() * devicePixelRatioF();
  isDrawn_ = true;
  if (isTable_ || !view_ || place.width() < 1.0 || place.height() < 1.0) return;
  PictureLook shown = look_;
  shown.pixelRatio = place.width() / paper_.size.width();
  const QPicture picture = pictureOf(*view_, shown);
  PicturePaper larger = paper_;
  larger.dpi = kFiner * place.width() / paper_.size.width() * paper_.unitsPerInch;
  preview_ = pictureImage([&picture](QPainter& to) { replay(to, picture); }, larger)
                 .scaled(place.toSize(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

void ExportPreview::resizeEvent(QResizeEvent*) { isDrawn_ = false; }

void ExportPreview::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (isTable_) return paintRows(painter);
  if (!isDrawn_) drawPreview();
  const QRectF paper = paperRect();
  constexpr int kShadow = 4;
  for (int i = kShadow; i > 0; --i)
    painter.fillRect(paper.adjusted(-i + 1, -i + 2, i - 1, i + 1), QColor(0, 0, 0, 14));
  painter.drawImage(paper, preview_);
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(paper);
}

void ExportPreview::paintRows(QPainter& painter) const {
  const QRectF room = QRectF(rect()).adjusted(
      kExportPreviewAround, kExportPreviewAround, -kExportPreviewAround, -kExportPreviewAround);
  painter.fillRect(room, palette().color(QPalette::Base));
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(room);
  painter.setClipRect(room.adjusted(8, 6, -8, -6));
  QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
  font.setPixelSize(11);
  painter.setFont(font);
  const QFontMetricsF metrics(font);
  double y = room.top() + 8.0;
  bool isHeader = true;
  for (const QString& row : rows_) {
    if (y > room.bottom()) break;
    painter.setPen(palette().color(isHeader ? QPalette::PlaceholderText : QPalette::Text));
    painter.drawText(QRectF(room.left() + 10, y, room.width() - 20, metrics.height()),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(row, Qt::ElideRight, room.width() - 20));
    y += metrics.height() * 1.25;
    isHeader = false;
  }
  if (numRows_ > 0) return;
  painter.setPen(palette().color(QPalette::PlaceholderText));
  painter.drawText(room, Qt::AlignCenter, "no row");
}

}  // namespace palpate::gui
