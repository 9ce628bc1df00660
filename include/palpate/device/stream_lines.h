// Reads a stream of text lines: numbers separated by commas, semicolons or white space, one line
// per frame, per matrix, or per row of the only matrix; values with labels ("A0:1,A1:2"); or JSON
// objects as `palpate stream` sends them. docs/manual/stream_protocol.md specifies all of them.
//
// The numbers of a line are read without an allocation; JSON objects take several.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/device/line_splitter.h>
#include <palpate/device/stream_shape.h>

namespace palpate {
class Json;

// The time at the beginning of a line.
enum class StreamTime {
  // A time is there if the line has exactly one number more than the item has values. It is in
  // seconds when it is written with a decimal point or an exponent, otherwise in milliseconds;
  // guess() says so. Lines whose first number turns out not to ascend are refused, until it ascends
  // for a while.
  kAuto,
  kNone,
  kSeconds,
  kMilliseconds,
  kMicroseconds,
};
inline constexpr std::array<OptionWord<StreamTime>, 5> kStreamTimeWords{
    {{"auto", StreamTime::kAuto},
     {"none", StreamTime::kNone},
     {"s", StreamTime::kSeconds},
     {"ms", StreamTime::kMilliseconds},
     {"us", StreamTime::kMicroseconds}}};

// Which value of a frame each label stands for, by the labels and, where they don't say it, by
// their order; nothing when they fit no frame. Adds what was guessed to `notes`.
using PlacesOfLabels = std::function<std::vector<std::size_t>(
    const std::vector<std::string>& labels, std::vector<std::string>& notes)>;

struct StreamLineOptions {
  StreamTime time = StreamTime::kAuto;
  bool acceptNumbers = true;  // lines of numbers
  bool acceptJson = true;     // lines that begin with '{'
  // True when the first line may lack its beginning, as on a serial port whose sender is running.
  // It is not used then, because a number could lack its first digits.
  bool startsInside = false;
  // Of values with labels; empty: the order of the first frame says it.
  PlacesOfLabels placesOfLabels = {};
};

// Every byte that was pushed is in exactly one of lineBytes, skippedBytes and pendingBytes().
struct StreamLineStats {
  std::uint64_t lines = 0;  // complete lines, also empty ones and comments
  std::uint64_t items = 0;  // handed to the sink
  // Lines with another content than an item, empty lines and comments.
  std::uint64_t refused = 0;
  // Frames with a value outside of the description of the hand; they are among `items`.
  std::uint64_t outOfRange = 0;
  std::uint64_t lineBytes = 0;  // bytes of complete lines, with their line ends
  // Bytes of lines that are too long, or that lack their beginning.
  std::uint64_t skippedBytes = 0;
};

// Not thread-safe. Never throws for bad input: a bad line is counted, and lastFault() names it.
class StreamLineParser {
 public:
  using Sink = std::function<void(const StreamItem&)>;
  explicit StreamLineParser(StreamShape shape, const StreamLineOptions& options = {});

  // Consumes all bytes; calls `sink` once for each item, in order.
  void push(std::span<const std::byte> bytes, const Sink& sink);
  // Takes what is pending as a line, at the end of a datagram or of the input.
  void endLine(const Sink& sink);
  // The same where more may have followed, at the end of a connection: a line of numbers without
  // its end is refused, since the last one may lack digits.
  void cutOff(const Sink& sink);
  // Takes labels that come in another order than in an earlier connection by their names.
  void knowLabelsOf(const StreamLineParser& earlier) { knownLabels_ = earlier.knownLabels_; }
  const StreamLineStats& stats() const noexcept { return stats_; }
  std::size_t pendingBytes() const noexcept { return splitter_.pendingBytes(); }
  // What is wrong with the last refused line, and which it is: "line 812: 255 numbers instead of
  // 256". Lines are counted from 1. Empty when none was refused.
  const std::string& lastFault() const noexcept { return lastFault_; }
  // The last value outside of the description: "line 9: value 2 is 5880, not in 0..1023 counts".
  const std::string& lastOutOfRange() const noexcept { return lastOutOfRange_; }
  // What the first number of a line was taken for with StreamTime::kAuto; empty: nothing yet.
  const std::string& guess() const noexcept { return guess_; }
  // What else was guessed: which lines are frames, and which taxel each value is.
  const std::vector<std::string>& notes() const noexcept { return notes_; }
  // Longest line that is read [bytes], enough for the hand's values with 25 characters each.
  std::size_t longestLine() const noexcept { return splitter_.longest(); }

 private:
  // What a line of numbers begins with.
  struct Head {
    StreamItemKind kind = StreamItemKind::kFrame;
    std::string_view name;  // without its colon and number; empty: none
    bool hasColon = false;
    std::optional<std::uint32_t> sequence;
    const char* values = nullptr;  // where the numbers begin
  };
  // What the first lines have and the later ones must have, too. Something else takes its place
  // when it comes more often in a row than the first did: that was cut off, or a greeting.
  template <typename T>
  struct Usual {
    T value{};
    T other{};
    int times = 0;
    int otherTimes = 0;
    bool accepts(const T& seen) {
      constexpr int kMany = 20;
      if (times == 0) value = seen;
      if (seen == value) {
        times = times < kMany ? times + 1 : kMany;
        otherTimes = 0;
        return true;
      }
      otherTimes = otherTimes > 0 && seen == other ? otherTimes + 1 : 1;
      other = seen;
      if (otherTimes <= times) return false;
      value = seen;
      times = otherTimes;
      otherTimes = 0;
      return true;
    }
  };
  void takeSplit(const SplitLine& line, const Sink& sink);
  void countLines();
  void takeLine(std::string_view line, const Sink& sink);
  void takeText(std::string_view line, const Sink& sink);
  void readNumbers(std::string_view line, const Sink& sink);
  void readJson(std::string_view line, const Sink& sink);
  std::optional<StreamItem> readJsonFrame(const Json& object);
  void dropPart();
  bool readHead(std::string_view line, Head& head);
  std::size_t readValues(const char* at, const char* end, bool& failed);
  void deliver(const Head& head, std::size_t count, const Sink& sink);
  std::string countFault(const Head& head, std::size_t count) const;
  void note(const std::string& text);

  // Which lines are those of frames.
  bool hasUsualLength(Usual<std::size_t>& usual, std::size_t count);
  bool isOfFrames(std::string_view name, bool isOwn, bool mayWait, const Sink& sink);
  void noteOwnFrames();
  void releaseHeld(const Sink& sink);

  // The order of the values, where it is not that of the hand.
  bool takeHeader(std::string_view line, const Head& head);
  void measureLists(std::string_view line);
  bool orderLists(std::size_t matrix, std::size_t numMatrices, std::vector<std::size_t>& order);

  void endParts();
  void deliverFrame(StreamItem& item, std::size_t count, const Sink& sink);

  // The time before the values.
  bool hasTime(bool fits, bool fitsWithout) const noexcept;
  bool readTime(StreamTime unit, std::size_t count, bool beginsFrame, StreamItem& item);
  bool isNewer(std::optional<std::uint32_t> sequence);
  void watchTime(double us);

  // A line per matrix.
  bool takePad(const Head& head, std::size_t count, const Sink& sink);
  bool continuesPads(std::size_t matrix, const Head& head, const StreamItem& item);

  // A line per row.
  bool mayBeRows() const noexcept;
  bool takeWord(const Head& head, std::size_t count);
  bool isSeparator(std::string_view word);
  bool takeRow(const Head& head, std::size_t count, const Sink& sink);
  bool isRow(const Head& head, std::size_t count) const noexcept;
  void addRow(const Sink& sink);
  void skipRow();
  void separateRows();
  void refuseHeldWord();

  // Values with labels.
  void readLabelled(std::string_view line, const Sink& sink);
  bool readPairs(std::string_view line);
  bool learnLabels(bool mayBeInside);
  bool findPlacesOfLabels(const std::vector<std::string>& labels, std::vector<std::size_t>& places);
  void orderByNumbers();
  bool beginsInside();
  bool leaveOutOtherLabels();
  void takeLabelled(std::size_t from, StreamItem& item, const Sink& sink);
  void takeLabel(std::string_view label, double value, const Sink& sink);
  bool endsFirstLabels(std::string_view label, const Sink& sink);
  void dropLabels();
  void forgetLabels();
  std::optional<std::size_t> placeOfLabel(std::string_view label, std::size_t likely) const;

  void refuse(const std::string& why) { refuse(stats_.lines, why); }
  void refuse(std::uint64_t line, const std::string& why);

  StreamShape shape_;
  StreamLineOptions options_;
  LineSplitter splitter_;
  StreamLineStats stats_;
  std::string lastFault_;
  std::string lastOutOfRange_;
  std::string guess_;
  std::vector<std::string> notes_;
  std::string plain_;             // the present line without its brackets
  std::vector<double> numbers_;   // of the present line, as many as an item has at most
  std::string_view firstNumber_;  // as it was written
  std::vector<float> values_;
  // The times that were guessed.
  std::optional<double> lastTimeUs_;
  int timesEqual_ = 0;
  int timesBack_ = 0;
  int timesForward_ = 0;    // since a time that went back was forgotten
  int timesAscending_ = 0;  // since one went back or stood
  bool isNoTime_ = false;
  std::uint64_t numGuessed_ = 0;  // frames
  std::optional<std::uint32_t> newestSequence_;
  int numSameNumber_ = 0;        // frames with this number again
  bool hasWholeFrames_ = false;  // frames come in one line each
  // A frame of which only some matrices came yet.
  std::size_t numPartMatrices_ = 0;  // 0: none
  std::optional<std::uint32_t> partSequence_;
  std::optional<std::int64_t> partDeviceUs_;
  std::vector<bool> partSeen_;  // per matrix
  std::vector<float> partValues_;
  std::optional<std::size_t> firstPad_;  // the matrix with which a frame begins
  // A frame of which only some rows came yet.
  std::size_t numRows_ = 0;
  bool hasRows_ = false;        // the stream is known to have a line per row
  bool rowsBegin_ = true;       // the next row is known to be the first one of a frame
  bool rowsSeparated_ = false;  // something stands between two frames
  bool rowsWhole_ = false;      // a frame ended, and nothing stood behind it yet
  bool rowBroken_ = false;      // a row of this frame was refused
  std::size_t numUnplacedRows_ = 0;
  std::optional<std::pair<std::uint64_t, std::string>> heldWord_;  // line and fault
  std::string separator_;       // the word between two frames; empty: none came
  bool separatorSure_ = false;  // it also came behind a row
  std::string otherWord_;       // the last other one
  // Labels in the order in which they come, the value of a frame that each stands for, and those of
  // the present line.
  std::vector<std::string> labels_;
  std::vector<std::size_t> valueOf_;
  std::map<std::string, std::size_t, std::less<>> placeOf_;
  bool labelsLearned_ = false;
  bool labelsNamed_ = false;  // they say themselves which values they are
  // The values of the labels that were learned last, here or in an earlier connection.
  std::map<std::string, std::size_t, std::less<>> knownLabels_;
  std::vector<std::string_view> lineLabels_;
  std::vector<bool> labelSeen_;  // of a frame with a line per label
  std::size_t numLabelsSeen_ = 0;
  // Which lines are frames, by their number of numbers and by their names.
  std::array<Usual<std::size_t>, 3> lengths_;   // per kind of item
  std::vector<Usual<std::size_t>> padLengths_;  // per matrix
  Usual<std::size_t> labelledLength_;
  bool hasOwnFrames_ = false;  // frames came without a name, or with one of the hand
  Usual<std::string> otherName_;
  std::string_view text_;  // the present line as it came
  // The first line with another name, until the next line says whether it is a frame.
  std::optional<std::pair<std::uint64_t, std::string>> heldLine_;
  // The value of a frame that each value of a line is; empty: in the order of the hand.
  std::vector<std::size_t> headerOrder_;
  std::vector<std::size_t> listOrder_;
  std::vector<std::size_t> listLengths_;  // numbers in each of the innermost lists of a line
  // Whether signals of a frame were read: further parts of them hold nothing to show.
  bool readsSignals_ = false;
};

}  // namespace palpate
