// Text that must be UTF-8, such as that of a JSON file.
#pragma once

#include <string>
#include <string_view>

namespace palpate {

// Returns whether all of `text` is UTF-8 (Unicode 15, table 3-7).
bool isUtf8(std::string_view text);

// The characters of a text; what is not UTF-8 becomes U+FFFD.
std::u32string codePointsOf(std::string_view text);

}  // namespace palpate
