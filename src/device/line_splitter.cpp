#include "palpate/device/line_splitter.h"

#include <cstring>
#include <utility>

#include "palpate/core/escaped_line.h"

namespace palpate {
namespace {

// Finds the ends of lines. The next '\n' is kept, so that each byte is looked at twice at most,
// whatever ends the lines.
class LineEnds {
 public:
  LineEnds(const char* begin, const char* end) : end_(end), feed_(find('\n', begin, end)) {}
  // The next end of a line at or behind `at`, which must not go back; the end of all when there is
  // none.
  const char* next(const char* at) {
    if (feed_ < at) feed_ = find('\n', at, end_);
    return find('\r', at, feed_);
  }

 private:
  // `end` when there is none.
  static const char* find(char c, const char* at, const char* end) {
    const void* const found = std::memchr(at, c, static_cast<std::size_t>(end - at));
    return found != nullptr ? static_cast<const char*>(found) : end;
  }
  const char* end_;
  const char* feed_;
};

bool mayLackDigits(std::string_view line) {
  line = trimmed(line, " \t");
  return !line.empty() && line.front() != '#' && line.find('\0') == std::string_view::npos &&
         std::string_view("}])").find(line.back()) == std::string_view::npos;
}

}  // namespace

void LineSplitter::push(std::span<const std::byte> bytes, const Take& take) {
  if (bytes.empty()) return;
  const char* at = reinterpret_cast<const char*>(bytes.data());
  const char* const end = at + bytes.size();
  LineEnds ends(at, end);
  while (at != end) {
    if (continuesEnd(*at, take)) {
      ++at;
      continue;
    }
    const char* const stop = ends.next(at);
    const bool ended = stop != end;
    if (ended) lastEnd_ = *stop;
    takePiece({at, static_cast<std::size_t>(stop - at)}, ended, take);
    at = ended ? stop + 1 : end;
  }
}

void LineSplitter::hand(std::string_view line, const Take& take) {
  take({SplitLine::Kind::kWhole, ++counts_.lines, line});
}

// Nothing is pending any more when `take` throws.
void LineSplitter::handPending(const Take& take) {
  line_.swap(pending_);
  pending_.clear();
  hand(line_, take);
}

// What follows a second '\r' says whether it was an empty line.
void LineSplitter::endHeldReturn(const Take& take) {
  if (std::exchange(heldReturn_, false)) hand({}, take);
}

// Whether `c` belongs to the end of the line before.
bool LineSplitter::continuesEnd(char c, const Take& take) {
  const char last = std::exchange(lastEnd_, '\0');
  if (c == '\n')
    heldReturn_ = false;
  else
    endHeldReturn(take);
  if (last == '\0' || (c != '\n' && c != '\r') || (c == '\n' && last == '\n')) return false;
  if (c == last) {
    lastEnd_ = c;
    heldReturn_ = true;
  }
  ++counts_.lineBytes;
  return true;
}

// Takes a line, or the part of it that came, without its end.
void LineSplitter::takePiece(std::string_view piece, bool ended, const Take& take) {
  if (!skipping_ && pending_.size() + piece.size() > longest_) {
    counts_.skippedBytes += pending_.size();
    pending_.clear();
    skipping_ = true;
    take({SplitLine::Kind::kTooLong, counts_.lines + 1});
  }
  if (skipping_) {
    counts_.skippedBytes += piece.size() + (ended ? 1 : 0);
    if (!ended) return;
    ++counts_.lines;
    skipping_ = false;
  } else if (!ended) {
    pending_.append(piece);
  } else if (pending_.empty()) {
    counts_.lineBytes += piece.size() + 1;
    hand(piece, take);
  } else {
    pending_.append(piece);
    counts_.lineBytes += pending_.size() + 1;
    handPending(take);
  }
}

void LineSplitter::endLine(const Take& take) {
  lastEnd_ = '\0';
  endHeldReturn(take);
  if (skipping_) {
    ++counts_.lines;
    skipping_ = false;
  } else if (!pending_.empty()) {
    counts_.lineBytes += pending_.size();
    handPending(take);
  }
}

void LineSplitter::cutOff(const Take& take) {
  if (skipping_ || !mayLackDigits(pending_)) return endLine(take);
  lastEnd_ = '\0';
  counts_.lineBytes += pending_.size();
  pending_.clear();
  take({SplitLine::Kind::kCutOff, ++counts_.lines});
}

void LineSplitter::restart() {
  counts_.skippedBytes += pending_.size();
  pending_.clear();
  skipping_ = heldReturn_ = false;
  lastEnd_ = '\0';
}

}  // namespace palpate
