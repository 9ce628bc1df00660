// The plain part of XML, scanned directly: elements with ASCII names, attributes and text without
// references. That is all a recording is made of. What is anything else (comment, CDATA, '&', other
// characters, an error) is left to expat.
//
// Why expat doesn't read everything: all 609 shared recordings are then read with 1.26 times the
// processor time (median of seven pairs of runs), since the parsing thread takes 1.00 s instead of
// 0.72 s. `bzip2 -dc` takes 0.9 to 1.25 s for the same files, so that the parsing thread alone
// would exceed 0.7 times its time, which reading is to stay below once decompression runs on all
// cores.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/xml.h"

namespace palpate {

class XmlScanner {
 public:
  XmlScanner(XmlHandler& handler, int maxDepth) : handler_(handler), maxDepth_(maxDepth) {}

  // Takes bytes as far as they are plain. False: they are not any more; rest() is what is left, and
  // the scanner is at its end. Throws what the handler throws, XmlError for too many levels.
  bool push(std::string_view bytes);
  // Whether the document could end here.
  bool complete() const noexcept { return rootEnded_ && openNames_.empty() && carried_.empty(); }

  // For the parser that takes over: the tags that bring it into the same state, and what follows.
  std::string prefix() const;
  const std::string& rest() const noexcept { return rest_; }
  int depth() const noexcept { return static_cast<int>(openBegins_.size()); }

  // Position of the event being handled, or where one was when the handler threw; else the bytes
  // taken. [bytes]
  std::uint64_t offset() const noexcept { return inEvent_ ? eventOffset_ : position_; }
  std::uint64_t position() const noexcept { return position_; }

 private:
  enum class Step { kDone, kNeedMore, kLeave };
  Step begin(std::string_view& bytes);
  Step scanText(std::string_view& bytes);
  Step scanTag(std::string_view& bytes);
  Step scanEndTag(std::string_view tag);
  Step scanStartTag(std::string_view tag);
  bool parseAttributes(std::string_view text);
  void closeElement(std::string_view name);
  void tellText(std::string_view piece);
  void take(std::string_view& bytes, std::size_t count) {
    bytes.remove_prefix(count);
    position_ += count;
  }

  XmlHandler& handler_;
  int maxDepth_;
  std::string carried_;  // an unfinished tag from the last push
  std::string rest_;
  std::string openNames_;  // of the open elements, one after the other
  std::vector<std::size_t> openBegins_;
  std::string attributeText_;  // names and values, each ended by a null character
  std::vector<std::size_t> attributeBegins_;
  std::vector<const char*> attributes_;
  std::uint64_t position_ = 0;
  std::uint64_t eventOffset_ = 0;
  bool inEvent_ = false;
  bool begun_ = false;
  bool rootEnded_ = false;
  bool afterReturn_ = false;  // the last character was a carriage return, told as a line feed
};

}  // namespace palpate
