// Reads a text line by line with bounded memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "palpate/core/file_descriptor.h"
#include "palpate/recording/table_source.h"

namespace palpate {

class LineReader {
 public:
  // Throws FileError.
  explicit LineReader(const std::filesystem::path& path);
  // Reads the next line without its end (LF or CR LF); false at the end. The line is valid until
  // the next call. Bytes 0 are left out, and end a line, too. Throws FileError, FormatError (longer
  // than kMaxLineBytes).
  bool next(std::string_view& line);
  std::uint64_t number() const noexcept { return number_; }  // of the last line, from 1
  // Whether the file ends within the last line, without a line end.
  bool endsWithinLine() const noexcept { return endsWithinLine_; }
  // Whether the last line begins or ends at bytes 0 instead of a line end.
  bool isCutOff() const noexcept { return beginsAtNul_ || endsAtNul_; }
  const NulBytes& nulBytes() const noexcept { return nul_; }  // until now
  double fraction() const noexcept;
  void restart();

 private:
  bool fill();
  void skipNulBytes();
  std::size_t endFrom(std::size_t from) const;

  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;  // [bytes]
  std::uint64_t read_ = 0;  // [bytes]
  std::string buffer_;
  std::size_t begin_ = 0;  // of what is not yet given out
  bool ended_ = false;
  bool endsWithinLine_ = false;
  bool beginsAtNul_ = false;
  bool endsAtNul_ = false;
  NulBytes nul_;
  std::uint64_t number_ = 0;
};

}  // namespace palpate
