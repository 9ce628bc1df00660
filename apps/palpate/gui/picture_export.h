// Pictures of one frame as files: PNG, SVG or PDF by the file's ending.
#pragma once

#include <QByteArray>
#include <QImage>
#include <filesystem>

#include <palpate/core/output_file.h>

#include "gui/matrices_painter.h"

namespace palpate::gui {

enum class PictureForm { kPng, kSvg, kPdf };

// By the ending, in small or capital letters; nothing for any other.
std::optional<PictureForm> pictureFormOf(const std::filesystem::path& path);

// The picture as an image, `scale` device pixels per pixel of options.size.
QImage matricesImage(const TactileFrame& frame,
                     const HandDescription& hand,
                     MatricesPictureOptions options,
                     double scale = 2.0);

// Needs a QGuiApplication (fonts); may run in any thread. Writes the whole file or nothing. Throws
// FileError: unknown ending, can't be written, exists already (kRefuse).
void writeMatricesPicture(const std::filesystem::path& path,
                          const TactileFrame& frame,
                          const HandDescription& hand,
                          const MatricesPictureOptions& options,
                          Overwrite overwrite = Overwrite::kRefuse);

// Writes an image as PNG, whole or not at all. Throws FileError.
void writePng(const std::filesystem::path& path, const QImage& image, Overwrite overwrite);

}  // namespace palpate::gui
