#include "commands/recording_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <new>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/one_line.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "gui/interruption.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

// SQLite's header: its name, and at byte 68 the application_id of a native recording (docs/palpate_format.md).
bool beginsAsNativeRecording(const fs::path& file) {
  constexpr std::string_view kSqlite("SQLite format 3\0", 16);
  constexpr std::string_view kPalpate("PALP");
  constexpr std::size_t kIdAt = 68;
  std::array<char, kIdAt + kPalpate.size()> bytes{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(bytes.data(), bytes.size())) return false;
  const std::string_view start(bytes.data(), bytes.size());
  return start.starts_with(kSqlite) && start.ends_with(kPalpate);
}

bool isNamedAsRecording(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& letter : ending)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return ending == ".dsa" || ending == ".palpate";
}

bool isRecording(const fs::path& file) {
  return isNamedAsRecording(file) || (!file.has_extension() && beginsAsNativeRecording(file));
}

using FileId = std::pair<dev_t, ino_t>;

std::optional<FileId> idOf(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileId(status.st_dev, status.st_ino);
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

// What lies below one folder. Real folders come first, links to others behind them: a recording that can be
// reached in both ways has its real name.
class FolderWalk {
 public:
  explicit FolderWalk(const fs::path& root) {
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
    std::sort(troubles_.begin(), troubles_.end());
  }

  std::vector<fs::path>& files() { return files_; }
  std::vector<std::string>& troubles() { return troubles_; }

 private:
  void look(const fs::path& folder) {
    if (const auto id = idOf(folder); id && !seen_.insert(*id).second) return;
    std::error_code failure;
    fs::directory_iterator entry(folder, failure);
    for (; !failure && entry != fs::directory_iterator(); entry.increment(failure)) take(*entry);
    if (failure) {
      const FileError error(folder, "can't be looked into: " + failure.message());
      troubles_.emplace_back(error.what());
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

  // A link that leads nowhere is kept when it is called like a recording: that it can't be read will be said.
  void takeLinkedFiles() {
    if (linkedFiles_.empty()) return;
    std::set<FileId> known;
    for (const fs::path& file : files_)
      if (const auto id = idOf(file)) known.insert(*id);
    for (const fs::path& link : linkedFiles_) {
      std::error_code failure;
      if (!fs::is_regular_file(link, failure) && fs::exists(link, failure)) continue;
      const auto id = idOf(link);
      if ((!id || !known.contains(*id)) && isRecording(link)) {
        files_.push_back(link);
        if (id) known.insert(*id);
      }
    }
  }

  std::vector<fs::path> folders_;  // still to be looked into
  std::set<fs::path> linkedFolders_;
  std::set<fs::path> linkedFiles_;
  std::set<FileId> seen_;  // folders
  std::vector<fs::path> files_;
  std::vector<std::string> troubles_;
};

void say(const std::string& message) {
  std::fprintf(stderr, "palpate: %s\n", oneLine(message).c_str());
}

std::string countText(std::size_t part, std::size_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole);
}

// One way through a list.
class ListRun {
 public:
  ListRun(const RecordingList& list, bool quiet) : list_(list), quiet_(quiet), line_("", quiet) {
    if (list.several) interruption_.emplace();
  }

  int through(const FileWork& work) {
    for (const std::string& trouble : list_.troubles) say(trouble);
    for (index_ = 0; index_ < list_.files.size(); ++index_) {
      if (interrupted()) return endInterrupted();
      const fs::path& file = list_.files[index_];
      line_.setLabel(list_.several ? countText(index_ + 1, list_.files.size()) + ": " +
                                         oneLine(file.filename().string())
                                   : oneLine(file.string()));
      const std::optional<FileOutcome> outcome = tried(work);
      if (interrupted_) return endInterrupted();
      line_.wipe();
      if (!outcome) continue;
      if (!outcome->said.empty()) {
        std::printf("%s\n", outcome->said.c_str());
        std::fflush(stdout);  // a line per file as it comes, also into a pipe
      }
      if (outcome->trouble.empty()) continue;
      say(outcome->trouble);
      ++inPart_;
    }
    return end();
  }

  // A remark that is no failure.
  void note(const std::string& message) {
    if (quiet_ || !list_.several) return;
    line_.wipe();
    say(message);
  }
  // Before rows go to a terminal: they would be written behind the progress, and are progress enough.
  void leaveTheTerminal() {
    if (::isatty(STDOUT_FILENO) != 1) return;
    line_.wipe();
    shows_ = false;
  }

 private:
  bool interrupted() {
    if (!interrupted_ && interruption_) interrupted_ = interruption_->came(0);
    return interrupted_;
  }

  Progress progress() {
    shows_ = true;
    return [this, show = line_.callback()](double fraction) {
      if (interrupted()) return false;
      if (shows_ && show)
        show((static_cast<double>(index_) + fraction) / static_cast<double>(list_.files.size()));
      return true;
    };
  }

  // Nothing when the file failed.
  std::optional<FileOutcome> tried(const FileWork& work) {
    try {
      return work(list_.files[index_], progress());
    } catch (const UsageError&) {
      throw;
    } catch (const OutputError&) {
      throw;
    } catch (const std::bad_alloc&) {
      fail(list_.files[index_].string() + ": out of memory");
    } catch (const std::exception& error) {
      if (!interrupted_) fail(error.what());
    }
    return std::nullopt;
  }

  void fail(const std::string& message) {
    line_.wipe();
    say(message);
    ++failed_;
  }

  int end() const {
    const std::size_t all = list_.files.size();
    if (failed_ > 1) say(countText(failed_, all) + " recordings failed");
    if (failed_ == all) return kFailed;
    return failed_ + inPart_ + list_.troubles.size() > 0 ? kPartlyDone : kDone;
  }

  int endInterrupted() {
    line_.wipe();
    const std::size_t done = index_ - failed_;
    say("interrupted: " + countText(done, list_.files.size()) + " recordings are done");
    return done > 0 ? kPartlyDone : kFailed;
  }

  const RecordingList& list_;
  bool quiet_;
  ProgressLine line_;
  std::optional<gui::Interruption> interruption_;  // of one file alone the end is as ever
  std::size_t index_ = 0;
  std::size_t failed_ = 0;
  std::size_t inPart_ = 0;
  bool interrupted_ = false;
  bool shows_ = true;
};

}  // namespace

RecordingList recordingsIn(const Words& words) {
  RecordingList list;
  list.several = words.size() > 1;
  for (const std::string& word : words) {
    std::error_code ignored;
    if (!fs::is_directory(word, ignored)) {
      list.files.emplace_back(word);
      continue;
    }
    list.several = true;
    FolderWalk walk{fs::path(word)};
    if (walk.files().empty() && walk.troubles().empty()) {
      const FileError error(word, "no recording (.palpate, .dsa) lies in this folder or below it");
      walk.troubles().emplace_back(error.what());
    }
    std::move(walk.files().begin(), walk.files().end(), std::back_inserter(list.files));
    std::move(walk.troubles().begin(), walk.troubles().end(), std::back_inserter(list.troubles));
  }
  return list;
}

int forEachRecording(const RecordingList& list, bool quiet, const FileWork& work) {
  return ListRun(list, quiet).through(work);
}

int forEachProfile(const RecordingList& list, bool quiet, const ProfileWork& work) {
  ListRun run(list, quiet);
  return run.through([&](const fs::path& file, const Progress& progress) {
    const auto half = [&](double begin) {
      return [&progress, begin](double fraction) { return progress(begin + 0.5 * fraction); };
    };
    const Profile profile = openRecording(file, half(0.0));
    // What a native recording warns of is that it has no end; the oddities of a .dsa cost nothing.
    if (profile.info().format == "palpate")
      for (const std::string& warning : profile.info().warnings)
        run.note(file.string() + ": " + warning);
    run.leaveTheTerminal();
    work(file, profile, half(0.5));
    return FileOutcome{};
  });
}

}  // namespace palpate::commands
