#include "gui/picture_export.h"

#include <QBuffer>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QSvgGenerator>
#include <algorithm>
#include <cctype>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

constexpr int kPxPerInch = 96;
constexpr int kPdfDpi = 1200;          // resolution that positions in a PDF are rounded to
constexpr double kPointsPerPx = 0.75;  // 96 px = 72 pt = 1 inch

void paintOn(QPaintDevice& device,
             const QRectF& area,
             double scale,
             const TactileFrame& frame,
             const HandDescription& hand,
             const MatricesPictureOptions& options) {
  QPainter painter(&device);
  painter.scale(scale, scale);
  paintMatricesPicture(painter, area, frame, hand, options);
}

QByteArray svgBytes(const TactileFrame& frame,
                    const HandDescription& hand,
                    const MatricesPictureOptions& options) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(options.size.toSize());
  generator.setViewBox(QRectF(QPointF(), options.size));
  generator.setResolution(kPxPerInch);
  generator.setTitle(options.title);
  generator.setDescription(options.caption);
  paintOn(generator, QRectF(QPointF(), options.size), 1.0, frame, hand, options);
  return bytes;
}

QByteArray pdfBytes(const TactileFrame& frame,
                    const HandDescription& hand,
                    const MatricesPictureOptions& options) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setResolution(kPdfDpi);
  writer.setPageSize(QPageSize(options.size * kPointsPerPx, QPageSize::Point));
  writer.setPageMargins(QMarginsF());
  writer.setTitle(options.title);
  writer.setCreator("Palpate");
  paintOn(writer,
          QRectF(QPointF(), options.size),
          static_cast<double>(kPdfDpi) / kPxPerInch,
          frame,
          hand,
          options);
  return bytes;
}

QByteArray pngBytes(const std::filesystem::path& path, const QImage& image) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (!image.save(&buffer, "PNG")) throw FileError(path, "the picture can't be made into a PNG");
  return bytes;
}

void writeBytes(const std::filesystem::path& path, const QByteArray& bytes, Overwrite overwrite) {
  OutputFile file(path, overwrite);
  file.write({bytes.constData(), static_cast<std::size_t>(bytes.size())});
  file.commit();
}

}  // namespace

std::optional<PictureForm> pictureFormOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  if (ending == ".png") return PictureForm::kPng;
  if (ending == ".svg") return PictureForm::kSvg;
  if (ending == ".pdf") return PictureForm::kPdf;
  return std::nullopt;
}

QImage matricesImage(const TactileFrame& frame,
                     const HandDescription& hand,
                     MatricesPictureOptions options,
                     double scale) {
  QImage image((options.size * scale).toSize(), QImage::Format_RGB32);
  image.fill(colorsOf(options.theme).window);
  options.pixelRatio = scale;
  paintOn(image, QRectF(QPointF(), options.size), scale, frame, hand, options);
  return image;
}

void writeMatricesPicture(const std::filesystem::path& path,
                          const TactileFrame& frame,
                          const HandDescription& hand,
                          const MatricesPictureOptions& options,
                          Overwrite overwrite) {
  const auto form = pictureFormOf(path);
  if (!form) throw FileError(path, "a picture's name must end in .png, .svg or .pdf");
  QByteArray bytes;
  switch (*form) {
    case PictureForm::kPng:
      bytes = pngBytes(path, matricesImage(frame, hand, options));
      break;
    case PictureForm::kSvg:
      bytes = svgBytes(frame, hand, options);
      break;
    case PictureForm::kPdf:
      bytes = pdfBytes(frame, hand, options);
      break;
  }
  writeBytes(path, bytes, overwrite);
}

void writePng(const std::filesystem::path& path, const QImage& image, Overwrite overwrite) {
  writeBytes(path, pngBytes(path, image), overwrite);
}

}  // namespace palpate::gui
