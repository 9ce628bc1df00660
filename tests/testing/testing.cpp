#include "testing/testing.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace palpate::testing {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "palpate-test-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder: " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

bool mustShow() {
  const char* required = std::getenv("PALPATE_REQUIRE_DATA");
  return required && std::string_view(required) == "1";
}

namespace {
std::optional<fs::path> sharedFolder(const char* variable, const char* fallback) {
  const char* given = std::getenv(variable);
  const fs::path path = given && *given ? fs::path(given) : fs::path(PALPATE_SOURCE_DIR) / fallback;
  if (fs::is_directory(path)) return path;
  if (mustShow())
    throw std::runtime_error(std::string(variable) + ": no such folder: " + path.string());
  return std::nullopt;
}
}  // namespace

std::optional<fs::path> recordingsFolder() {
  return sharedFolder("PALPATE_RECORDINGS", "../shared/data/recordings");
}
std::optional<fs::path> arraysFolder() {
  return sharedFolder("PALPATE_ARRAYS", "../shared/data/arrays");
}
std::optional<fs::path> goldenFolder() {
  return sharedFolder("PALPATE_GOLDEN", "../shared/golden");
}
fs::path dataFolder() { return fs::path(PALPATE_SOURCE_DIR) / "data"; }

bool exhaustive() {
  const char* wanted = std::getenv("PALPATE_EXHAUSTIVE");
  return wanted && std::string_view(wanted) == "1";
}

std::vector<std::filesystem::path> recordingsToTry(const std::filesystem::path& folder) {
  constexpr std::size_t kAlike = 20;
  std::vector<std::filesystem::path> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".dsa") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  if (exhaustive()) return all;
  std::vector<std::filesystem::path> some;
  std::size_t grasps = 0;
  for (const auto& path : all)
    if (path.string().find("grasps_by_class") == std::string::npos || grasps++ % kAlike == 0)
      some.push_back(path);
  return some;
}

std::string readFile(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("can't read " + path.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeFile(const fs::path& path, std::string_view bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out) throw std::runtime_error("can't write " + path.string());
}

}  // namespace palpate::testing
