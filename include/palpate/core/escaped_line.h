// Escapes text of unknown origin (file contents, names) for one line of a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace palpate {

// `text` without anything that could break or bend the line: control characters (line ends,
// escapes, C1, those that turn the direction of writing) become \n, \t, \xNN or \u{NNNN}; bytes
// that are no UTF-8 become \xNN.
std::string escapedLine(std::string_view text);

// The first `most` bytes of `text`, fewer where that would cut a UTF-8 character in two.
std::string_view beginningOf(std::string_view text, std::size_t most);

}  // namespace palpate
