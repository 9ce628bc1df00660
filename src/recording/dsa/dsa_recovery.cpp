#include "palpate/recording/dsa_recovery.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/core/xml.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/bzip2_blocks.h"

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
    } catch (const XmlError&) {
      if (!isSensor) ++result_.badSamples;
    } catch (const Error&) {
      if (!isSensor) ++result_.badSamples;
    }
  }

  DsaDocument& document_;
  DsaRecovery& result_;
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
  return result;
}

}  // namespace palpate
