#include "palpate/library/recording_folder.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/file_id.h"
#include "palpate/core/file_name.h"
#include "palpate/core/text_file.h"
#include "palpate/recording/foreign_file.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// SQLite's header: its name, and at byte 68 the application_id of a native recording
// (docs/notes/palpate_format.md).
bool beginsAsNativeRecording(const fs::path& file) {
  constexpr std::string_view kSqlite("SQLite format 3\0", 16);
  constexpr std::string_view kPalpate("PALP");
  constexpr std::size_t kIdAt = 68;
  const std::string start = beginningOfFile(file, kIdAt + kPalpate.size());
  return start.size() == kIdAt + kPalpate.size() && start.starts_with(kSqlite) &&
         start.ends_with(kPalpate);
}

bool isNamedAsRecording(const fs::path& file) {
  const std::string ending = lowerEndingOf(file);
  return ending == ".dsa" || ending == ".palpate";
}

bool isRecording(const fs::path& file) {
  return isNamedAsRecording(file) || (!file.has_extension() && beginsAsNativeRecording(file));
}

// Whether a link leads to the folder it stands in, or to one above that.
bool leadsBack(const fs::path& link) {
  std::error_code failure;
  const fs::path target = fs::canonical(link, failure);
  if (failure) return false;
  const fs::path from = fs::canonical(link.parent_path(), failure);
  if (failure) return false;
  return std::mismatch(target.begin(), target.end(), from.begin(), from.end()).first ==
         target.end();
}

// What lies below one folder. Real folders come first, links to others behind them: a recording
// that can be reached in both ways has its real name.
class FolderWalk {
 public:
  FolderWalk(const fs::path& root, const Progress& progress) : progress_(progress) {
    folders_.push_back(root);
    while (!folders_.empty() || !linkedFolders_.empty()) {
      std::set<fs::path>& links = linkedFolders_;
      if (folders_.empty()) folders_.push_back(links.extract(links.begin()).value());
      const fs::path folder = std::move(folders_.back());
      folders_.pop_back();
      look(folder);
    }
    takeLinkedFiles();
    std::sort(files_.begin(), files_.end());
    std::sort(problems_.begin(), problems_.end());
  }

  RecordingFolder taken() {
    return {std::move(files_), std::move(problems_), {seenPaths_.begin(), seenPaths_.end()}};
  }

 private:
  void look(const fs::path& folder) {
    if (const auto id = fileIdOf(folder); id && !seen_.insert(*id).second) return;
    seenPaths_.insert(folder);
    std::error_code failure;
    fs::directory_iterator entry(folder, failure);
    for (; !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
      if (progress_ && !progress_(0.0)) throw Cancelled();
      take(*entry);
    }
    if (failure) {
      const FileError error(folder, "can't be read: " + failure.message());
      problems_.emplace_back(error.what());
    }
  }

  void take(const fs::directory_entry& entry) {
    const fs::path& path = entry.path();
    if (path.filename().native().starts_with('.')) return;
    std::error_code ignored;
    if (entry.is_symlink(ignored)) {
      if (!fs::is_directory(path, ignored))
        linkedFiles_.insert(path);
      else if (!leadsBack(path))
        linkedFolders_.insert(path);
    } else if (entry.is_directory(ignored)) {
      folders_.push_back(path);
    } else if (entry.is_regular_file(ignored) && isRecording(path)) {
      files_.push_back(path);
    }
  }

  // A link that leads nowhere is kept when it is called like a recording: that it can't be read
  // will be said.
  void takeLinkedFiles() {
    if (linkedFiles_.empty()) return;
    std::set<FileId> known;
    for (const fs::path& file : files_)
      if (const auto id = fileIdOf(file)) known.insert(*id);
    for (const fs::path& link : linkedFiles_) {
      std::error_code failure;
      if (!fs::is_regular_file(link, failure) && fs::exists(link, failure)) continue;
      const auto id = fileIdOf(link);
      if ((!id || !known.contains(*id)) && isRecording(link)) {
        files_.push_back(link);
        if (id) known.insert(*id);
      }
    }
  }

  const Progress& progress_;
  std::vector<fs::path> folders_;  // still to be looked into
  std::set<fs::path> linkedFolders_;
  std::set<fs::path> linkedFiles_;
  std::set<FileId> seen_;  // folders
  std::set<fs::path> seenPaths_;
  std::vector<fs::path> files_;
  std::vector<std::string> problems_;
};

}  // namespace

RecordingFolder recordingsBelow(const fs::path& folder, const Progress& progress) {
  return FolderWalk(folder, progress).taken();
}

std::string noRecordingText(const fs::path& folder) {
  const std::string bag = bagFolderText(folder);
  return FileError(
             folder,
             bag.empty() ? "no recording (.palpate, .dsa) in this folder or its subfolders" : bag)
      .what();
}

}  // namespace palpate
