#include "palpate/device/stream_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

#include "device/line_tokens.h"

namespace palpate {
namespace {

using namespace line_tokens;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
// Equal times in a row of a clock in milliseconds: 10,000 frames/s.
constexpr int kMaxEqualTimes = 10;
// A clock goes back where it wraps or its sender starts anew; a taxel does so all the time.
constexpr int kMaxTimesBack = 3;
constexpr int kTimesForgetting = 50;
// After so many times that only ascend a number is taken for a time again.
constexpr int kTimesTrusting = 100;
// More frames with the same number are those of a sender that does not count.
constexpr int kMaxSameNumber = 2;

constexpr std::size_t kShortestLimit = 4096;
constexpr std::size_t kBytesPerNumber = 25;
// Times are exact in a double up to here: 285 years.
constexpr double kMaxDeviceUs = 9.0e15;

// True for the words that stand for values that are no finite number: they are not names.
bool isNonFinite(std::string_view word) {
  double value = 0.0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  return failure == std::errc() && end == word.data() + word.size();
}

std::string separatorName(char separator) {
  if (separator == ',') return "commas";
  return separator == ';' ? "semicolons" : "blanks";
}

double unitUs(StreamTime unit, std::string_view written) {
  switch (unit) {
    case StreamTime::kSeconds:
      return 1e6;
    case StreamTime::kMilliseconds:
      return 1e3;
    case StreamTime::kMicroseconds:
      return 1.0;
    case StreamTime::kAuto:
    case StreamTime::kNone:
      break;
  }
  return written.find_first_of(".eE") == std::string_view::npos ? 1e3 : 1e6;
}

std::optional<std::uint32_t> jsonSequence(const Json& number) {
  if (!number.isNumber()) return std::nullopt;
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(number.asInteger()));
}

std::optional<std::int64_t> jsonTimeUs(double us) {
  if (!(std::abs(us) <= kMaxDeviceUs)) throw Error("its time is out of range");
  return std::llround(us);
}

// Reads the matrices of a schunk_sdh/TactileSensor into `values`, one per reading, and notes them
// in `seen`.
void readTactileMatrices(const Json& matrices,
                         const SensorLayout& layout,
                         std::vector<bool>& seen,
                         std::vector<float>& values) {
  if (!matrices.isArray()) throw Error("tactile_matrix is not a list");
  if (matrices.size() == 0 || matrices.size() > layout.numMatrices())
    throw Error(std::to_string(matrices.size()) + " matrices instead of " +
                std::to_string(layout.numMatrices()));
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const Json matrix = matrices.at(i);
    const std::int64_t id = matrix.at("matrix_id").asInteger();
    if (id < 0 || static_cast<std::size_t>(id) >= layout.numMatrices())
      throw Error("there is no matrix " + std::to_string(id));
    const auto index = static_cast<std::size_t>(id);
    if (seen[index]) throw Error("matrix " + std::to_string(id) + " is there twice");
    seen[index] = true;
    const MatrixLayout& known = layout.matrix(index);
    const std::int64_t rows = matrix.at("cells_y").asInteger();
    const std::int64_t columns = matrix.at("cells_x").asInteger();
    const Json array = matrix.at("tactile_array");
    if (rows != known.rows || columns != known.columns || array.size() != known.numReadings())
      throw Error("matrix " + std::to_string(id) + " has " + std::to_string(rows) + " x " +
                  std::to_string(columns) + " places and " + counted(array.size(), "value") +
                  " instead of " + std::to_string(known.rows) + " x " +
                  std::to_string(known.columns) +
                  (known.touch.components == 1 ? "" : " with three values each"));
    for (std::size_t k = 0; k < known.numReadings(); ++k)
      values[layout.readingOffset(index) + k] = static_cast<float>(array.at(k).asDouble());
  }
}

bool hasZeros(std::string_view line) { return line.find('\0') != std::string_view::npos; }

}  // namespace

StreamLineParser::StreamLineParser(StreamShape shape, const StreamLineOptions& options)
    : shape_(std::move(shape)),
      options_(options),
      splitter_(kShortestLimit + kBytesPerNumber * (shape_.numPlaces() + shape_.numAxes() +
                                                    shape_.numTemperatures()),
                options.startsInside),
      numbers_(std::max({shape_.numPlaces(), shape_.numAxes(), shape_.numTemperatures()}) + 1),
      values_(shape_.numPlaces()),
      rowsBegin_(!options.startsInside),
      padLengths_(shape_.layout().numMatrices()) {}

void StreamLineParser::push(std::span<const std::byte> bytes, const Sink& sink) {
  splitter_.push(bytes, [&](const SplitLine& line) { takeSplit(line, sink); });
  countLines();
}

void StreamLineParser::endLine(const Sink& sink) {
  splitter_.endLine([&](const SplitLine& line) { takeSplit(line, sink); });
  countLines();
}

void StreamLineParser::cutOff(const Sink& sink) {
  splitter_.cutOff([&](const SplitLine& line) { takeSplit(line, sink); });
  countLines();
  releaseHeld(sink);
}

void StreamLineParser::countLines() {
  const LineCounts& counts = splitter_.counts();
  stats_.lines = counts.lines;
  stats_.lineBytes = counts.lineBytes;
  stats_.skippedBytes = counts.skippedBytes;
}

void StreamLineParser::takeSplit(const SplitLine& line, const Sink& sink) {
  countLines();
  switch (line.kind) {
    case SplitLine::Kind::kWhole:
      return takeLine(line.text, sink);
    case SplitLine::Kind::kTooLong:
      return refuse(
          line.number,
          "longer than " + std::to_string(longestLine()) + " bytes: no line of this hand is");
    case SplitLine::Kind::kCutOff:
      return refuse("the last line has no end: its last number may be cut off");
  }
}

void StreamLineParser::takeLine(std::string_view line, const Sink& sink) {
  if (line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  line = trimmed(line, " \t");
  if (line.empty()) return separateRows();
  if (line.front() == '#') return;
  if (hasZeros(line))
    return refuse(
        "it has bytes of 0, as UTF-16 and packets have: send ASCII or UTF-8, and packets only from "
        "the beginning on");
  if (line.front() == '{') {
    if (options_.acceptJson)
      readJson(line, sink);
    else
      refuse("this is JSON, and lines of numbers are expected");
  } else if (options_.acceptNumbers) {
    takeText(line, sink);
  } else {
    refuse(inQuotes(line) + " is not a JSON object");
  }
}

// Lists in brackets are numbers; a line of more than one label has labelled values.
void StreamLineParser::takeText(std::string_view line, const Sink& sink) {
  constexpr std::string_view kBrackets = "[]()";
  text_ = line;
  listLengths_.clear();
  const std::size_t last = line.find_last_not_of(",; \t");
  if (kBrackets.find(line.front()) != std::string_view::npos ||
      (last != std::string_view::npos && kBrackets.find(line[last]) != std::string_view::npos)) {
    measureLists(line);
    plain_.assign(line);
    for (char& c : plain_)
      if (kBrackets.find(c) != std::string_view::npos) c = ' ';
    line = trimmed(plain_, " \t");
    if (line.empty()) return refuse("an empty list");
  }
  if (line.front() == '>') line = trimmed(line.substr(1), " \t");
  if (line.empty()) return refuse("nothing follows '>'");
  if (isLetter(line.front()) && std::ranges::count(line, ':') > 1)
    readLabelled(line, sink);
  else
    readNumbers(line, sink);
}

void StreamLineParser::refuse(std::uint64_t line, const std::string& why) {
  ++stats_.refused;
  lastFault_ = "line " + std::to_string(line) + ": " + why;
}

bool StreamLineParser::readHead(std::string_view line, Head& head) {
  const char* at = line.data();
  const char* const end = line.data() + line.size();
  std::string_view name = tokenAt(at, end);
  head.values = at;
  if (at == end || !isLetter(*at) || isNonFinite(name)) return true;
  if (const std::size_t colon = name.find(':'); colon != std::string_view::npos) {
    name = name.substr(0, colon + 1);
    head.hasColon = true;
  }
  at = skipBlanks(at + name.size(), end);
  if (at != end && (*at == ',' || *at == ';')) at = skipBlanks(at + 1, end);
  head.values = at;
  if (name.ends_with(':')) name.remove_suffix(1);
  if (const std::size_t mark = name.find('#'); mark != std::string_view::npos) {
    const auto number = parseInteger(name.substr(mark + 1));
    if (!number || *number < 0) {
      refuse(inQuotes(name) + " has no number after '#'");
      return false;
    }
    head.sequence = static_cast<std::uint32_t>(static_cast<std::uint64_t>(*number));
    name = name.substr(0, mark);
  }
  head.name = name;
  if (name == "angles") head.kind = StreamItemKind::kAngles;
  if (name == "temperatures") head.kind = StreamItemKind::kTemperatures;
  return true;
}

// Reads all numbers and keeps as many as an item can have. Returns how many there are.
std::size_t StreamLineParser::readValues(const char* at, const char* end, bool& failed) {
  const auto refuseValue = [&](const std::string& why) {
    refuse(why);
    failed = true;
  };
  std::size_t count = 0;
  char lineSeparator = '\0';
  while (at != end) {
    double value = 0.0;
    const char* stop = readNumber(at, end, value);
    if (stop == nullptr) {
      const std::string_view token = tokenAt(at, end);
      refuseValue("value " + std::to_string(count + 1) +
                  (token.empty() ? " is empty" : " is " + inQuotes(token) + ", not a number"));
      return count;
    }
    if (count == 0) firstNumber_ = {at, static_cast<std::size_t>(stop - at)};
    if (count < numbers_.size()) numbers_[count] = value;
    ++count;
    char separator = ' ';
    at = skipBlanks(stop, end);
    if (at == end) break;
    if (*at == ',' || *at == ';') separator = *at++;
    at = skipBlanks(at, end);
    if (lineSeparator == '\0') lineSeparator = separator;
    if (separator != lineSeparator) {
      refuseValue("numbers are separated by " + separatorName(lineSeparator) + " and by " +
                  separatorName(separator) +
                  "; send one kind of separator, and decimal points instead of decimal commas");
      return count;
    }
  }
  return count;
}

void StreamLineParser::readNumbers(std::string_view line, const Sink& sink) {
  Head head;
  if (!readHead(line, head) || takeHeader(line, head)) return;
  bool failed = false;
  const std::size_t count = readValues(head.values, line.data() + line.size(), failed);
  if (!failed)
    deliver(head, count, sink);
  else if (head.name.empty())
    skipRow();
}

bool StreamLineParser::hasTime(bool fits, bool fitsWithout) const noexcept {
  if (options_.time == StreamTime::kAuto) return !fits && fitsWithout;
  return options_.time != StreamTime::kNone;
}

// Whether the time of a frame with this number can be compared with the one before: not where the
// frame was overtaken, came twice, or is that of a second sender, whose numbers are behind.
bool StreamLineParser::isNewer(std::optional<std::uint32_t> sequence) {
  if (!sequence) return true;
  const auto step =
      newestSequence_ ? static_cast<std::int32_t>(*sequence - *newestSequence_) : std::int32_t{1};
  if (step == 0 && numSameNumber_ <= kMaxSameNumber) ++numSameNumber_;
  if (step <= 0) return step == 0 && numSameNumber_ > kMaxSameNumber;
  newestSequence_ = sequence;
  numSameNumber_ = 0;
  return true;
}

// Finds out whether guessed times ascend, as those of a clock do.
void StreamLineParser::watchTime(double us) {
  const double before = std::exchange(lastTimeUs_, us).value_or(us - 1.0);
  timesEqual_ = us == before ? std::min(timesEqual_ + 1, kMaxEqualTimes + 1) : 0;
  const bool stands = timesEqual_ > kMaxEqualTimes;
  if (us < before) timesBack_ = std::min(timesBack_ + 1, kMaxTimesBack);
  if (us < before || stands) timesAscending_ = 0;
  if (us > before) {
    timesAscending_ = std::min(timesAscending_ + 1, kTimesTrusting);
    timesForward_ = (timesForward_ + 1) % kTimesForgetting;
    if (timesForward_ == 0 && timesBack_ > 0) --timesBack_;
  }
  if (isNoTime_ && timesAscending_ == kTimesTrusting) {
    isNoTime_ = false;
    timesBack_ = 0;
  }
  if (stands || timesBack_ >= kMaxTimesBack) isNoTime_ = true;
}

// Reads the time, which is the first of `count` numbers. Returns false when it was refused. Of a
// frame of several lines only the times of the first ones are compared.
bool StreamLineParser::readTime(StreamTime unit,
                                std::size_t count,
                                bool beginsFrame,
                                StreamItem& item) {
  const double perUnit = unitUs(unit, firstNumber_);
  const double us = numbers_[0] * perUnit;
  if (!(std::abs(us) <= kMaxDeviceUs)) {
    refuse("the time " + inQuotes(firstNumber_) + " is out of range");
    return false;
  }
  item.deviceUs = std::llround(us);
  if (unit != StreamTime::kAuto || item.kind != StreamItemKind::kFrame) return true;
  if (beginsFrame && isNewer(item.sequence)) watchTime(us);
  const std::string first = "the first of " + std::to_string(count) + " numbers";
  if (isNoTime_) {
    refuse(first + " does not ascend (" + shortened(firstNumber_) +
           "), so it is not the time for which it was taken in " + counted(numGuessed_, "frame") +
           ": name the unit of the time (--time s), or send " + std::to_string(count - 1) +
           " numbers without a time (--time none)");
    return false;
  }
  if (beginsFrame && numGuessed_++ == 0)
    guess_ = first + " of a frame is taken for its time in " +
             (perUnit > 1e3 ? "seconds" : "milliseconds") +
             "; if it is not, name its unit (--time s, ms or us) or --time none";
  return true;
}

void StreamLineParser::deliver(const Head& head, std::size_t count, const Sink& sink) {
  if (takePad(head, count, sink) || takeWord(head, count) || takeRow(head, count, sink)) return;
  const bool withTime =
      hasTime(shape_.fits(head.kind, count), count > 0 && shape_.fits(head.kind, count - 1));
  const std::size_t given = count - (withTime && count > 0 ? 1 : 0);
  if (!shape_.fits(head.kind, given) || (withTime && count == 0)) {
    if (count == 1 && head.hasColon && head.kind == StreamItemKind::kFrame && !hasWholeFrames_ &&
        (!hasOwnFrames_ || labelsNamed_))
      return takeLabel(head.name, numbers_[0], sink);
    return refuse(countFault(head, count));
  }
  if (head.kind == StreamItemKind::kFrame) {
    const bool isOwn = head.name.empty() || shape_.isOwnName(head.name);
    if (!isOfFrames(head.name, isOwn, /*mayWait=*/true, sink)) return;
  }
  if (!hasUsualLength(lengths_[static_cast<std::size_t>(head.kind)], count)) return;
  StreamItem item;
  item.kind = head.kind;
  item.sequence = head.sequence;
  if (withTime && !readTime(options_.time, count, /*beginsFrame=*/true, item)) return;
  const std::span<const double> numbers = std::span(numbers_).subspan(withTime ? 1 : 0, given);
  if (head.kind == StreamItemKind::kFrame) {
    if (!orderLists(0, shape_.layout().numMatrices(), listOrder_)) return;
    endParts();
    const std::vector<std::size_t>& order = listOrder_.empty() ? headerOrder_ : listOrder_;
    const bool isOrdered = order.size() == given;
    for (std::size_t i = 0; i < given; ++i)
      values_[isOrdered ? order[i] : i] = static_cast<float>(numbers[i]);
    return deliverFrame(item, given, sink);
  }
  if (const std::string fault = shape_.check(numbers); !fault.empty()) return refuse(fault);
  item.numbers = numbers;
  ++stats_.items;
  sink(item);
}

// Why a line of `count` numbers is no item.
std::string StreamLineParser::countFault(const Head& head, std::size_t count) const {
  std::string why = counted(count, "number") + " instead of " + shape_.expected(head.kind);
  if (options_.time != StreamTime::kAuto && options_.time != StreamTime::kNone)
    why += " and a time";
  if (shape_.fits(head.kind, count / 2) && count % 2 == 0)
    return why + "; if the values have decimal commas, send decimal points";
  const auto& matrices = shape_.layout().matrices();
  if (head.kind == StreamItemKind::kFrame && !head.name.empty() && matrices.size() > 1 &&
      std::ranges::any_of(matrices, [&](const auto& m) { return m.numReadings() == count; }))
    why += "; a line per matrix begins with the name of its matrix, as the hand has it";
  if (head.kind == StreamItemKind::kFrame && count % 3 == 0 && shape_.fits(head.kind, count / 3) &&
      shape_.numPlaces() == shape_.layout().numCells())
    why += "; with three numbers per taxel, the matrices in hand.json need \"components\": 3";
  return why;
}

// A whole frame in a line: the parts of frames before it are none.
void StreamLineParser::endParts() {
  hasWholeFrames_ = true;
  dropLabels();
  if (hasRows_) separateRows();
  hasRows_ = false;
}

// Delivers a frame of the first `count` ones of values_.
void StreamLineParser::deliverFrame(StreamItem& item, std::size_t count, const Sink& sink) {
  if (std::string outside = shape_.arrange(values_, count); !outside.empty()) {
    ++stats_.outOfRange;
    lastOutOfRange_ = "line " + std::to_string(stats_.lines) + ": " + std::move(outside);
  }
  item.kind = StreamItemKind::kFrame;
  item.values = values_;
  ++stats_.items;
  sink(item);
}

// A frame may come in several messages with the same number, each with some of the matrices.
// Returns it when all of them are there.
std::optional<StreamItem> StreamLineParser::readJsonFrame(const Json& object) {
  const SensorLayout& layout = shape_.layout();
  const Json matrices = object.at("tactile_matrix");
  const Json header = object.at("header");
  const std::optional<std::uint32_t> sequence = jsonSequence(header.at("seq"));
  const bool isWhole = matrices.isArray() && matrices.size() == layout.numMatrices();
  const bool continues = numPartMatrices_ > 0 && sequence && sequence == partSequence_;
  if (!continues) dropPart();
  std::vector<bool> seen = continues ? partSeen_ : std::vector<bool>(layout.numMatrices());
  std::vector<float>& values = isWhole ? values_ : partValues_;
  values.resize(layout.numReadings());
  readTactileMatrices(matrices, layout, seen, values);
  if (!isWhole) {
    if (!sequence)
      throw Error(std::to_string(matrices.size()) + " matrices instead of " +
                  std::to_string(layout.numMatrices()));
    partSequence_ = sequence;
    numPartMatrices_ += matrices.size();
    partSeen_ = std::move(seen);
    if (numPartMatrices_ < layout.numMatrices()) return std::nullopt;
    values_ = partValues_;
    numPartMatrices_ = 0;
  }
  noteOwnFrames();
  StreamItem item;
  item.sequence = sequence;
  const Json stamp = header.at("stamp");
  for (const auto& [whole, part] : {std::pair("secs", "nsecs"), {"sec", "nanosec"}})  // ROS 1, 2
    if (stamp.contains(whole))
      item.deviceUs = jsonTimeUs(1e6 * stamp.at(whole).asDouble() +
                                 1e-3 * (stamp.contains(part) ? stamp.at(part).asDouble() : 0.0));
  return item;
}

// Refuses the frame whose other matrices did not come.
void StreamLineParser::dropPart() {
  if (numPartMatrices_ == 0) return;
  refuse((partSequence_ ? "frame " + std::to_string(*partSequence_) : std::string("a frame")) +
         " has " + std::to_string(numPartMatrices_) + " matrices instead of " +
         std::to_string(shape_.layout().numMatrices()));
  numPartMatrices_ = 0;
}

void StreamLineParser::readJson(std::string_view line, const Sink& sink) {
  std::vector<StreamItem> items;
  std::vector<double> angles;
  std::vector<double> temperatures;
  std::string description;
  bool isFrame = false;
  try {
    Json object = Json::parse(line);
    // rosbridge sends a message in an envelope.
    if (const Json op = object.at("op"); op.isString() && op.asString() == "publish")
      object = object.at("msg");
    const auto addNumbers = [&](const char* key, StreamItemKind kind, std::vector<double>& kept) {
      if (!object.contains(key)) return;
      const Json list = object.at(key);
      for (std::size_t i = 0; i < list.size(); ++i) kept.push_back(list.at(i).asDouble());
      if (!shape_.fits(kind, kept.size()))
        throw Error(std::string(key) + ": " + counted(kept.size(), "number") + " instead of " +
                    shape_.expected(kind));
      StreamItem item;
      item.kind = kind;
      item.numbers = kept;
      items.push_back(item);
    };
    addNumbers("angles_deg", StreamItemKind::kAngles, angles);
    addNumbers("temperatures_degc", StreamItemKind::kTemperatures, temperatures);
    if (object.contains("description")) {
      description = object.at("description").text(-1);
      StreamItem item;
      item.kind = StreamItemKind::kDescription;
      item.text = description;
      items.push_back(item);
    }
    if (object.contains("tactile_matrix")) {
      if (std::optional<StreamItem> item = readJsonFrame(object)) items.push_back(*item);
      isFrame = true;
    }
    // The signals of a frame come in several objects; angles and temperatures are in the first.
    const bool isSignals = object.at("t").isNumber() && object.at("sequence").isNumber();
    if (isSignals && !items.empty()) readsSignals_ = true;
    if (items.empty() && !isFrame && !(isSignals && readsSignals_))
      throw Error(
          "it has none of tactile_matrix, angles_deg, temperatures_degc and description: nothing "
          "of it can be shown");
  } catch (const Error& error) {
    return refuse(error.what());
  }
  for (StreamItem& item : items) {
    if (item.kind == StreamItemKind::kFrame) {
      deliverFrame(item, values_.size(), sink);
      continue;
    }
    ++stats_.items;
    sink(item);
  }
}

}  // namespace palpate
