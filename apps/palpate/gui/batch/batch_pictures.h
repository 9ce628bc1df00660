// Pictures as the work of a batch: of each recording the heat maps of its frame with the largest
// sum, or a movie of all its frames. As `palpate render`.
#pragma once

#include <QString>
#include <QStringList>

#include <palpate/batch/batch_run.h>
#include <palpate/filter/recipe.h>

#include "gui/appearance/color_map.h"

namespace palpate::gui {

// Speeds of a movie, as `palpate render` takes them.
inline constexpr double kMinBatchSpeed = 0.1;
inline constexpr double kMaxBatchSpeed = 16.0;

struct BatchPictureOptions {
  Recipe filters = {};
  ColorMapName map = ColorMapName::kInferno;
  // Smooth between the taxels; the value of every active taxel is printed.
  bool interpolated = false;
  bool values = false;
  // Of a movie: kMinBatchSpeed..kMaxBatchSpeed.
  double speed = 1.0;
};

// "png", "svg", "pdf", "mp4".
QStringList batchPictureForms();

// The ending of a result decides between picture and movie; `form` is one of the above. Throws
// std::invalid_argument (filters; a movie without the program ffmpeg; speed). Needs a
// QGuiApplication.
BatchTask picturesTask(const BatchPictureOptions& options, const QString& form);

}  // namespace palpate::gui
