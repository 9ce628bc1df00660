// Scans the plain part of XML directly: elements with ASCII names, attributes and text without
// references. Recordings contain nothing else. As soon as anything else appears (comment, CDATA,
// '&', other characters, an error), XmlParser continues with expat.
//
// expat does not read everything because it is slower. The blocks of a recording are decompressed
// on all cores, but parsed one after the other: what the parser takes can't be shared among cores.
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

  // Scans bytes as long as they are plain. Returns false when they no longer are: rest() is then
  // what remains, and the scanner must not be used further. Throws what the handler throws, and
  // XmlError for too many levels.
  bool push(std::string_view bytes);
  // Returns whether the document may end here.
  bool complete() const noexcept { return rootEnded_ && openNames_.empty() && carried_.empty(); }

  // For the parser that continues: tags that bring it into the same state, and the bytes that
  // follow.
  std::string prefix() const;
  const std::string& rest() const noexcept { return rest_; }
  int depth() const noexcept { return static_cast<int>(openBegins_.size()); }

  // Position of the event being handled, or of the event whose handler threw; otherwise the number
  // of scanned bytes [bytes].
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
  std::string openNames_;  // names of the open elements, one after the other
  std::vector<std::size_t> openBegins_;
  std::string attributeText_;  // names and values, each followed by a null character
  std::vector<std::size_t> attributeBegins_;
  std::vector<const char*> attributes_;
  std::uint64_t position_ = 0;
  std::uint64_t eventOffset_ = 0;
  bool inEvent_ = false;
  bool begun_ = false;
  bool rootEnded_ = false;
  bool afterReturn_ = false;  // the last character was a carriage return, passed on as a line feed
};

}  // namespace palpate
