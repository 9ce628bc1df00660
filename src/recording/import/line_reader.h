// Reads a text line by line with bounded memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "palpate/core/file_descriptor.h"

namespace palpate {

class LineReader {
 public:
  // Throws FileError.
  explicit LineReader(const std::filesystem::path& path);
  // Reads the next line without its end (LF or CR LF); false at the end. The line is valid until
  // the next call. Throws FileError, FormatError (longer than kMaxLineBytes, a byte 0).
  bool next(std::string_view& line);
  std::uint64_t number() const noexcept { return number_; }  // of the last line, from 1
  // Whether the file ends within the last line, without a line end.
  bool endsWithinLine() const noexcept { return endsWithinLine_; }
  double fraction() const noexcept;
  void restart();

 private:
  bool fill();

  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;  // [bytes]
  std::uint64_t read_ = 0;  // [bytes]
  std::string buffer_;
  std::size_t begin_ = 0;  // of what is not yet given out
  bool ended_ = false;
  bool endsWithinLine_ = false;
  std::uint64_t number_ = 0;
};

}  // namespace palpate
