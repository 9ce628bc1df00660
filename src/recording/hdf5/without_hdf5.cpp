// The functions of hdf5_recording.h in a program that does without HDF5.
#include "palpate/core/error.h"
#include "palpate/recording/hdf5_recording.h"

namespace palpate {

void writeHdf5(const Hdf5Content&,
               const std::filesystem::path& path,
               Overwrite,
               const Progress&,
               const Hdf5WriteOptions&) {
  throw FileError(path, "HDF5 can't be written here: name a file that ends in .h5 or .hdf5");
}

Hdf5Recording readHdf5(const std::filesystem::path& path) {
  throw FileError(path,
                  "is an HDF5 file under another name: name it on the command line, or let its "
                  "name end in .h5");
}

}  // namespace palpate
