// Writes pictures as PNG, SVG or PDF files; the extension of the file decides which.
#pragma once

#include <QByteArray>
#include <QColor>
#include <QImage>
#include <QSizeF>
#include <QString>
#include <filesystem>
#include <functional>
#include <optional>

#include <palpate/core/output_file.h>

class QPainter;
class QPicture;

namespace palpate::gui {

enum class ImageFormat { kPng, kSvg, kPdf };

// The format by the extension, in lower or upper case; nothing for any other extension.
std::optional<ImageFormat> imageFormatOf(const std::filesystem::path& path);

// Size, resolution and background of an exported picture.
struct PicturePaper {
  QSizeF size{900, 720};  // [units] of the painter
  // Units per inch on paper.
  double unitsPerInch = 96.0;
  // Resolution of a PNG; its size in pixels is size / unitsPerInch * dpi.
  double dpi = 192.0;
  QColor background = Qt::white;
  // Title and description are stored in the metadata of the file.
  QString title = {};
  QString description = {};

  // Pixels of a PNG per unit.
  double scale() const { return dpi / unitsPerInch; }
  // Pixels of a PNG; at least 1 x 1.
  QSize pixels() const;
  QSizeF sizeMm() const;
};
// Paints a picture; the painter is scaled to units, with its origin at the top left.
using PaintPicture = std::function<void(QPainter&)>;

// Draws a recorded QPicture in the painter's own units; QPicture::play() would scale it by the
// resolution of the device.
void replay(QPainter& painter, const QPicture& picture);

// Paints into an image. Needs a QGuiApplication (fonts); may run in any thread if `paint` may.
QImage pictureImage(const PaintPicture& paint, const PicturePaper& paper);
// The content of the file. Throws FileError, which names `path`.
QByteArray pictureBytes(ImageFormat form,
                        const PaintPicture& paint,
                        const PicturePaper& paper,
                        const std::filesystem::path& path);
// Writes the complete file or nothing. Throws FileError: unknown extension, not writable, exists
// already (kRefuse).
void writePicture(const std::filesystem::path& path,
                  const PaintPicture& paint,
                  const PicturePaper& paper,
                  Overwrite overwrite = Overwrite::kRefuse);

// Writes an image as PNG, the complete file or nothing. Throws FileError.
void writePng(const std::filesystem::path& path, const QImage& image, Overwrite overwrite);

}  // namespace palpate::gui
