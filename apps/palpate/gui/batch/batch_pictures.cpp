#include "gui/batch/batch_pictures.h"

#include <QGuiApplication>
#include <algorithm>
#include <stdexcept>
#include <string>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/recognition/filtered_recording.h>
#include <palpate/recording/recording.h>
#include <palpate/signals/characteristic_signals.h>

#include "gui/appearance/captions.h"
#include "gui/matrices/matrices_frame_painter.h"
#include "gui/picture/ffmpeg.h"
#include "gui/picture/movie_writer.h"
#include "gui/picture/picture_export.h"

namespace palpate::gui {
namespace {

constexpr const char* kBatchMovie = "mp4";
constexpr double kBatchMovieDpi = 96.0;  // one pixel per unit
constexpr double kBatchReading = 0.2;    // part of the progress

FramePictures::Paint batchPainter(const Profile& profile, const MatricesPictureOptions& options) {
  return [profile, options](QPainter& painter, std::size_t frame) {
    MatricesPictureOptions now = options;
    now.caption = captionOf(profile, frame);
    paintMatricesPicture(
        painter, QRectF(QPointF(), now.size), profile.frame(frame), profile.hand(), now);
  };
}

// The largest value of all frames, so that a movie has one range of colours.
double largestValue(const Profile& profile) {
  float largest = 0.0F;
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    for (const float value : frame.values) largest = std::max(largest, value);
  }
  return largest > 0.0F ? static_cast<double>(largest) : 1.0;
}

BatchAnswer drawBatchPicture(const BatchPictureOptions& batch,
                             MatricesPictureOptions options,
                             const BatchItem& item,
                             Overwrite overwrite,
                             const Progress& progress,
                             std::size_t threads) {
  const Recording whole =
      readRecording(item.source, {.threads = threads}, partOf(progress, 0.0, kBatchReading));
  const Profile profile = filteredBy(batch.filters, whole, item.source);
  const std::string lost = lostText(whole.profile);
  const std::string problem = lost.empty() ? lost : item.source.string() + ": " + lost;
  if (profile.numFrames() == 0) throw FileError(item.source, "has no frame to draw");
  options.title = pathText(item.source.filename());
  PicturePaper paper;
  paper.size = options.size;
  paper.title = options.title;
  paper.background = colorsOf(options.theme).window;
  if (item.target.extension() != std::string(".") + kBatchMovie) {
    const std::size_t frame = SignalTable::of(profile).frameOfLargestSum();
    if (imageFormatOf(item.target) == ImageFormat::kPng) options.pixelRatio = paper.scale();
    const auto paint = batchPainter(profile, options);
    writePicture(
        item.target, [&](QPainter& painter) { paint(painter, frame); }, paper, overwrite);
    return {.said = "frame " + std::to_string(frame), .problem = problem};
  }
  paper.dpi = kBatchMovieDpi;
  options.pixelRatio = paper.scale();
  options.rangeMax = largestValue(profile);
  const FrameSpan span{0, profile.numFrames() - 1};
  MovieOptions movie;
  movie.speed = batch.speed;
  writeMovie(item.target,
             plannedMovie(
                 span, [&](std::size_t frame) { return profile.frameTimeUs(frame); }, movie),
             batchPainter(profile, options),
             paper,
             overwrite,
             partOf(progress, kBatchReading, 1.0));
  return {.said = counted(span.count(), "frame"), .problem = problem};
}

}  // namespace

QStringList batchPictureForms() { return {"png", "svg", "pdf", kBatchMovie}; }

BatchTask picturesTask(const BatchPictureOptions& batch, const QString& form) {
  batch.filters.validate();
  if (form == kBatchMovie && !findFfmpeg()) throw std::invalid_argument(ffmpegMissing());
  if (!(batch.speed >= kMinBatchSpeed && batch.speed <= kMaxBatchSpeed))
    throw std::invalid_argument("the speed of a movie is 0.1 to 16");
  MatricesPictureOptions options;
  options.map = batch.map;
  options.interpolated = batch.interpolated;
  options.values = batch.values;
  options.font = QGuiApplication::font();
  std::string text = std::string("pictures; ") + nameOf(batch.map) + "; " +
                     recipeText(batch.filters) + (batch.interpolated ? "; interpolated" : "") +
                     (batch.values ? "; values" : "");
  if (form == kBatchMovie) text += "; speed " + numberText(batch.speed);
  return {.options = text,
          .work = [batch, options](const BatchItem& item,
                                   Overwrite overwrite,
                                   const Progress& progress,
                                   std::size_t threads) {
            return drawBatchPicture(batch, options, item, overwrite, progress, threads);
          }};
}

}  // namespace palpate::gui
