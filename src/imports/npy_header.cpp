#include "imports/npy_header.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "palpate/core/byte_order.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";

// A cursor over the literal.
class Literal {
 public:
  explicit Literal(std::string_view text) : text_(text) {}

  bool take(char letter) {
    skipBlanks();
    if (at_ >= text_.size() || text_[at_] != letter) return false;
    ++at_;
    return true;
  }
  void require(char letter) {
    if (!take(letter)) fail(std::string("'") + letter + "' is missing");
  }
  std::string_view quoted() {
    skipBlanks();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '\'' && quote != '"') fail("a text is missing");
    const auto end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) fail("a text has no end");
    const std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return inside;
  }
  std::string_view word() {
    skipBlanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0)) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  // Skips a list with its nested lists, tuples and texts.
  void skipList() {
    std::size_t depth = 0;
    do {
      skipBlanks();
      if (at_ >= text_.size()) fail("a list has no end");
      const char letter = text_[at_];
      if (letter == '\'' || letter == '"') {
        quoted();
        continue;
      }
      depth += letter == '[' || letter == '(' ? 1 : 0;
      depth -= letter == ']' || letter == ')' ? 1 : 0;
      ++at_;
    } while (depth > 0);
  }
  bool peek(char letter) {
    skipBlanks();
    return at_ < text_.size() && text_[at_] == letter;
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw Error("the header of the array can't be read: " + why + " at character " +
                std::to_string(at_ + 1));
  }

 private:
  void skipBlanks() {
    while (at_ < text_.size() && std::strchr(" \t\r\n", text_[at_]) && text_[at_] != '\0') ++at_;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

std::vector<std::uint64_t> readShape(Literal& in) {
  constexpr std::size_t kMaxDimensions = 32;
  std::vector<std::uint64_t> shape;
  in.require('(');
  while (!in.take(')')) {
    std::string_view digits = in.word();
    if (digits.ends_with('L')) digits.remove_suffix(1);  // written by Python 2
    const auto size = parseInteger(digits);
    if (!size || *size < 0) in.fail("the shape holds " + inQuotes(digits));
    shape.push_back(static_cast<std::uint64_t>(*size));
    if (shape.size() > kMaxDimensions) in.fail("the shape has too many dimensions");
    if (!in.take(',') && !in.peek(')')) in.fail("the shape has no end");
  }
  return shape;
}

// Reads "<f4", "|u1", "<M8[us]".
void readType(std::string_view type, NpyHeader& header) {
  constexpr std::array<std::pair<char, NumberKind>, 5> kKinds = {{{'b', NumberKind::kBool},
                                                                  {'i', NumberKind::kSigned},
                                                                  {'u', NumberKind::kUnsigned},
                                                                  {'f', NumberKind::kFloat},
                                                                  {'M', NumberKind::kDate}}};
  header.type = std::string(type);
  if (type.size() < 3) return;
  const auto kind = std::find_if(
      kKinds.begin(), kKinds.end(), [&](const auto& each) { return each.first == type[1]; });
  const auto bracket = type.find('[');
  const auto bytes =
      parseInteger(type.substr(2, bracket == std::string_view::npos ? bracket : bracket - 2));
  if (kind == kKinds.end() || !bytes) return;
  const NumberKind found = kind->second;
  const bool isSize = *bytes == 1 || *bytes == 2 || *bytes == 4 || *bytes == 8;
  const bool fits = found == NumberKind::kBool    ? *bytes == 1
                    : found == NumberKind::kFloat ? isSize && *bytes > 1
                    : found == NumberKind::kDate  ? *bytes == 8
                                                  : isSize;
  if (!fits) return;
  if (found == NumberKind::kDate) {
    constexpr std::array<std::pair<std::string_view, std::int64_t>, 7> kUnits = {
        {{"[ns]", 1},
         {"[us]", 1000},
         {"[ms]", 1'000'000},
         {"[s]", 1'000'000'000},
         {"[m]", 60'000'000'000},
         {"[h]", 3'600'000'000'000},
         {"[D]", 86'400'000'000'000}}};
    for (const auto& [name, ns] : kUnits)
      if (bracket != std::string_view::npos && type.substr(bracket) == name) header.dateUnitNs = ns;
    if (header.dateUnitNs == 0) return;
  }
  header.kind = found;
  header.itemBytes = static_cast<std::size_t>(*bytes);
  header.bigEndian = type[0] == '>';
}

}  // namespace

std::optional<std::uint64_t> NpyHeader::numBytes() const noexcept {
  std::uint64_t bytes = itemBytes;
  for (const std::uint64_t size : shape)
    if (__builtin_mul_overflow(bytes, size, &bytes)) return std::nullopt;
  return bytes;
}

std::string NpyHeader::typeName() const {
  const std::string bits = std::to_string(8 * itemBytes);
  switch (kind) {
    case NumberKind::kBool:
      return "bool";
    case NumberKind::kSigned:
      return "int" + bits;
    case NumberKind::kUnsigned:
      return "uint" + bits;
    case NumberKind::kFloat:
      return "float" + bits;
    case NumberKind::kDate:
      return "date";
    case NumberKind::kOther:
      break;
  }
  if (type.empty()) return "structure";
  switch (type.size() > 1 ? type[1] : '\0') {
    case 'U':
    case 'S':
      return "text";
    case 'O':
      return "Python objects";
    case 'c':
      return "complex";
    default:
      return type;
  }
}

std::optional<std::size_t> npyHeaderBytes(std::span<const std::byte> bytes) {
  if (bytes.size() < 10 || std::memcmp(bytes.data(), kNpyMagic.data(), kNpyMagic.size()) != 0)
    return std::nullopt;
  const auto version = std::to_integer<unsigned>(bytes[6]);
  if (version == 1) return 10 + static_cast<std::size_t>(littleEndian(bytes.subspan(8, 2)));
  if (version > 3 || version == 0 || bytes.size() < 12) return std::nullopt;
  return 12 + static_cast<std::size_t>(littleEndian(bytes.subspan(8, 4)));
}

NpyHeader parseNpyHeader(std::span<const std::byte> bytes) {
  const auto total = npyHeaderBytes(bytes);
  if (!total) throw Error("is not a .npy array of version 1 to 3");
  if (*total > kMaxNpyHeaderBytes)
    throw Error("the header of the array declares " + std::to_string(*total) + " bytes: too many");
  if (*total > bytes.size()) throw Error("the header of the array is cut off");
  const std::size_t before = std::to_integer<unsigned>(bytes[6]) == 1 ? 10 : 12;
  NpyHeader header;
  header.dataOffset = *total;
  Literal in({reinterpret_cast<const char*>(bytes.data()) + before, *total - before});
  in.require('{');
  bool hasType = false;
  bool hasOrder = false;
  bool hasShape = false;
  while (!in.take('}')) {
    const std::string key(in.quoted());
    in.require(':');
    if (key == "descr") {
      hasType = true;
      if (in.peek('['))
        in.skipList();  // a structure
      else
        readType(in.quoted(), header);
    } else if (key == "fortran_order") {
      const std::string_view word = in.word();
      if (word != "True" && word != "False") in.fail("fortran_order is " + inQuotes(word));
      header.fortranOrder = word == "True";
      hasOrder = true;
    } else if (key == "shape") {
      header.shape = readShape(in);
      hasShape = true;
    } else {
      in.fail("the key " + inQuotes(key) + " is unknown");
    }
    if (!in.take(',') && !in.peek('}')) in.fail("a comma is missing");
  }
  if (!hasType || !hasOrder || !hasShape) in.fail("descr, fortran_order or shape is missing");
  return header;
}

}  // namespace palpate
