// A recording as a MAT file of version 5, which every MATLAB since 1996 opens, and Octave and
// SciPy, too; docs/notes/exchange_formats.md has its structures. It is written only.
#pragma once

#include <filesystem>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/recording/recording_data.h>

namespace palpate {

// Writes PATH.mat, compressed, whole or not at all: a structure for each group of the HDF5 file
// (hdf5_recording.h), with fields of the names of its data sets. Arrays have the axes of those that
// MATLAB's h5read() returns, the first axis of the HDF5 file last: `tactile.m0` is columns x rows x
// frames. Frames are read once per matrix; memory is bounded but for 8 bytes per frame and sample.
//
// A MAT file of version 5 holds at most 2 GB per variable, here per structure. Throws FileError
// (also where a structure would be larger: nothing is written then), Cancelled, and what reading
// throws.
void writeMat(const RecordingContent& content,
              const std::filesystem::path& path,
              Overwrite overwrite = Overwrite::kRefuse,
              const Progress& progress = {});

}  // namespace palpate
