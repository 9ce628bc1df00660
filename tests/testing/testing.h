// Helpers for many tests: temporary folders, test data, files, and skipping.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace palpate::testing {

// A new temporary folder for each object; the destructor removes it with its content.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const noexcept { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// The folder of real recordings ($PALPATE_RECORDINGS, else ../shared/data/recordings relative to
// the project), or of independent reference numbers ($PALPATE_GOLDEN, else ../shared/golden);
// nothing when it is missing. With PALPATE_REQUIRE_DATA=1 a missing folder throws.
std::optional<std::filesystem::path> recordingsFolder();
// The folder of other makers' files ($PALPATE_ARRAYS, else ../shared/data/arrays), likewise.
std::optional<std::filesystem::path> arraysFolder();
std::optional<std::filesystem::path> goldenFolder();
// Whether tests must not be skipped when recordings or tools are missing on this machine
// (PALPATE_REQUIRE_DATA=1).
bool mustShow();
// The folder data/ of the project.
std::filesystem::path dataFolder();

// Whether tests run with every recording and every size (PALPATE_EXHAUSTIVE=1, the slow suite).
// Otherwise tests over all shared recordings use those that differ, and one in twenty of the grasps
// by class, which are alike.
bool exhaustive();
// The .dsa files below `folder` that such a test uses, ordered by path.
std::vector<std::filesystem::path> recordingsToTry(const std::filesystem::path& folder);

std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace palpate::testing

// Skips the test with the reason `why`; fails it when mustShow().
#define PALPATE_CANNOT_SHOW(why)                       \
  do {                                                 \
    if (::palpate::testing::mustShow()) FAIL() << why; \
    GTEST_SKIP() << why;                               \
  } while (false)

// Skips the test when the real recordings (or reference numbers) are missing.
#define PALPATE_NEED(folder)                                            \
  if (!(folder))                                                        \
  GTEST_SKIP() << "shared data is missing: set PALPATE_RECORDINGS and " \
                  "PALPATE_GOLDEN"
