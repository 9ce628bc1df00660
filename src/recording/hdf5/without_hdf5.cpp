// The function of hdf5_recording.h that writes, in a program that does without HDF5.
#include "palpate/core/error.h"
#include "palpate/recording/hdf5_recording.h"

namespace palpate {

void writeHdf5(const RecordingContent&,
               const std::filesystem::path& path,
               Overwrite,
               const Progress&,
               const Hdf5WriteOptions&) {
  throw FileError(path, "this program is built without HDF5: use a name that ends in .h5 or .hdf5");
}

}  // namespace palpate
