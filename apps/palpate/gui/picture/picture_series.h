// A picture of each frame of a range, as numbered files.
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
  std::string failure;  // why not all of them are there: disk full, ..; empty: none
};

// Makes the folder where it isn't there, and one file after the other, each whole or not there:
// what was written before a cancel or a failure stays. Throws FileError before anything is written:
// the folder can't be made, or holds some of these names and they may not be replaced.
SeriesReport writePictureSeries(const FileSeries& series,
                                const FramePictures::Paint& paint,
                                const PicturePaper& paper,
                                Overwrite overwrite = Overwrite::kRefuse,
                                const Progress& progress = {});

}  // namespace palpate::gui
