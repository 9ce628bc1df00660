// What several tests share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace palpate::testing {

// A folder of its own for each object, removed with all its content.
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

// The folder of real recordings ($PALPATE_RECORDINGS, else ../shared/data/recordings beside the
// project), or of independent numbers ($PALPATE_GOLDEN, else ../shared/golden); nothing when
// missing. With PALPATE_REQUIRE_DATA=1 a missing folder throws.
std::optional<std::filesystem::path> recordingsFolder();
std::optional<std::filesystem::path> goldenFolder();
// Whether a test may not be skipped for what this machine lacks, recordings or tools
// (PALPATE_REQUIRE_DATA=1).
bool mustShow();
// The project's own folder data/.
std::filesystem::path dataFolder();

// Whether every recording and every size is wanted (PALPATE_EXHAUSTIVE=1, the slow suite). Else
// tests over all shared recordings take those that differ, and a twentieth of the grasps by class,
// which are alike.
bool exhaustive();
// The .dsa files below `folder` that such a test takes, in the order of their paths.
std::vector<std::filesystem::path> recordingsToTry(const std::filesystem::path& folder);

std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace palpate::testing

// Ends the test: `why` it can't be shown on this machine. A failure where it must be.
#define PALPATE_CANNOT_SHOW(why)                       \
  do {                                                 \
    if (::palpate::testing::mustShow()) FAIL() << why; \
    GTEST_SKIP() << why;                               \
  } while (false)

// Ends the test as skipped where the real recordings (or golden numbers) are missing.
#define PALPATE_NEED(folder)                                            \
  if (!(folder))                                                        \
  GTEST_SKIP() << "shared data is missing: set PALPATE_RECORDINGS and " \
                  "PALPATE_GOLDEN"
