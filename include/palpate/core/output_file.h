// A file that appears whole or not at all: written under a temporary name in the same folder,
// synced, then renamed. An existing file is replaced only when asked.
#pragma once

#include <filesystem>
#include <string_view>

namespace palpate {

enum class Overwrite { kRefuse, kReplace };

// Throws FileError when PATH is a folder, or exists and may not be replaced.
void requireWritable(const std::filesystem::path& path, Overwrite overwrite);
// Gives a file that was written and synced (in the same file system) its final name and syncs the
// folder. Throws FileError; then `written` is still there under its old name.
void publishFile(const std::filesystem::path& written,
                 const std::filesystem::path& path,
                 Overwrite overwrite);

class OutputFile {
 public:
  // Opens the temporary file. Throws FileError: exists already (kRefuse), no such folder, no
  // permission, is a folder.
  explicit OutputFile(std::filesystem::path path, Overwrite overwrite = Overwrite::kRefuse);
  // Removes the temporary file unless commit() succeeded.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);  // throws FileError (disk full, ..)
  // Syncs file and folder and gives the file its name. Throws FileError; then nothing was left.
  void commit();
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  Overwrite overwrite_;
  int descriptor_ = -1;
  bool committed_ = false;
};

}  // namespace palpate
