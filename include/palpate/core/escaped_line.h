// Prepares text of unknown origin (file contents, names) for one line of a terminal: escapes,
// cuts and trims it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace palpate {

// Returns `text` without characters that could break the line or change its direction: control
// characters (line ends, escapes, C1, bidirectional controls) become \n, \t, \xNN or \u{NNNN};
// bytes that are not UTF-8 become \xNN.
std::string escapedLine(std::string_view text);

// Returns the first `most` bytes of `text`, or fewer so that no UTF-8 character is cut in two.
std::string_view beginningOf(std::string_view text, std::size_t most);

// Text of unknown origin (a name, a key, a formula) as messages repeat it: escaped, and where it
// has more than 100 bytes its beginning and "..".
std::string shortened(std::string_view text);

// The same in quotes.
inline std::string inQuotes(std::string_view text) { return "\"" + shortened(text) + "\""; }

// Removes the blanks around a text.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t") {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace palpate
