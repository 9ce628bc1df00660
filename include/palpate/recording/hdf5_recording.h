// A recording as an HDF5 file, which h5py, MATLAB, HDFView and others open;
// docs/notes/exchange_formats.md has its layout. It holds all of a recording (frames, stamps,
// series, events, hand, what was said of it) bit by bit, so that it can be read back, and beside
// that where it comes from and series that were computed of its frames.
//
// Files are read by a process of its own, palpate_hdf5, whose memory and processor time are
// limited: libhdf5 crashes and hangs on files that anybody can make. A program that does without
// HDF5 (CMake property PALPATE_WITHOUT_HDF5) has writeHdf5(), too: there it throws Error.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording_data.h>

namespace palpate {

// The newest version of the layout that is read. Only recordings with readings are written in it,
// for `mN_readings`; those with further series, or with taxels that aren't square (`pitch_y_mm`),
// have version 3, with filtered frames version 2, for `mN_kept`, and all others version 1, so that
// earlier programs read them.
constexpr int kHdf5LayoutVersion = 4;

// The first bytes of what writeHdf5() writes, and of HDF5 files without a user block.
constexpr std::string_view kHdf5RecordingStart = "Palpate recording in HDF5\n";
constexpr std::string_view kHdf5Signature{"\x89HDF\r\n\x1a\n", 8};
// Whether the first bytes of a file (26 or more, if the file has that many) are those of HDF5.
constexpr bool startsLikeHdf5(std::string_view first) noexcept {
  return first.starts_with(kHdf5RecordingStart) || first.starts_with(kHdf5Signature);
}

struct Hdf5WriteOptions {
  int level = 1;  // of the compression (deflate), 0..9
  // Threads that compress; 0: as many as the machine runs at once. The file is the same.
  std::size_t threads = 0;
};

// Writes PATH, whole or not at all. Memory is bounded, whatever the length of the recording. Throws
// FileError, Cancelled, std::invalid_argument (a level out of range), and what reading throws.
void writeHdf5(const RecordingContent& content,
               const std::filesystem::path& path,
               Overwrite overwrite = Overwrite::kRefuse,
               const Progress& progress = {},
               const Hdf5WriteOptions& options = {});

// Opens what writeHdf5() has made. The whole file is read once for its checksum. A part of the
// stamps lies in memory; frames and samples are read when they are asked for, and the
// profile is safe from several threads. The process that reads it lives as long as the profile.
// Throws FileError (also when palpate_hdf5 can't be started); FormatError where it is damaged, cut
// off or changed, another program's (palpate import reads those), of a newer layout, refers to
// other files, claims more than it holds, is compressed by a filter that is not there, or libhdf5
// could not read it: it crashed, took more than 2 s of a processor for one step, or more than 256
// MB of memory.
Recording readHdf5(const std::filesystem::path& path);

}  // namespace palpate
