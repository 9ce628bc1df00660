// The row of .h5 in the table of formats.
#include "palpate/recording/hdf5_recording.h"
#include "palpate/recording/recording_format.h"

#include "recording/format_reader.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

Recording openHdf5(const fs::path& path, const ReadOptions&, const Progress&) {
  return readHdf5(path);
}

Recording openReadableHdf5(const fs::path& path, const ReadOptions&, const Progress& progress) {
  Recording recording = readHdf5(path);
  readThrough(recording.profile, progress);
  return recording;
}

VerifyReport verifyHdf5(const fs::path& path, std::size_t, const Progress& progress) {
  return {VerifyReport::State::kSound, countsText(openReadableHdf5(path, {}, progress).profile)};
}

SaveReport saveHdf5(const SaveJob& job) {
  writeHdf5(job.content, job.path, job.overwrite, job.progress);
  return {};
}

constexpr const char* kHdf5Endings[] = {".h5", ".hdf5"};
constexpr FormatReader kHdf5Reader{
    .recognises = [](std::string_view begin, const std::string&) { return startsLikeHdf5(begin); },
    .open = &openHdf5,
    .openReadable = &openReadableHdf5,
    .verify = &verifyHdf5,
    .cantRecover =
        "is an HDF5 file; if it is damaged, nothing of it can be recovered: use the "
        "recording that it was exported from",
    .events = [](const fs::path& path) { return EventsReport{readHdf5(path).events}; },
    .meta = [](const fs::path& path) { return readHdf5(path).meta; },
    .kind = "an HDF5 file"};

}  // namespace

constinit const RecordingFormat kHdf5Format{.name = "hdf5",
                                            .purpose = "HDF5",
                                            .endings = kHdf5Endings,
                                            .isExport = true,
                                            .takesSeries = true,
                                            .holdsFurther = true,
                                            .holdsReadings = true,
                                            .reader = &kHdf5Reader,
                                            .save = &saveHdf5};

}  // namespace palpate
