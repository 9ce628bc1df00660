#include "gui/picture/picture_export.h"

#include <QBuffer>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QPicture>
#include <cmath>

#include <palpate/core/error.h>
#include <palpate/core/file_name.h>

#include "gui/picture/svg_device.h"

namespace palpate::gui {
namespace {

// Resolution to which positions in a PDF are rounded.
constexpr int kPdfDpi = 1200;
constexpr double kPictureExportMmPerInch = 25.4;
constexpr double kMPerInch = 0.0254;
constexpr double kPictureExportPointsPerInch = 72.0;

QByteArray svgBytes(const PaintPicture& paint, const PicturePaper& paper) {
  SvgDevice device(paper.size, paper.unitsPerInch);
  device.setTitle(paper.title, paper.description);
  QPainter painter(&device);
  paint(painter);
  painter.end();
  return device.bytes();
}

QByteArray pdfBytes(const PaintPicture& paint, const PicturePaper& paper) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setResolution(kPdfDpi);
  writer.setPageSize(QPageSize(paper.size / paper.unitsPerInch * kPictureExportPointsPerInch,
                               QPageSize::Point,
                               {},
                               QPageSize::ExactMatch));
  writer.setPageMargins(QMarginsF());
  writer.setTitle(paper.title);
  writer.setCreator("Palpate");
  QPainter painter(&writer);
  painter.scale(kPdfDpi / paper.unitsPerInch, kPdfDpi / paper.unitsPerInch);
  paint(painter);
  painter.end();
  return bytes;
}

QByteArray pngBytes(const std::filesystem::path& path, const QImage& image) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (image.isNull() || !image.save(&buffer, "PNG"))
    throw FileError(path, "the picture can't be made into a PNG; it may be too large");
  return bytes;
}

void writeBytes(const std::filesystem::path& path, const QByteArray& bytes, Overwrite overwrite) {
  OutputFile file(path, overwrite);
  file.write({bytes.constData(), static_cast<std::size_t>(bytes.size())});
  file.commit();
}

}  // namespace

QSize PicturePaper::pixels() const { return (size * scale()).toSize().expandedTo(QSize(1, 1)); }

QSizeF PicturePaper::sizeMm() const { return size / unitsPerInch * kPictureExportMmPerInch; }

std::optional<ImageFormat> imageFormatOf(const std::filesystem::path& path) {
  const std::string ending = lowerEndingOf(path);
  if (ending == ".png") return ImageFormat::kPng;
  if (ending == ".svg") return ImageFormat::kSvg;
  if (ending == ".pdf") return ImageFormat::kPdf;
  return std::nullopt;
}

void replay(QPainter& painter, const QPicture& picture) {
  painter.save();
  painter.scale(static_cast<double>(picture.logicalDpiX()) / painter.device()->logicalDpiX(),
                static_cast<double>(picture.logicalDpiY()) / painter.device()->logicalDpiY());
  painter.drawPicture(QPointF(), picture);
  painter.restore();
}

QImage pictureImage(const PaintPicture& paint, const PicturePaper& paper) {
  QImage image(paper.pixels(), QImage::Format_RGB32);
  // Not enough memory.
  if (image.isNull()) return image;
  image.fill(paper.background);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.scale(paper.scale(), paper.scale());
  paint(painter);
  painter.end();
  // Set after painting, since a painter would scale fonts by it.
  const int dotsPerM = static_cast<int>(std::lround(paper.dpi / kMPerInch));
  image.setDotsPerMeterX(dotsPerM);
  image.setDotsPerMeterY(dotsPerM);
  if (!paper.title.isEmpty()) image.setText("Title", paper.title);
  if (!paper.description.isEmpty()) image.setText("Description", paper.description);
  image.setText("Software", "Palpate");
  return image;
}

QByteArray pictureBytes(ImageFormat form,
                        const PaintPicture& paint,
                        const PicturePaper& paper,
                        const std::filesystem::path& path) {
  switch (form) {
    case ImageFormat::kSvg:
      return svgBytes(paint, paper);
    case ImageFormat::kPdf:
      return pdfBytes(paint, paper);
    case ImageFormat::kPng:
      break;
  }
  return pngBytes(path, pictureImage(paint, paper));
}

void writePicture(const std::filesystem::path& path,
                  const PaintPicture& paint,
                  const PicturePaper& paper,
                  Overwrite overwrite) {
  const auto form = imageFormatOf(path);
  if (!form) throw FileError(path, "a picture's name must end in .png, .svg or .pdf");
  // Fails before the work, not after it.
  requireWritable(path, overwrite);
  writeBytes(path, pictureBytes(*form, paint, paper, path), overwrite);
}

void writePng(const std::filesystem::path& path, const QImage& image, Overwrite overwrite) {
  writeBytes(path, pngBytes(path, image), overwrite);
}

}  // namespace palpate::gui
