#include "imports/line_reader.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/imports/table_source.h"

namespace palpate {
namespace {

constexpr std::size_t kLineReaderPieceBytes = 1u << 18;

// Whether a line ends within a quoted list. `isOpen`: it begins within one.
bool endsInList(std::string_view line, bool isOpen) {
  bool isList = isOpen;
  bool isQuoted = isOpen;
  for (std::size_t at = line.find('"'); at < line.size(); at = line.find('"', at + 1)) {
    isQuoted = !isQuoted;
    const std::size_t next = line.find_first_not_of(" \t", at + 1);
    isList = isQuoted && next < line.size() && (line[next] == '[' || line[next] == '(');
  }
  return isQuoted && isList;
}

}  // namespace

LineReader::LineReader(const std::filesystem::path& path) : path_(path) { restart(); }

void LineReader::restart() {
  file_ = openRegularFile(path_);
  struct stat facts {};
  if (::fstat(file_.get(), &facts) != 0)
    throw FileError(path_, "can't be read: " + std::generic_category().message(errno));
  size_ = static_cast<std::uint64_t>(std::max<off_t>(facts.st_size, 0));
  read_ = 0;
  buffer_.clear();
  begin_ = 0;
  ended_ = false;
  lineEnd_ = '\n';
  endsWithinLine_ = beginsAtNul_ = endsAtNul_ = false;
  nul_ = {};
  joinsNul_ = false;
  number_ = first_ = 0;
}

double LineReader::fraction() const noexcept {
  if (size_ == 0) return 0.0;
  const double done = static_cast<double>(read_ - (buffer_.size() - begin_));
  return std::min(1.0, done / static_cast<double>(size_));
}

// Appends the next piece of the file; false at its end.
bool LineReader::fill() {
  if (ended_) return false;
  buffer_.erase(0, begin_);
  begin_ = 0;
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kLineReaderPieceBytes);
  ssize_t count = 0;
  do {
    count = ::read(file_.get(), buffer_.data() + before, kLineReaderPieceBytes);
  } while (count < 0 && errno == EINTR);
  if (count < 0) throw FileError(path_, "can't be read: " + std::generic_category().message(errno));
  buffer_.resize(before + static_cast<std::size_t>(count));
  const bool isFirst = read_ == 0;
  read_ += static_cast<std::uint64_t>(count);
  ended_ = count == 0;
  if (isFirst && buffer_.find('\n') == std::string::npos && buffer_.find('\r') < buffer_.size() - 1)
    lineEnd_ = '\r';
  return count > 0;
}

// Moves behind the bytes 0 at which the next line would begin.
void LineReader::skipNulBytes() {
  beginsAtNul_ = endsAtNul_;
  while (begin_ < buffer_.size() || fill()) {
    const std::size_t end = std::min(buffer_.find_first_not_of('\0', begin_), buffer_.size());
    if (end > begin_) {
      if (nul_.count == 0) nul_.line = number_ + (endsAtNul_ ? 0 : 1);
      nul_.count += end - begin_;
      beginsAtNul_ = true;
    }
    begin_ = end;
    if (end < buffer_.size()) return;
  }
}

// Where the next line ends in the buffer: npos if it goes on behind it.
std::size_t LineReader::endFrom(std::size_t from) const {
  const std::size_t end = buffer_.find(lineEnd_, from);
  return std::min(end, std::string_view(buffer_).substr(0, end).find('\0', from));
}

bool LineReader::nextPiece(std::string_view& line) {
  skipNulBytes();
  std::size_t searched = begin_;
  std::size_t end = std::string::npos;
  while ((end = endFrom(searched)) == std::string::npos) {
    const std::size_t waiting = buffer_.size() - begin_;
    if (waiting > kMaxLineBytes)
      throw FormatError(
          path_, "line " + std::to_string(number_ + 1) + " is longer than 4 MB: not a table");
    if (!fill()) {
      if (waiting == 0) return false;
      end = buffer_.size();
      endsWithinLine_ = true;
      break;
    }
    searched = waiting;
  }
  line = std::string_view(buffer_).substr(begin_, end - begin_);
  if (!endsAtNul_) ++number_;
  endsAtNul_ = end < buffer_.size() && buffer_[end] == 0;
  begin_ = std::min(endsAtNul_ ? end : end + 1, buffer_.size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (number_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  return true;
}

// Whether the next line begins with a blank.
bool LineReader::goesOn() {
  return !endsAtNul_ && (begin_ < buffer_.size() || fill()) && buffer_[begin_] == ' ';
}

bool LineReader::next(std::string_view& line) {
  joinsNul_ = false;
  if (!nextPiece(line)) return false;
  first_ = number_;
  bool isOpen = endsInList(line, false);
  if (!isOpen) return true;
  joined_ = line;
  while (isOpen && joined_.size() <= kMaxLineBytes && goesOn()) {
    joinsNul_ = isCutOff();
    if (!nextPiece(line)) break;
    joined_.append(" ").append(line);
    isOpen = endsInList(line, true);
  }
  line = joined_;
  return true;
}

}  // namespace palpate
