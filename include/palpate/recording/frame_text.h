// The run-length code of a frame in a .dsa recording (docs/notes/dsa_format.md): tokens of 8
// hexadecimal digits, each the bits of a big-endian IEEE 754 binary32. A negative value -n is a run
// of n zeros, any other value (-0.0 too) is one value. White space has no meaning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace palpate {

// Decodes text that comes in pieces of any size, without collecting it.
class FrameTextDecoder {
 public:
  // Starts a frame of values.size() values; `values` must live until finish() and is zeroed.
  void begin(std::span<float> values);
  // Throws Error: no hexadecimal digit, not a number, a run or value that doesn't fit.
  void add(std::string_view piece);
  // Throws Error when the text ended within a token or before the last value.
  void finish();

  std::size_t numTokens() const noexcept { return numTokens_; }  // of this frame so far

 private:
  void addToken(std::uint32_t bits);

  std::span<float> values_;
  std::size_t numValues_ = 0;  // decoded so far
  std::size_t numTokens_ = 0;
  std::uint32_t bits_ = 0;  // of the token that is not complete yet
  int numDigits_ = 0;
};

// Appends the tokens of a frame with the longest possible runs, `tokensPerLine` on a line, each
// line as `lineStart` + tokens + `lineEnd`. Values must be finite and not negative (-0.0 is 0):
// else throws std::invalid_argument naming the position.
void appendFrameText(std::span<const float> values,
                     std::size_t tokensPerLine,
                     std::string_view lineStart,
                     std::string_view lineEnd,
                     std::string& out);

}  // namespace palpate
