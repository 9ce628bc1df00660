// Frames of several lines: a line per matrix, begun by its name, or a line per row of the only
// matrix.
#include <algorithm>
#include <string>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/device/stream_lines.h"

namespace palpate {
namespace {

bool isCountOf(const MatrixLayout& matrix, std::size_t count) {
  return count > 0 &&
         (count == matrix.numReadings() ||
          count == matrix.numTaxels() * static_cast<std::size_t>(matrix.touch.components));
}

// Numbers of a line that is a row of the matrix.
std::size_t rowNumbers(const MatrixLayout& matrix) {
  return matrix.numReadings() / static_cast<std::size_t>(matrix.rows);
}

}  // namespace

// --- A line per matrix

// Takes the line if it is one of a matrix; a frame is complete when each matrix came once.
bool StreamLineParser::takePad(const Head& head, std::size_t count, const Sink& sink) {
  const SensorLayout& layout = shape_.layout();
  if (head.kind != StreamItemKind::kFrame || layout.numMatrices() < 2) return false;
  const std::optional<std::size_t> index = shape_.matrixNamed(head.name);
  if (!index) return false;
  const MatrixLayout& matrix = layout.matrix(*index);
  const bool withTime =
      hasTime(isCountOf(matrix, count), count > 0 && isCountOf(matrix, count - 1));
  const std::size_t given = count - (withTime && count > 0 ? 1 : 0);
  if (!isCountOf(matrix, given)) return false;
  noteOwnFrames();
  if (!hasUsualLength(padLengths_[*index], count) || !orderLists(*index, 1, listOrder_))
    return true;
  StreamItem item;
  item.sequence = head.sequence;
  if (!firstPad_) firstPad_ = options_.startsInside ? 0 : *index;
  if (withTime && !readTime(options_.time, count, *index == *firstPad_, item)) return true;
  if (!continuesPads(*index, head, item)) return true;
  const std::size_t at = layout.readingOffset(*index);
  const auto components = static_cast<std::size_t>(matrix.touch.components);
  std::size_t next = withTime ? 1 : 0;
  for (std::size_t i = 0; i < matrix.numReadings(); ++i)
    partValues_[at + (listOrder_.empty() ? i : listOrder_[i])] =
        given == matrix.numReadings() || matrix.staticMask[i / components] != 0
            ? static_cast<float>(numbers_[next++])
            : 0.0F;
  partSeen_[*index] = true;
  if (++numPartMatrices_ < layout.numMatrices()) return true;
  numPartMatrices_ = 0;
  values_ = partValues_;
  item.deviceUs = partDeviceUs_;
  deliverFrame(item, values_.size(), sink);
  return true;
}

// Whether the line of this matrix belongs to the frame that is being read; begins a frame with the
// matrix that came first. Of a sender that was running already this is matrix 0.
bool StreamLineParser::continuesPads(std::size_t matrix, const Head& head, const StreamItem& item) {
  if (matrix == *firstPad_) {
    dropPart();
    partSeen_.assign(shape_.layout().numMatrices(), false);
    partValues_.resize(shape_.numPlaces());
    partSequence_ = head.sequence;
    partDeviceUs_ = item.deviceUs;
    return true;
  }
  if (numPartMatrices_ == 0) {
    if (!options_.startsInside || stats_.items > 0)
      refuse(inQuotes(head.name) + " came before the first matrix of its frame");
    return false;
  }
  if (!partSeen_[matrix] && head.sequence == partSequence_) return true;
  dropPart();
  return false;
}

// --- A line per row

bool StreamLineParser::mayBeRows() const noexcept {
  return !hasWholeFrames_ && shape_.layout().numMatrices() == 1 &&
         shape_.layout().matrix(0).rows > 1 &&
         (options_.time == StreamTime::kAuto || options_.time == StreamTime::kNone);
}

bool StreamLineParser::isRow(const Head& head, std::size_t count) const noexcept {
  return mayBeRows() && head.name.empty() && !shape_.fits(head.kind, count) &&
         !hasTime(false, count > 0 && shape_.fits(head.kind, count - 1)) &&
         count == rowNumbers(shape_.layout().matrix(0));
}

// Takes a word without numbers: one stands between frames of rows, any other one is refused. Before
// the first row it isn't known whether the stream is one of rows.
bool StreamLineParser::takeWord(const Head& head, std::size_t count) {
  if (count > 0 || head.kind != StreamItemKind::kFrame || head.name.empty() || !mayBeRows())
    return false;
  if (hasRows_ && !isSeparator(head.name)) {
    refuse(inQuotes(head.name) + " is not " + inQuotes(separator_) + ", which separates frames");
    return true;
  }
  separateRows();
  if (hasRows_) return true;
  refuseHeldWord();
  separator_ = head.name;
  heldWord_.emplace(stats_.lines, countFault(head, count));
  return true;
}

// Whether this word stands between frames. The one before the first row may be a greeting: then the
// first other word that comes again behind a whole frame takes its place.
bool StreamLineParser::isSeparator(std::string_view word) {
  const bool isOther = !separator_.empty() && word != separator_;
  if (isOther && (separatorSure_ || numRows_ > 0 || word != otherWord_)) {
    otherWord_ = word;
    return false;
  }
  separator_ = word;
  separatorSure_ = true;
  return true;
}

void StreamLineParser::refuseHeldWord() {
  const auto word = std::exchange(heldWord_, std::nullopt);
  if (!word) return;
  separator_.clear();
  refuse(word->first, word->second);
}

// Takes the line if it is a row, or a line of another length in a stream of rows.
bool StreamLineParser::takeRow(const Head& head, std::size_t count, const Sink& sink) {
  if (head.kind != StreamItemKind::kFrame) return false;
  if (!isRow(head, count)) {
    refuseHeldWord();
    if (!hasRows_ || !head.name.empty() || shape_.fits(head.kind, count)) return false;
    refuse(counted(count, "number") + " instead of " +
           std::to_string(rowNumbers(shape_.layout().matrix(0))) + " in row " +
           std::to_string(numRows_ + 1));
    skipRow();
    return true;
  }
  heldWord_.reset();
  hasRows_ = true;
  noteOwnFrames();
  addRow(sink);
  return true;
}

void StreamLineParser::addRow(const Sink& sink) {
  const MatrixLayout& matrix = shape_.layout().matrix(0);
  const auto rows = static_cast<std::size_t>(matrix.rows);
  const std::size_t columns = rowNumbers(matrix);
  if (!rowsBegin_) {
    // The sender was running already: its first frame is not used, and the next one is known by
    // what stands before it.
    if (++numUnplacedRows_ > rows)
      refuse("it is not known with which row a frame begins: print an empty line after each frame");
    return;
  }
  if (rowsWhole_ && rowsSeparated_) {
    rowsBegin_ = false;
    return refuse("more than " + counted(rows, "row") + " in a frame");
  }
  partValues_.resize(shape_.numPlaces());
  std::transform(numbers_.begin(),
                 numbers_.begin() + static_cast<std::ptrdiff_t>(columns),
                 partValues_.begin() + static_cast<std::ptrdiff_t>(numRows_ * columns),
                 [](double value) { return static_cast<float>(value); });
  if (++numRows_ < rows) return;
  numRows_ = 0;
  rowsWhole_ = true;
  if (std::exchange(rowBroken_, false)) return;
  values_ = partValues_;
  StreamItem item;
  deliverFrame(item, values_.size(), sink);
}

// A refused line stood in the place of a row: its frame is not whole.
void StreamLineParser::skipRow() {
  if (!hasRows_ || !rowsBegin_) return;
  rowBroken_ = true;
  if (++numRows_ < static_cast<std::size_t>(shape_.layout().matrix(0).rows)) return;
  numRows_ = 0;
  rowBroken_ = false;
  rowsWhole_ = true;
}

// An empty line or a word: the next row begins a frame.
void StreamLineParser::separateRows() {
  if (numRows_ > 0 && !rowBroken_)
    refuse("a frame of " + counted(numRows_, "row") + " instead of " +
           std::to_string(shape_.layout().matrix(0).rows));
  numRows_ = 0;
  numUnplacedRows_ = 0;
  rowsBegin_ = true;
  rowsWhole_ = false;
  rowBroken_ = false;
  rowsSeparated_ = rowsSeparated_ || hasRows_;
}

}  // namespace palpate
