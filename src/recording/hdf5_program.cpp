#include "palpate/recording/hdf5_program.h"

#include <cstring>
#include <system_error>

#include <dlfcn.h>

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr const char* kHdf5ProgramName = "palpate_hdf5";

fs::path& givenHdf5Program() {
  static fs::path given;
  return given;
}

// The file that this code was loaded from: the program, or the module that Python has loaded.
fs::path thisBinary() {
  std::error_code ignored;
  Dl_info self{};
  if (::dladdr(reinterpret_cast<const void*>(&hdf5Program), &self) != 0 && self.dli_fname &&
      std::strstr(self.dli_fname, ".so"))
    return fs::canonical(self.dli_fname, ignored);
  return fs::read_symlink("/proc/self/exe", ignored);
}

}  // namespace

fs::path hdf5Program() {
  if (!givenHdf5Program().empty()) return givenHdf5Program();
  const fs::path folder = thisBinary().parent_path();
  // build/tests/MODULE/TESTS; PREFIX/lib/python3/dist-packages/MODULE.
  constexpr int kLevels = 4;
  fs::path place = folder;
  for (int level = 0; level < kLevels; ++level, place = place.parent_path()) {
    std::error_code ignored;
    for (const fs::path& found : {place / kHdf5ProgramName, place / PALPATE_INSTALLED_HDF5})
      if (fs::is_regular_file(found, ignored)) return found;
  }
  return folder / kHdf5ProgramName;
}

void setHdf5Program(const fs::path& program) { givenHdf5Program() = program; }

}  // namespace palpate
