#include "palpate/interop/remote_file.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/recording/recording_format.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxBytes = 200;  // leaves room for "_002" and SQLite's journal
constexpr std::string_view kEnding = ".palpate";

bool isTemplate(std::string_view name) { return name.find('{') != std::string_view::npos; }

// True for the ending of another format of recordings, which would not be created.
bool hasOtherEnding(const fs::path& name) {
  const std::vector<std::string> endings = recordingEndings();
  const std::string ending = name.extension().string();
  return ending != kEnding && std::find(endings.begin(), endings.end(), ending) != endings.end();
}

}  // namespace

std::string problemOfRemoteName(std::string_view name) {
  if (name.empty()) return "a name is missing";
  if (name.size() > kMaxBytes) return "a name has at most " + std::to_string(kMaxBytes) + " bytes";
  if (escapedLine(name) != name) return "a name is UTF-8 without control characters";
  if (name.find('/') != std::string_view::npos)
    return "only a name, not a path: recordings stay in their folder";
  if (name.front() == '.' || name.front() == '-') return "a name doesn't begin with '.' or '-'";
  if (hasOtherEnding(name))
    return "a recording is written as .palpate; 'palpate convert' makes other formats of it";
  if (!isTemplate(name)) return {};
  try {
    recordingFileName(name, {}, 1);
  } catch (const std::invalid_argument& refusal) {
    std::string_view said = refusal.what();
    constexpr std::string_view kPrefix = "RecordingName: ";
    if (said.starts_with(kPrefix)) said.remove_prefix(kPrefix.size());
    return std::string(said);
  }
  return {};
}

fs::path remoteRecordingPath(const fs::path& folder,
                             std::string_view name,
                             const RecordingNameFields& fields) {
  if (const std::string problem = problemOfRemoteName(name); !problem.empty())
    throw std::invalid_argument(problem);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw FileError(folder, "isn't a folder: create it first");
  if (isTemplate(name)) return nextRecordingPath(folder, name, fields);
  std::string whole(name);
  if (!whole.ends_with(kEnding)) whole += kEnding;
  return folder / whole;
}

}  // namespace palpate
