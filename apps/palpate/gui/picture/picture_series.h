// Writes a picture of each frame of a range, as numbered files.
#pragma once

#include <cstddef>
#include <string>

#include <palpate/core/file_series.h>
#include <palpate/core/progress.h>

#include "gui/picture/exported_view.h"
#include "gui/picture/picture_export.h"

namespace palpate::gui {

struct SeriesReport {
  std::size_t written = 0;
  bool cancelled = false;
  // Why some files are missing: disk full, ..; empty: none is.
  std::string failure;
};

// Creates the folder if needed and writes one file after the other, each complete or not at all;
// files written before a cancel or a failure stay. Throws FileError before anything is written: the
// folder can't be created, or it contains some of these names and they may not be replaced.
SeriesReport writePictureSeries(const FileSeries& series,
                                const FramePictures::Paint& paint,
                                const PicturePaper& paper,
                                Overwrite overwrite = Overwrite::kRefuse,
                                const Progress& progress = {});

}  // namespace palpate::gui
