#include "palpate/recording/hdf5_program.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

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
      fs::path(self.dli_fname).filename().string().find(".so") != std::string::npos)
    return fs::canonical(self.dli_fname, ignored);
  return fs::read_symlink("/proc/self/exe", ignored);
}

bool isWithin(const fs::path& path, const fs::path& folder) {
  return std::mismatch(path.begin(), path.end(), folder.begin(), folder.end()).second ==
         folder.end();
}

// The prefix of an installation in which `folder` is this one, relative to it; empty: it is not.
fs::path prefixOf(fs::path folder, const fs::path& relative) {
  for (fs::path rest = relative; !rest.empty();
       rest = rest.parent_path(), folder = folder.parent_path())
    if (folder.filename() != rest.filename()) return {};
  return folder;
}

}  // namespace

fs::path hdf5Program() {
  return givenHdf5Program().empty() ? hdf5ProgramOf(thisBinary()) : givenHdf5Program();
}

fs::path hdf5ProgramOf(const fs::path& binary) {
  const fs::path folder = binary.parent_path();
  std::vector<fs::path> places = {folder};
  std::error_code ignored;
  const fs::path build = fs::canonical(PALPATE_BUILD_FOLDER, ignored);
  if (!build.empty() && isWithin(folder, build)) places.push_back(build);
  for (const char* relative : {PALPATE_INSTALLED_PROGRAMS, PALPATE_INSTALLED_PYTHON})
    if (const fs::path prefix = prefixOf(folder, relative); !prefix.empty())
      places.push_back(prefix / PALPATE_INSTALLED_HDF5);
  for (const fs::path& place : places)
    if (fs::is_regular_file(place / kHdf5ProgramName, ignored)) return place / kHdf5ProgramName;
  return folder / kHdf5ProgramName;
}

void setHdf5Program(const fs::path& program) { givenHdf5Program() = program; }

}  // namespace palpate
