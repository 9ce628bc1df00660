#include "core/xml_scanner.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace palpate {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kDeclaration = R"(<?xml version="1.0" encoding="utf-8"?>)";
constexpr std::size_t kMaxTagBytes = 1024;  // longer tags are left to expat

// Classes of characters (bits).
constexpr std::uint8_t kText = 1;       // is a literal character in text
constexpr std::uint8_t kNameStart = 2;  // starts an ASCII name
constexpr std::uint8_t kName = 4;
constexpr std::uint8_t kBlank = 8;
constexpr std::uint8_t kValue = 16;  // is a literal character in the value of an attribute

constexpr std::array<std::uint8_t, 256> makeClasses() {
  std::array<std::uint8_t, 256> classes{};
  for (int c = ' '; c < 0x7F; ++c) classes[static_cast<std::size_t>(c)] = kText | kValue;
  classes['\t'] = kText | kBlank;
  classes['\n'] = kText | kBlank;
  classes['\r'] = kBlank;
  classes[' '] |= kBlank;
  classes['<'] = classes['&'] = 0;
  classes[']'] = kValue;  // "]]>" is an error in text
  for (int c = 'a'; c <= 'z'; ++c) classes[static_cast<std::size_t>(c)] |= kNameStart | kName;
  for (int c = 'A'; c <= 'Z'; ++c) classes[static_cast<std::size_t>(c)] |= kNameStart | kName;
  for (int c = '0'; c <= '9'; ++c) classes[static_cast<std::size_t>(c)] |= kName;
  classes['_'] |= kNameStart | kName;
  classes['-'] |= kName;
  classes['.'] |= kName;
  return classes;
}
constexpr std::array<std::uint8_t, 256> kClasses = makeClasses();

bool is(char c, std::uint8_t wanted) {
  return (kClasses[static_cast<unsigned char>(c)] & wanted) != 0;
}

// Eight characters at once, each in one byte of a word.
constexpr std::size_t kWordBytes = sizeof(std::uint64_t);
constexpr std::uint64_t inEachByte(char c) {
  return 0x0101010101010101u * static_cast<unsigned char>(c);
}
constexpr std::uint64_t kHighBits = inEachByte('\x80');

// Nonzero when a byte of `word` is smaller than `bound` (at most 0x80; another bit than that of the
// byte may be set, too).
constexpr std::uint64_t anyBelow(std::uint64_t word, char bound) {
  return (word - inEachByte(bound)) & ~word & kHighBits;
}
constexpr std::uint64_t anyIs(std::uint64_t word, char c) {
  return anyBelow(word ^ inEachByte(c), 1);
}

// Tells whether the characters at `text` are kWordBytes literal characters of text without a line
// end or a tabulator.
bool isPlainWord(const char* text) {
  std::uint64_t word = 0;
  std::memcpy(&word, text, kWordBytes);
  return ((word & kHighBits) | anyBelow(word, ' ') | anyIs(word, '<') | anyIs(word, '&') |
          anyIs(word, ']') | anyIs(word, '\x7F')) == 0;
}

// Returns the length of the text at the start of `bytes`.
std::size_t textLength(std::string_view bytes) {
  std::size_t size = 0;
  while (bytes.size() - size >= kWordBytes && isPlainWord(bytes.data() + size)) size += kWordBytes;
  while (size < bytes.size() && is(bytes[size], kText)) ++size;
  return size;
}

// Returns the length of the name at the start of `text`; 0 when there is none.
std::size_t nameLength(std::string_view text) {
  if (text.empty() || !is(text[0], kNameStart)) return 0;
  std::size_t length = 1;
  while (length < text.size() && is(text[length], kName)) ++length;
  return length;
}

std::size_t blanksAt(std::string_view text) {
  std::size_t count = 0;
  while (count < text.size() && is(text[count], kBlank)) ++count;
  return count;
}

}  // namespace

bool XmlScanner::push(std::string_view bytes) {
  std::string joined;
  if (!carried_.empty()) {
    joined = std::move(carried_);
    carried_.clear();
    joined += bytes;
    bytes = joined;
  }
  Step step = begun_ ? Step::kDone : begin(bytes);
  while (step == Step::kDone && !bytes.empty())
    step = bytes.front() == '<' ? scanTag(bytes) : scanText(bytes);
  if (step == Step::kNeedMore) carried_ = bytes;
  if (step == Step::kLeave) rest_ = bytes;
  return step != Step::kLeave;
}

// Skips the usual byte order mark and declaration at the start of the document.
XmlScanner::Step XmlScanner::begin(std::string_view& bytes) {
  std::size_t size = 0;
  for (const std::string_view optional : {kByteOrderMark, kDeclaration}) {
    const std::string_view here = bytes.substr(size, optional.size());
    if (here.size() < optional.size() && optional.starts_with(here)) return Step::kNeedMore;
    if (here == optional) size += optional.size();
  }
  begun_ = true;
  if (bytes.substr(size, 2) == "<?") return Step::kLeave;  // a different declaration
  take(bytes, size);
  return Step::kDone;
}

void XmlScanner::tellText(std::string_view piece) {
  eventOffset_ = position_;
  inEvent_ = true;
  handler_.text(piece);
  inEvent_ = false;
}

// Scans text up to the next tag or to the end of the bytes. Only blanks are allowed outside of the
// root.
XmlScanner::Step XmlScanner::scanText(std::string_view& bytes) {
  if (std::exchange(afterReturn_, false) && bytes.front() == '\n') take(bytes, 1);
  const std::size_t size = openBegins_.empty() ? blanksAt(bytes) : textLength(bytes);
  if (size > 0) {
    if (!openBegins_.empty()) tellText(bytes.substr(0, size));
    take(bytes, size);
  }
  if (bytes.empty() || bytes.front() == '<') return Step::kDone;
  if (bytes.front() != '\r') return Step::kLeave;
  // XML has a single line end: "\r\n" and "\r" become "\n".
  tellText("\n");
  take(bytes, 1);
  afterReturn_ = true;
  return Step::kDone;
}

XmlScanner::Step XmlScanner::scanTag(std::string_view& bytes) {
  afterReturn_ = false;
  const std::size_t end = bytes.substr(0, kMaxTagBytes).find('>');
  if (end == std::string_view::npos)
    return bytes.size() < kMaxTagBytes ? Step::kNeedMore : Step::kLeave;
  const std::string_view tag = bytes.substr(0, end + 1);
  eventOffset_ = position_;
  const Step step = tag[1] == '/' ? scanEndTag(tag) : scanStartTag(tag);
  if (step == Step::kDone) take(bytes, tag.size());
  return step;
}

void XmlScanner::closeElement(std::string_view name) {
  inEvent_ = true;
  handler_.endElement(name);
  inEvent_ = false;
  openNames_.resize(openBegins_.back());
  openBegins_.pop_back();
  rootEnded_ = openBegins_.empty();
}

// Scans `tag`, which is "</name>".
XmlScanner::Step XmlScanner::scanEndTag(std::string_view tag) {
  if (openBegins_.empty()) return Step::kLeave;
  const std::string_view name = std::string_view(openNames_).substr(openBegins_.back());
  const std::string_view behind = tag.substr(2);
  if (!behind.starts_with(name) || behind.size() != name.size() + 1) return Step::kLeave;
  closeElement(behind.substr(0, name.size()));
  return Step::kDone;
}

// Scans `tag`, which is "<name>", "<name/>", or either with attributes. A '>' within a value is
// left to expat.
XmlScanner::Step XmlScanner::scanStartTag(std::string_view tag) {
  if (rootEnded_) return Step::kLeave;
  const std::size_t length = nameLength(tag.substr(1));
  if (length == 0) return Step::kLeave;
  const std::string_view name = tag.substr(1, length);
  const bool empty = tag[tag.size() - 2] == '/';
  if (!parseAttributes(tag.substr(1 + length, tag.size() - 2 - length - (empty ? 1 : 0))))
    return Step::kLeave;
  inEvent_ = true;
  if (depth() == maxDepth_)
    throw XmlError("elements are nested deeper than " + std::to_string(maxDepth_) + " levels",
                   eventOffset_);
  openBegins_.push_back(openNames_.size());
  openNames_ += name;
  handler_.startElement(name, attributes_.data());
  inEvent_ = false;
  if (empty) closeElement(name);
  return Step::kDone;
}

// Parses `text`, the part of a tag after the element's name. Returns false when it is left to
// expat.
bool XmlScanner::parseAttributes(std::string_view text) {
  attributeText_.clear();
  attributeBegins_.clear();
  for (;;) {
    const std::size_t blanks = blanksAt(text);
    text.remove_prefix(blanks);
    if (text.empty()) break;
    const std::size_t length = nameLength(text);
    const std::string_view name = text.substr(0, length);
    if (blanks == 0 || length == 0 || text.size() < length + 2 || text[length] != '=') return false;
    const char quote = text[length + 1];
    if (quote != '"' && quote != '\'') return false;
    text.remove_prefix(length + 2);
    const std::size_t end = text.find(quote);
    if (end == std::string_view::npos) return false;
    const std::string_view value = text.substr(0, end);
    if (!std::all_of(value.begin(), value.end(), [](char c) { return is(c, kValue); }))
      return false;
    for (std::size_t i = 0; i < attributeBegins_.size(); i += 2)
      if (attributeText_.c_str() + attributeBegins_[i] == name)
        return false;  // the attribute appears twice
    for (const std::string_view part : {name, value}) {
      attributeBegins_.push_back(attributeText_.size());
      attributeText_.append(part).push_back('\0');
    }
    text.remove_prefix(end + 1);
  }
  attributes_.clear();
  for (const std::size_t begin : attributeBegins_)
    attributes_.push_back(attributeText_.data() + begin);
  attributes_.push_back(nullptr);
  return true;
}

std::string XmlScanner::prefix() const {
  if (rootEnded_) return "<r/>";
  // A declaration is only allowed at the very beginning; a blank tells expat that the document
  // has begun.
  if (openBegins_.empty() && position_ > 0) return " ";
  std::string tags;
  for (std::size_t i = 0; i < openBegins_.size(); ++i) {
    const std::size_t end = i + 1 < openBegins_.size() ? openBegins_[i + 1] : openNames_.size();
    tags += "<" + openNames_.substr(openBegins_[i], end - openBegins_[i]) + ">";
  }
  return tags;
}

}  // namespace palpate
