#include "palpate/core/escaped_line.h"

#include <array>
#include <cstdint>
#include <cstdio>

#include "palpate/core/utf8.h"

namespace palpate {
namespace {

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  // 0 when not UTF-8
};

// Returns the character at the start of a text, which must not be empty (Unicode 15, table 3-7).
Character firstCharacter(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!isContinuation(text[i])) return {};
    code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3F);
  }
  constexpr std::array<std::uint32_t, 5> kMinimum{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kMinimum[bytes] || code > 0x10FFFF || surrogate) return {};
  return {code, bytes};
}

// Returns whether a character is a control, a line or paragraph separator, or changes the direction
// of writing.
bool bendsTheLine(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code <= 0x9F) || code == 0x061C || code == 0x200E ||
         code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
}

std::string escaped(std::uint32_t code) {
  switch (code) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      break;
  }
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), code < 0x80 ? "\\x%02X" : "\\u{%04X}", code);
  return text.data();
}

}  // namespace

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const Character character = firstCharacter(text);
    if (character.bytes == 0) return false;
    text.remove_prefix(character.bytes);
  }
  return true;
}

std::string escapedLine(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const Character character = firstCharacter(text);
    if (character.bytes == 0) {
      std::array<char, 8> byte{};
      std::snprintf(byte.data(), byte.size(), "\\x%02X", static_cast<unsigned char>(text[0]));
      line += byte.data();
      text.remove_prefix(1);
      continue;
    }
    if (bendsTheLine(character.code))
      line += escaped(character.code);
    else
      line += text.substr(0, character.bytes);
    text.remove_prefix(character.bytes);
  }
  return line;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kShownBytes = 100;
  const std::string line = escapedLine(beginningOf(text, kShownBytes));
  const std::string_view shown = beginningOf(line, kShownBytes);
  const bool whole = text.size() <= kShownBytes && line.size() <= kShownBytes;
  return std::string(shown) + (whole ? "" : "..");
}

std::string_view beginningOf(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && isContinuation(text[most])) --most;
  return text.substr(0, most);
}

}  // namespace palpate
