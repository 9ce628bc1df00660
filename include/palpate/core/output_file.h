// Writes a file so that it never exists incompletely: the file is written without a name (or under
// a temporary one) in the same folder, synced to disk, and then named. An existing file is replaced
// only when requested.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace palpate {

// Why a write failed, for messages: an error number of the system in its words, a full disk in
// plain ones, the same for every kind of file.
std::string writeFailureText(int error);

// What happens when the file exists already.
enum class Overwrite { kRefuse, kReplace };

// Throws FileError when `path` is a folder or no regular file, or exists and may not be replaced.
void requireWritable(const std::filesystem::path& path, Overwrite overwrite);
// Gives a written and synced file (in the same file system) its final name and syncs the folder.
// Throws FileError; `written` then keeps its old name.
void publishFile(const std::filesystem::path& written,
                 const std::filesystem::path& path,
                 Overwrite overwrite);

// A file that is being written.
class OutputFile {
 public:
  // Opens the new file. A symbolic link that may be replaced is followed. Throws FileError when the
  // file exists (kRefuse), the folder does not exist, a permission is missing, or the path is a
  // folder, a device and so on.
  explicit OutputFile(std::filesystem::path path, Overwrite overwrite = Overwrite::kRefuse);
  // Removes the file unless commit() succeeded. Where the file system supports files without a
  // name, nothing remains even when the process is killed.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);  // throws FileError (disk full, ..)
  // Writes the data to disk; the file still has no name. Throws FileError (disk full, ..).
  void sync();
  // Syncs file and folder and gives the file its name. Throws FileError; then no file remains.
  void commit();
  const std::filesystem::path& path() const noexcept { return path_; }
  Overwrite overwrite() const noexcept { return overwrite_; }
  // For another program that writes the file: it opens /proc/self/fd/N. Use write() within this
  // program.
  int descriptor() const noexcept { return descriptor_; }

 private:
  void nameTemporarily();

  std::filesystem::path path_;
  // Temporary name; empty when the file has no name.
  std::filesystem::path temporary_;
  Overwrite overwrite_;
  int descriptor_ = -1;
};

// Commits files that belong together: all are on disk before the first one gets its name. Throws
// FileError; then none of them remains, except those that have already replaced an existing file.
void commitTogether(std::span<OutputFile* const> files);

}  // namespace palpate
