#include "python/profile_pickle.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include <pybind11/stl.h>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;
namespace fs = std::filesystem;
namespace {

// A folder that is removed with what lies in it.
class PickleFolder {
 public:
  PickleFolder() {
    std::string pattern = fs::temp_directory_path() / "palpate-pickle-XXXXXX";
    if (!mkdtemp(pattern.data()))
      throw FileError(pattern, "can't be made: " + std::generic_category().message(errno));
    path_ = pattern;
  }
  ~PickleFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PickleFolder(const PickleFolder&) = delete;
  PickleFolder& operator=(const PickleFolder&) = delete;
  fs::path recording() const { return path_ / "profile.palpate"; }

 private:
  fs::path path_;
};

// All samples in memory, so that the file isn't needed any more.
Profile inMemory(const Profile& profile, ProfileInfo info) {
  ProfileBuilder builder(profile.hand());
  builder.setBaselines(profile.baselines());
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    builder.addFrame(frame);
  }
  for (std::size_t s = 0; s < profile.series().size(); ++s) {
    if (s >= kHandSeries) builder.addSeries(profile.series()[s]);
    for (std::size_t i = 0; i < profile.numSamples(s); ++i) builder.addSample(profile.sample(s, i));
  }
  return builder.finish(std::move(info));
}

}  // namespace

py::tuple pickledProfile(const Profile& profile) {
  const std::string bytes = unlocked([&](const Progress& progress) {
    const PickleFolder folder;
    saveRecording(profile,
                  baselineEvents(profile.baselines()),
                  folder.recording(),
                  Overwrite::kRefuse,
                  progress);
    std::ifstream in(folder.recording(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  });
  return py::make_tuple(py::bytes(bytes), profile.info().format, profile.info().warnings);
}

Profile unpickledProfile(const py::tuple& state) {
  if (state.size() != 3) throw py::value_error("this isn't a pickled palpate.Profile");
  const auto bytes = state[0].cast<std::string>();
  const auto format = state[1].cast<std::string>();
  const auto warnings = state[2].cast<std::vector<std::string>>();
  return unlocked([&](const Progress& progress) {
    const PickleFolder folder;
    std::ofstream out(folder.recording(), std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw FileError(folder.recording(), "can't be written");
    const Profile read = openRecording(folder.recording(), progress);
    ProfileInfo info = read.info();
    info.format = format;
    info.warnings = warnings;
    return inMemory(read, std::move(info));
  });
}

}  // namespace palpate::python
