#include "palpate/recording/dsa_recovery.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/xml.h"
#include "palpate/model/gap_detector.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/timing.h"
#include "palpate/recording/bzip2_blocks.h"
#include "palpate/recording/recording_losses.h"

#include "recording/dsa/dsa_document.h"
#include "recording/dsa/dsa_xml_stream.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxElementBytes = 4u << 20;  // longer than any frame of a real sensor
// A bzip2 block holds at most 900 kB, which its first run-length code can stretch 51 times.
constexpr std::size_t kDsaRecoveryMaxBlockBytes = 46u << 20;
// Bits from a stream's end mark to the first block of a next stream: mark, checksum, padding,
// header.
constexpr std::uint64_t kMaxSeamBits = 48 + 32 + 7 + 32;

struct Element {
  std::string_view name;
  DsaDocument::Fragment fragment;
};
constexpr Element kElements[] = {{"frame", DsaDocument::Fragment::kFrame},
                                 {"angle", DsaDocument::Fragment::kAngles},
                                 {"temp", DsaDocument::Fragment::kTemperatures},
                                 {"sensor", DsaDocument::Fragment::kSensor}};
constexpr std::size_t kMaxNameLength = 16;  // "</sensor" and what tells its end, generously
constexpr std::size_t kLongestTag = 1024;   // of an element with its attributes
// More samples than damage can spoil: what follows is counted as bad without a look at it.
constexpr std::size_t kMaxBadSamples = 50'000;

bool endsName(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '>' || c == '/';
}

// Which of the elements a tag that starts with `tag` (behind "<" or "</") belongs to.
const Element* elementOf(std::string_view tag) {
  for (const Element& element : kElements)
    if (tag.starts_with(element.name) && tag.size() > element.name.size() &&
        endsName(tag[element.name.size()]))
      return &element;
  return nullptr;
}

// The number that a frame has in its file, of its opening tag; nothing when there is none.
std::optional<std::int64_t> indexOf(std::string_view element) {
  constexpr std::string_view kIndex = " index=\"";
  const std::string_view tag = element.substr(0, element.find('>'));
  const std::size_t at = tag.find(kIndex);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view number = tag.substr(at + kIndex.size());
  return parseInteger(number.substr(0, number.find('"')));
}

// Finds whole elements in stretches of text and hands them to the document, one by one: one that is
// wrong harms no other.
class ElementScanner {
 public:
  ElementScanner(DsaDocument& document, DsaRecovery& result)
      : document_(document), result_(result) {}

  // The next piece of the stretch.
  void add(std::string_view piece) {
    pending_ += piece;
    scan();
    const std::size_t keep = open_ ? openBegin_ : position_;
    pending_.erase(0, keep);
    position_ -= keep;
    openBegin_ = 0;
    if (pending_.size() > kMaxElementBytes) breakHere();
  }

  // Of each frame that was taken: its number in the file.
  const std::vector<std::optional<std::int64_t>>& frameNumbers() const noexcept {
    return frameNumbers_;
  }

  // The stretch ends: what follows is not its continuation.
  void breakHere() {
    if (open_) ++result_.cutSamples;
    open_ = nullptr;
    openBegin_ = 0;
    position_ = 0;
    pending_.clear();
  }

 private:
  void scan() {
    const std::string_view text = pending_;
    while (!anotherBegins_) {
      const std::size_t begin = text.find('<', position_);
      position_ = std::min(begin, text.size());
      if (begin == std::string_view::npos) return;
      const std::string_view tag = text.substr(begin, kLongestTag);
      const std::size_t length = tag.find_first_of("<>", 1);
      const bool ends = length != std::string_view::npos;
      // A tag whose end has not come yet: wait, unless its name tells that it means nothing.
      if (!ends && tag.size() < kMaxNameLength) return;
      const bool closes = tag.substr(1).starts_with('/');
      const Element* element = elementOf(tag.substr(closes ? 2 : 1));
      if (element && !ends && tag.size() < kLongestTag) return;
      if (element && ends && tag[length] == '>') {
        if (closes)
          close(*element, begin + length + 1);
        else
          open(*element, begin);
      }
      position_ = begin + (ends ? length : 1);
    }
    position_ = text.size();
  }

  void open(const Element& element, std::size_t begin) {
    // A second sensor is another recording behind this one: their frames are not mixed.
    if (element.fragment == DsaDocument::Fragment::kSensor && document_.hasLayout())
      anotherBegins_ = true;
    if (open_) ++result_.cutSamples;
    open_ = &element;
    openBegin_ = begin;
  }

  void close(const Element& element, std::size_t end) {
    if (open_ != &element) {  // its beginning is lost
      if (element.fragment != DsaDocument::Fragment::kSensor) ++result_.cutSamples;
    } else {
      take(element, std::string_view(pending_).substr(openBegin_, end - openBegin_));
    }
    open_ = nullptr;
  }

  void take(const Element& element, std::string_view text) {
    const bool isSensor = element.fragment == DsaDocument::Fragment::kSensor;
    if (isSensor && document_.hasLayout()) return;
    if (result_.badSamples >= kMaxBadSamples) {
      ++result_.badSamples;
      return;
    }
    if (!isSensor && !document_.hasLayout()) {
      document_.useLayout(defaultHand().layout);
      result_.layoutAssumed = true;
    }
    try {
      document_.beginFragment(element.fragment);
      XmlParser parser(document_);
      parser.push(text);
      parser.finish();
      if (element.fragment == DsaDocument::Fragment::kFrame) frameNumbers_.push_back(indexOf(text));
    } catch (const XmlError&) {
      if (!isSensor) ++result_.badSamples;
    } catch (const Error&) {
      if (!isSensor) ++result_.badSamples;
    }
  }

  DsaDocument& document_;
  DsaRecovery& result_;
  std::vector<std::optional<std::int64_t>> frameNumbers_;
  std::string pending_;  // text from the element that is open, or not looked at yet
  std::size_t position_ = 0;
  const Element* open_ = nullptr;
  std::size_t openBegin_ = 0;
  bool anotherBegins_ = false;
};

std::vector<std::byte> readAll(const std::filesystem::path& path) {
  FileSource source(path);
  if (source.numBytes() > kMaxRecoveryBytes)
    throw FileError(path,
                    "is too large to be searched for intact parts: more than " +
                        std::to_string(kMaxRecoveryBytes >> 20) + " MB");
  std::vector<std::byte> bytes(static_cast<std::size_t>(source.numBytes()));
  bytes.resize(source.read({reinterpret_cast<char*>(bytes.data()), bytes.size()}));
  return bytes;
}

class Reporter {
 public:
  explicit Reporter(const Progress& progress) : progress_(progress) {}
  void operator()(std::size_t done, std::size_t all) const { reportProgress(progress_, done, all); }

 private:
  const Progress& progress_;
};

void scanBlocks(std::span<const std::byte> bytes,
                std::uint64_t maxBytes,
                const Reporter& report,
                ElementScanner& scanner,
                DsaRecovery& result) {
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(bytes);
  result.blocks = blocks.size();
  std::uint64_t expanded = 0;
  std::optional<std::uint64_t> joinsAtBit;  // where the stretch goes on
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    report(i, blocks.size());
    const auto room = std::min<std::uint64_t>(kDsaRecoveryMaxBlockBytes, maxBytes - expanded);
    const Bzip2BlockContent content =
        decodeBzip2Block(bytes, blocks[i], static_cast<std::size_t>(room));
    if (!joinsAtBit || blocks[i].beginBit - *joinsAtBit > kMaxSeamBits) scanner.breakHere();
    joinsAtBit.reset();
    if (!content.intact) {
      scanner.breakHere();
      continue;
    }
    ++result.intactBlocks;
    expanded += content.bytes.size();
    constexpr std::size_t kPiece = 64u << 10;
    const std::string_view text(content.bytes.data(), content.bytes.size());
    for (std::size_t at = 0; at < text.size(); at += kPiece) scanner.add(text.substr(at, kPiece));
    if (content.endsAtMark) joinsAtBit = blocks[i].endBit;
  }
}

// Plain XML carries no checksum: whatever is well-formed is taken.
void scanText(std::span<const std::byte> bytes, const Reporter& report, ElementScanner& scanner) {
  constexpr std::size_t kPiece = 64u << 10;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    report(at, text.size());
    scanner.add(text.substr(at, kPiece));
  }
}

constexpr std::string_view kWasDamaged = "the file was damaged";

Event lossEvent(std::int64_t fromUs,
                std::int64_t toUs,
                std::optional<std::int64_t> count,
                const std::string& text) {
  Json details = Json::object().set("stream", "tactile");
  if (count) details.set("lost", *count);
  details.set("reason", kWasDamaged);
  return {fromUs, toUs, "gap", std::nullopt, text, details.text(-1)};
}

std::string lostFrames(std::optional<std::int64_t> count, std::string_view where) {
  if (!count) return "the frames " + std::string(where) + " are lost";
  return counted(static_cast<std::uint64_t>(*count), "frame") + " " + std::string(where) +
         (*count == 1 ? " is lost" : " are lost");
}

std::string secondsText(std::int64_t us) {
  constexpr int kDecimals = 1;
  return fixedText(static_cast<double>(us) / 1e6, kDecimals) + " s";
}

// Finds the spans whose frames are lost. `numbers`: of the frames of the profile, in their file.
void findLosses(const Profile& profile,
                std::vector<std::optional<std::int64_t>> numbers,
                DsaRecovery& result) {
  // Numbers may be damaged themselves.
  constexpr std::int64_t kMaxFrames = std::numeric_limits<std::int32_t>::max();
  for (std::optional<std::int64_t>& number : numbers)
    if (number && (*number < 0 || *number > kMaxFrames)) number.reset();
  const std::size_t numFrames = profile.numFrames();
  const bool damaged = result.intactBlocks < result.blocks || result.cutSamples > 0 ||
                       result.badSamples > 0 || result.layoutAssumed;
  if (!damaged || numFrames == 0 || numbers.size() != numFrames) return;
  std::vector<std::string> texts;
  const auto add = [&](Event loss) {
    texts.push_back(loss.text);
    result.losses.push_back(std::move(loss));
  };

  const TimingReport timing = timingOf(profile);
  const double usualS = timing.rateHz > 0.0 ? 1.0 / timing.rateHz : 0.0;
  const std::int64_t firstUs = profile.frameTimeUs(0);
  const std::optional<std::int64_t> before = numbers.front();
  if (before ? *before > 0 : result.layoutAssumed) {
    const std::int64_t fromUs =
        profile.numAngles() > 0 ? std::min(firstUs, profile.angleTimeUs(0)) : firstUs;
    std::string text = lostFrames(before, "before the first one that can be read") + ": ";
    text += fromUs < firstUs
                ? "the joint angles begin " + secondsText(firstUs - fromUs) + " earlier"
                : std::string(kWasDamaged);
    add(lossEvent(fromUs, firstUs, before, text));
  }

  std::vector<Event> between;
  for (std::size_t i = 1; i < numFrames; ++i) {
    if (!numbers[i - 1] || !numbers[i] || *numbers[i] <= *numbers[i - 1] + 1) continue;
    const std::int64_t count = *numbers[i] - *numbers[i - 1] - 1;
    const std::int64_t fromUs = profile.frameTimeUs(i - 1), toUs = profile.frameTimeUs(i);
    // More frames than the hand can have sent meanwhile: a number is damaged, too.
    if (static_cast<double>(count) * usualS > 2.0 * static_cast<double>(toUs - fromUs) / 1e6)
      continue;
    between.push_back(lossEvent(
        fromUs,
        toUs,
        count,
        counted(static_cast<std::uint64_t>(count), "frame") + " lost: the file was damaged"));
  }
  if (!between.empty()) texts.push_back("lost between them: " + lossesOf(between).front().text());
  std::move(between.begin(), between.end(), std::back_inserter(result.losses));

  const std::int64_t lastUs = profile.frameTimeUs(numFrames - 1);
  const std::int64_t anglesEndUs =
      profile.numAngles() > 0 ? profile.angleTimeUs(profile.numAngles() - 1) : lastUs;
  if (static_cast<double>(anglesEndUs - lastUs) / 1e6 > gapThresholdS(usualS))
    add(lossEvent(lastUs,
                  anglesEndUs,
                  std::nullopt,
                  lostFrames(std::nullopt, "after the last one that can be read") +
                      ": the joint angles end " + secondsText(anglesEndUs - lastUs) + " later"));
  for (const std::string& text : texts)
    result.lossText += (result.lossText.empty() ? "" : "; ") + text;
}

}  // namespace

DsaRecovery recoverDsaProfile(const std::filesystem::path& path,
                              const Progress& progress,
                              const DsaReadOptions& options) {
  return recoverDsaProfileBytes(readAll(path), path, progress, options);
}

DsaRecovery recoverDsaProfileBytes(std::span<const std::byte> bytes,
                                   const std::filesystem::path& name,
                                   const Progress& progress,
                                   const DsaReadOptions& options) {
  const DsaEncoding form =
      requireDsaEncoding({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);

  DsaRecovery result;
  DsaDocument document(options, memoryBound(options, form == DsaEncoding::kBzip2, bytes.size()));
  ElementScanner scanner(document, result);
  const Reporter report(progress);
  if (form == DsaEncoding::kBzip2)
    scanBlocks(bytes,
               boundFor(options.freeBytes, options.maxRatio, bytes.size()),
               report,
               scanner,
               result);
  else
    scanText(bytes, report, scanner);
  scanner.breakHere();
  report(1, 1);

  const bool foreign = result.layoutAssumed && document.numFrames() == 0 && result.badSamples > 0;
  result.frames = foreign ? 0 : document.numFrames();
  result.angles = foreign ? 0 : document.numAngles();
  result.temperatures = foreign ? 0 : document.numTemperatures();
  if (result.frames + result.angles + result.temperatures > 0)
    result.profile = document.finishFragments();
  if (result.profile && !foreign) findLosses(*result.profile, scanner.frameNumbers(), result);
  return result;
}

}  // namespace palpate
