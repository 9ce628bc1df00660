// Which lines of a stream are those of its frames, where others come between them: the first ones
// say how many numbers they have and which name; and in which order a line has its values, where a
// line of names or the nesting of its lists says it.
#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/device/stream_lines.h"

#include "device/line_tokens.h"

namespace palpate {
namespace {

using namespace line_tokens;

bool isWord(std::string_view token) {
  return !token.empty() && isLetter(token.front()) && std::ranges::all_of(token, [](char c) {
    return isLetter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '/' || c == '[' ||
           c == ']';
  });
}

// The words of a line; empty when something else stands there.
std::vector<std::string> wordsOf(std::string_view line) {
  std::vector<std::string> words;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (at != end) {
    const std::string_view token = tokenAt(at, end);
    if (!isWord(token)) return {};
    words.emplace_back(token);
    at = skipBlanks(at + token.size(), end);
    if (at != end && isSeparator(*at)) at = skipBlanks(at + 1, end);
  }
  return words;
}

}  // namespace

void StreamLineParser::note(const std::string& text) {
  constexpr std::size_t kMaxNotes = 20;
  if (notes_.size() < kMaxNotes && std::ranges::find(notes_, text) == notes_.end())
    notes_.push_back(text);
}

// --- The first form

// Whether a line has as many numbers as those of its kind before it: one number less or more is a
// value that was lost, or a glitch, and no time that came or went.
bool StreamLineParser::hasUsualLength(Usual<std::size_t>& usual, std::size_t count) {
  const std::size_t before = usual.value;
  const bool isFirst = usual.times == 0;
  if (!usual.accepts(count)) {
    refuse(counted(count, "number") + " instead of " + std::to_string(before) +
           ", as in the lines before");
    return false;
  }
  if (!isFirst && count != before)
    note("lines have " + counted(count, "number") + " from line " + std::to_string(stats_.lines) +
         " on, " + std::to_string(before) + " before: the frames before it may be wrong");
  return true;
}

// Whether a line with this name is one of a frame. A name that is none of the hand's counts as long
// as no frame came otherwise; the first line with it waits for the next one where it `mayWait`.
bool StreamLineParser::isOfFrames(std::string_view name,
                                  bool isOwn,
                                  bool mayWait,
                                  const Sink& sink) {
  if (isOwn) {
    noteOwnFrames();
    return true;
  }
  if (hasOwnFrames_) {
    refuse(inQuotes(name) + " is not one of the hand's names, and its frames come without it");
    return false;
  }
  if (heldLine_) {
    const std::string now(text_);
    releaseHeld(sink);
    takeText(now, sink);
    return false;
  }
  const std::string before = otherName_.value;
  if (before.empty() && mayWait) {
    otherName_.value = name;
    heldLine_.emplace(stats_.lines, text_);
    return false;
  }
  if (!otherName_.accepts(std::string(name))) {
    refuse(inQuotes(name) +
           " is not one of the hand's names, and the first frames were lines with " +
           inQuotes(before));
    return false;
  }
  if (otherName_.value != before && mayWait)
    note("lines with " + inQuotes(name) +
         " are taken for the frames: it is not one of the hand's names, but no other lines are "
         "frames" +
         (before.empty() ? "" : " from line " + std::to_string(stats_.lines) + " on"));
  return true;
}

// A frame came that is surely one: what was taken for one by another name was none.
void StreamLineParser::noteOwnFrames() {
  if (std::exchange(hasOwnFrames_, true)) return;
  if (const auto held = std::exchange(heldLine_, std::nullopt))
    return refuse(held->first,
                  inQuotes(otherName_.value) +
                      " is not one of the hand's names, and its frames come without it");
  if (otherName_.times > 0)
    note("the frames before line " + std::to_string(stats_.lines) + " were lines with " +
         inQuotes(otherName_.value) + ", which is not one of the hand's names: they may be wrong");
}

// The line that waited is a frame: no other lines are.
void StreamLineParser::releaseHeld(const Sink& sink) {
  const auto held = std::exchange(heldLine_, std::nullopt);
  if (!held) return;
  note("lines with " + inQuotes(otherName_.value) +
       " are taken for the frames: it is not one of the hand's names, but no other lines are "
       "frames");
  const std::uint64_t now = std::exchange(stats_.lines, held->first);
  takeText(held->second, sink);
  stats_.lines = now;
}

// --- The order of the values

// Takes a line of names, one for each value. One whose names don't say the taxels is refused by the
// caller; the same names in another order are an order then.
bool StreamLineParser::takeHeader(std::string_view line, const Head& head) {
  const char* const end = line.data() + line.size();
  if (head.name.empty() || head.hasColon || head.values == end || !isLetter(*head.values))
    return false;
  constexpr auto kFrame = StreamItemKind::kFrame;
  std::vector<std::string> names = wordsOf(line);
  if (names.size() < 2) return false;
  if (!shape_.fits(kFrame, names.size()) && shape_.fits(kFrame, names.size() - 1))
    names.erase(names.begin());  // that of the time
  std::vector<std::string> sorted = names;
  std::ranges::sort(sorted);
  if (!shape_.fits(kFrame, names.size()) || std::ranges::adjacent_find(sorted) != sorted.end())
    return false;
  std::vector<std::size_t> places;
  const bool areNamed = findPlacesOfLabels(names, places);
  if (areNamed || knownLabels_.empty()) {
    knownLabels_.clear();
    for (std::size_t i = 0; i < names.size(); ++i) knownLabels_.emplace(names[i], places[i]);
  }
  if (!areNamed) return false;
  headerOrder_.clear();
  if (std::ranges::is_sorted(places)) return true;
  headerOrder_ = std::move(places);
  note("the values after line " + std::to_string(stats_.lines) +
       " are in the order of its names (" + inQuotes(names.front()) + " to " +
       inQuotes(names.back()) + ")");
  return true;
}

// Counts the numbers of the innermost lists.
void StreamLineParser::measureLists(std::string_view line) {
  bool isInside = false;
  bool isBehindNumber = false;
  std::size_t count = 0;
  for (const char c : line) {
    if (c == '[' || c == '(') {
      isInside = true;
      count = 0;
    } else if (c == ']' || c == ')') {
      if (std::exchange(isInside, false)) listLengths_.push_back(count);
    } else if (!line_tokens::isSeparator(c)) {
      if (!isBehindNumber) ++count;
      isBehindNumber = true;
      continue;
    }
    isBehindNumber = false;
  }
}

// The place of each value of a line of several lists, for these matrices: a list per row, per
// column, which only the numbers of the lists can say, or per matrix. Empty: in the order of the
// hand. Returns false when the line was refused.
bool StreamLineParser::orderLists(std::size_t matrix,
                                  std::size_t numMatrices,
                                  std::vector<std::size_t>& order) {
  order.clear();
  if (listLengths_.size() < 2) return true;
  const auto& matrices = shape_.layout().matrices();
  std::size_t numPlaces = 0;
  for (std::size_t m = matrix; m < matrix + numMatrices; ++m) {
    // A list may then be the components of a taxel.
    if (matrices[m].touch.components != 1) return true;
    numPlaces += matrices[m].numCells();
  }
  // Only the taxels, or a list with the time.
  if (std::accumulate(listLengths_.begin(), listLengths_.end(), std::size_t{0}) != numPlaces)
    return true;
  const auto areAll = [&](std::size_t from, std::size_t lists, std::size_t length) {
    return from + lists <= listLengths_.size() &&
           std::all_of(listLengths_.begin() + static_cast<std::ptrdiff_t>(from),
                       listLengths_.begin() + static_cast<std::ptrdiff_t>(from + lists),
                       [length](std::size_t each) { return each == length; });
  };
  bool isTransposed = false;
  std::size_t list = 0;
  for (std::size_t m = matrix; m < matrix + numMatrices; ++m) {
    const auto rows = static_cast<std::size_t>(matrices[m].rows);
    const auto columns = static_cast<std::size_t>(matrices[m].columns);
    const std::size_t first = order.size();
    const bool isByColumn = !areAll(list, rows, columns) && areAll(list, columns, rows);
    if (isByColumn)
      list += columns;
    else if (areAll(list, rows, columns))
      list += rows;
    else if (areAll(list, 1, rows * columns))
      ++list;
    else {
      refuse("its lists have neither the rows nor the columns of the hand: send a list per row");
      order.clear();
      return false;
    }
    for (std::size_t i = 0; i < rows * columns; ++i)
      order.push_back(first + (isByColumn ? i % rows * columns + i / rows : i));
    isTransposed = isTransposed || (isByColumn && rows > 1 && columns > 1);
  }
  if (isTransposed)
    note("the lists of a frame have columns x rows and are transposed");
  else
    order.clear();
  return true;
}

}  // namespace palpate
