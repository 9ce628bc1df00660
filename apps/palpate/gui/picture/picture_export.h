// Pictures as files: PNG, SVG or PDF by the file's ending.
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

// By the ending, in small or capital letters; nothing for any other.
std::optional<ImageFormat> imageFormatOf(const std::filesystem::path& path);

// What a picture is painted on.
struct PicturePaper {
  QSizeF size{900, 720};       // [units], what the painter counts in
  double unitsPerInch = 96.0;  // so many of them are an inch on paper
  double dpi = 192.0;          // of a PNG; its pixels are size / unitsPerInch * dpi
  QColor background = Qt::white;
  QString title = {};  // both go into the file's own description
  QString description = {};

  double scale() const { return dpi / unitsPerInch; }  // pixels of a PNG per unit
  QSize pixels() const;                                // of a PNG; at least 1 x 1
  QSizeF sizeMm() const;
};
// Paints a picture; the painter is scaled to units and stands at the top left.
using PaintPicture = std::function<void(QPainter&)>;

// Draws what was recorded in the painter's own units. QPicture::play() would scale it by the
// resolution of the device.
void replay(QPainter& painter, const QPicture& picture);

// Needs a QGuiApplication (fonts); may run in any thread when `paint` may.
QImage pictureImage(const PaintPicture& paint, const PicturePaper& paper);
// The whole file. Throws FileError (which names `path`).
QByteArray pictureBytes(ImageFormat form,
                        const PaintPicture& paint,
                        const PicturePaper& paper,
                        const std::filesystem::path& path);
// Writes the whole file or nothing. Throws FileError: unknown ending, can't be written, exists
// already (kRefuse).
void writePicture(const std::filesystem::path& path,
                  const PaintPicture& paint,
                  const PicturePaper& paper,
                  Overwrite overwrite = Overwrite::kRefuse);

// Writes an image as PNG, whole or not at all. Throws FileError.
void writePng(const std::filesystem::path& path, const QImage& image, Overwrite overwrite);

}  // namespace palpate::gui
