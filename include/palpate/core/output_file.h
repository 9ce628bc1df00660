// A file that appears whole or not at all: written without a name (or under a temporary one) in the
// same folder, synced, then named. An existing file is replaced only when asked.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace palpate {

enum class Overwrite { kRefuse, kReplace };

// Throws FileError when PATH is a folder or no regular file, or exists and may not be replaced.
void requireWritable(const std::filesystem::path& path, Overwrite overwrite);
// Gives a file that was written and synced (in the same file system) its final name and syncs the
// folder. Throws FileError; then `written` is still there under its old name.
void publishFile(const std::filesystem::path& written,
                 const std::filesystem::path& path,
                 Overwrite overwrite);

class OutputFile {
 public:
  // Opens the file to be. A symbolic link that may be replaced is followed. Throws FileError:
  // exists already (kRefuse), no such folder, no permission, is a folder, a device, ..
  explicit OutputFile(std::filesystem::path path, Overwrite overwrite = Overwrite::kRefuse);
  // Nothing is left unless commit() succeeded; nor when the process is killed, where the file
  // system has files without a name.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);  // throws FileError (disk full, ..)
  // What was written is on disk, still without its name. Throws FileError (disk full, ..).
  void sync();
  // Syncs file and folder and gives the file its name. Throws FileError; then nothing was left.
  void commit();
  const std::filesystem::path& path() const noexcept { return path_; }
  Overwrite overwrite() const noexcept { return overwrite_; }
  // For another program that writes it: /proc/self/fd/N there, opened anew; see write() for our own
  // bytes.
  int descriptor() const noexcept { return descriptor_; }

 private:
  void nameTemporarily();

  std::filesystem::path path_;
  std::filesystem::path temporary_;  // empty while the file has no name
  Overwrite overwrite_;
  int descriptor_ = -1;
};

// Files that belong together: every one is on disk before the first has its name. Throws FileError;
// then none of them was left, but for those that had replaced another by then.
void commitTogether(std::span<OutputFile* const> files);

}  // namespace palpate
