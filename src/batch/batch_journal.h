// The journal of the batches into one folder; see batch_run.h. Private to this module.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/file_descriptor.h"

namespace palpate {

// A file as it was at one time.
struct FileStamp {
  std::int64_t size = 0;       // bytes
  std::int64_t changedNs = 0;  // time of change [ns since 1970]
  bool operator==(const FileStamp&) const = default;
};
// Nothing: there is no such file.
std::optional<FileStamp> stampOf(const std::filesystem::path& path);

// A result as it was written; its path is relative to the folder of the journal.
struct WrittenFile {
  std::string path;
  FileStamp stamp = {};
};

struct JournalEntry {
  std::string target;  // relative to the folder
  std::string source;  // absolute
  std::string options;
  FileStamp sourceStamp = {};
  // Of one that was begun: the files of earlier batches that it may replace. Whatever else is there
  // afterwards may be somebody's own.
  std::vector<WrittenFile> replaceable = {};
  // Of the whole result; nothing: it was begun only.
  std::optional<FileStamp> targetStamp = {};
  // Where a recording has several results: all of them, and no targetStamp.
  std::vector<WrittenFile> results = {};
};

class BatchJournal {
 public:
  // Makes the folder, opens and locks the journal. Throws FileError.
  explicit BatchJournal(const std::filesystem::path& folder);

  // The last entry of a result, among those of earlier batches.
  const JournalEntry* find(const std::filesystem::path& target) const;
  // The entry of a result that is begun now.
  JournalEntry entryFor(const std::filesystem::path& target,
                        const std::filesystem::path& source,
                        const std::string& options) const;
  // Appends an entry; may be called from several threads. Throws FileError.
  void add(const JournalEntry& entry);
  // A path as the journal names it, and back.
  std::string relative(const std::filesystem::path& target) const;
  std::filesystem::path pathOf(const std::string& relative) const { return folder_ / relative; }

 private:
  void read();

  std::filesystem::path folder_;
  std::filesystem::path path_;
  FileDescriptor file_;
  std::map<std::string, JournalEntry> entries_;
  std::mutex mutex_;
};

}  // namespace palpate
