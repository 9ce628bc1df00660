#include "palpate/core/utf8.h"

namespace palpate {

std::u32string codePointsOf(std::string_view text) {
  constexpr char32_t kReplacement = 0xFFFD;
  std::u32string codes;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = first < 0x80                    ? 0
                     : first >= 0xC2 && first < 0xE0 ? 1
                     : first >= 0xE0 && first < 0xF0 ? 2
                     : first >= 0xF0 && first < 0xF5 ? 3
                                                     : -1;
    if (more < 0) {
      codes += kReplacement;
      continue;
    }
    char32_t code = more == 0 ? first : first & (0x3Fu >> more);
    int found = 0;
    while (found < more && i < text.size() &&
           (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80) {
      code = code << 6 | (static_cast<unsigned char>(text[i++]) & 0x3Fu);
      ++found;
    }
    const bool overlong = (more == 2 && code < 0x800) || (more == 3 && code < 0x10000);
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    const bool readable = found == more && !overlong && !surrogate && code <= 0x10FFFF;
    codes += readable ? code : kReplacement;
  }
  return codes;
}

}  // namespace palpate
