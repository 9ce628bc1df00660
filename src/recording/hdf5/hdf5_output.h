// A new HDF5 file that exists completely or not at all. The library writes through a driver of our
// own into an OutputFile: a failed write (disk full) is remembered with its cause, and the library
// doesn't notice it, because it can neither close a file that it can't write, nor report why.
// Private to this module.
#pragma once

#include <filesystem>

#include "palpate/core/output_file.h"

#include "recording/hdf5_library.h"

namespace palpate {

class Hdf5Output {
 public:
  // Throws FileError as OutputFile does, and when another program writes the file that would be
  // replaced.
  Hdf5Output(const std::filesystem::path& path, Overwrite overwrite);

  hid_t file() const noexcept { return file_.get(); }
  // Throws FileError with the cause when something could not be written so far.
  void requireWritten() const;
  // Throws as requireWritten(), or where `ok` is false: the library refused.
  void require(bool ok) const;
  // Closes the file and gives it its name. Throws FileError.
  void commit();

 private:
  OutputFile out_;
  int error_ = 0;  // errno of the first failed write
  Hdf5Id driver_;
  Hdf5Id file_;
};

}  // namespace palpate
