// Reads a text line by line with bounded memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "palpate/core/file_descriptor.h"
#include "palpate/imports/table_source.h"

namespace palpate {

class LineReader {
 public:
  // Throws FileError.
  explicit LineReader(const std::filesystem::path& path);
  // Reads the next line without its end (LF or CR LF, or CR in a file whose first lines end so);
  // false at the end. A list in quotes that goes on in lines which begin with a blank, as NumPy
  // wraps it, is one line with them. The line is valid until the next call. Bytes 0 are left out,
  // and end a line, too. Throws FileError, FormatError (longer than kMaxLineBytes).
  bool next(std::string_view& line);
  std::uint64_t number() const noexcept { return first_; }  // of the last line, from 1
  // Whether the file ends within the last line, without a line end.
  bool endsWithinLine() const noexcept { return endsWithinLine_; }
  // Whether the last line begins or ends at bytes 0 instead of a line end.
  bool isCutOff() const noexcept { return joinsNul_ || beginsAtNul_ || endsAtNul_; }
  const NulBytes& nulBytes() const noexcept { return nul_; }  // until now
  double fraction() const noexcept;
  void restart();

 private:
  bool nextPiece(std::string_view& line);
  bool goesOn();
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
  char lineEnd_ = '\n';
  bool endsWithinLine_ = false;
  bool beginsAtNul_ = false;
  bool endsAtNul_ = false;
  NulBytes nul_;
  bool joinsNul_ = false;     // an earlier piece of the last line is cut off
  std::uint64_t number_ = 0;  // of the last piece
  std::uint64_t first_ = 0;   // of the first one
  std::string joined_;
};

}  // namespace palpate
