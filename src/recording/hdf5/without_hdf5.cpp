// The functions that write HDF5, in a program that does without it.
#include "palpate/core/error.h"
#include "palpate/recording/hdf5_recording.h"

#include "recording/result_writers.h"

namespace palpate {
namespace {

[[noreturn]] void throwWithoutHdf5(const std::filesystem::path& path) {
  throw FileError(path,
                  "this program is built without HDF5: give a name that ends in .h5 or .hdf5, so "
                  "that palpate_window writes it");
}

}  // namespace

void writeHdf5(const RecordingContent&,
               const std::filesystem::path& path,
               Overwrite,
               const Progress&,
               const Hdf5WriteOptions&) {
  throwWithoutHdf5(path);
}

std::size_t writeHdf5Table(ResultTable&, const std::filesystem::path& path, Overwrite) {
  throwWithoutHdf5(path);
}

}  // namespace palpate
