#include "gui/picture/picture_series.h"

#include <system_error>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace fs = std::filesystem;

SeriesReport writePictureSeries(const FileSeries& series,
                                const FramePictures::Paint& paint,
                                const PicturePaper& paper,
                                Overwrite overwrite,
                                const Progress& progress) {
  std::error_code failure;
  fs::create_directories(series.folder, failure);
  if (failure) throw FileError(series.folder, "can't be created as a folder: " + failure.message());
  if (overwrite == Overwrite::kRefuse)
    if (const std::size_t there = numExisting(series); there > 0)
      throw FileError(series.folder,
                      "holds " + std::to_string(there) + " of these " +
                          std::to_string(series.count()) +
                          " pictures already; give another folder, or --force to replace them");
  SeriesReport report;
  for (std::size_t i = 0; i < series.count(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(series.count());
    if (progress && !progress(done)) {
      report.cancelled = true;
      return report;
    }
    const std::size_t frame = series.first + i;
    try {
      writePicture(
          series.path(frame), [&](QPainter& painter) { paint(painter, frame); }, paper, overwrite);
    } catch (const Error& error) {
      report.failure = error.what();
      return report;
    }
    ++report.written;
  }
  if (progress) progress(1.0);
  return report;
}

}  // namespace palpate::gui
