#include "palpate/recording/frame_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/model/tactile_frame.h"

namespace palpate {
namespace {

constexpr float kLargestValue = 1e9F;  // far beyond counts and whatever a filter makes of them
constexpr int kDigitsPerToken = 8;
constexpr std::uint8_t kBlank = 0x40;
constexpr std::uint8_t kInvalid = 0x80;

// What each character means: a digit's value 0..15, white space, or neither.
constexpr std::array<std::uint8_t, 256> makeMeanings() {
  std::array<std::uint8_t, 256> meanings{};
  for (auto& meaning : meanings) meaning = kInvalid;
  for (const unsigned char c : {' ', '\t', '\r', '\n'}) meanings[c] = kBlank;
  for (std::uint8_t i = 0; i < 10; ++i) meanings['0' + i] = i;
  for (std::uint8_t i = 0; i < 6; ++i) {
    meanings['A' + i] = static_cast<std::uint8_t>(10 + i);
    meanings['a' + i] = static_cast<std::uint8_t>(10 + i);
  }
  return meanings;
}
constexpr std::array<std::uint8_t, 256> kMeanings = makeMeanings();

std::uint8_t meaningOf(char c) { return kMeanings[static_cast<unsigned char>(c)]; }

std::string soFar(std::size_t done, std::size_t all) {
  return "(" + std::to_string(done) + " of " + std::to_string(all) + " values so far)";
}

std::string shown(char c) {
  if (c > ' ' && c < '\x7f') return "'" + std::string(1, c) + "'";
  return "character code " + std::to_string(static_cast<unsigned char>(c));
}

}  // namespace

void FrameTextDecoder::begin(std::span<float> values) {
  values_ = values;
  std::fill(values_.begin(), values_.end(), 0.0F);
  numValues_ = 0;
  numTokens_ = 0;
  bits_ = 0;
  numDigits_ = 0;
}

void FrameTextDecoder::add(std::string_view piece) {
  const char* at = piece.data();
  const char* const end = at + piece.size();
  while (at != end) {
    if (numDigits_ == 0 && meaningOf(*at) == kBlank) {  // indentation
      ++at;
      continue;
    }
    // Whole tokens, the usual case: eight digits at once.
    while (numDigits_ == 0 && end - at >= kDigitsPerToken) {
      std::uint32_t bits = 0;
      std::uint8_t seen = 0;
      for (int i = 0; i < kDigitsPerToken; ++i) {
        const std::uint8_t meaning = meaningOf(at[i]);
        seen |= meaning;
        bits = bits << 4 | (meaning & 0x0Fu);
      }
      if ((seen & (kBlank | kInvalid)) != 0) break;
      at += kDigitsPerToken;
      addToken(bits);
    }
    if (at == end) break;
    const std::uint8_t meaning = meaningOf(*at);
    if (meaning == kInvalid)
      throw Error("frame_data holds " + shown(*at) + ", which isn't a hexadecimal digit " +
                  soFar(numValues_, values_.size()));
    if (meaning != kBlank) {
      bits_ = bits_ << 4 | meaning;
      if (++numDigits_ == kDigitsPerToken) {
        numDigits_ = 0;
        addToken(bits_);
      }
    }
    ++at;
  }
}

void FrameTextDecoder::addToken(std::uint32_t bits) {
  ++numTokens_;
  const float value = std::bit_cast<float>(bits);
  if (!std::isfinite(value))
    throw Error("a value is not a number " + soFar(numValues_, values_.size()));
  if (value >= 0.0F) {  // also -0.0, which is no run
    if (value > kLargestValue)
      throw Error("a value of " + numberText(value) + " is invalid " +
                  soFar(numValues_, values_.size()));
    if (numValues_ == values_.size())
      throw Error("more than " + std::to_string(values_.size()) + " values");
    values_[numValues_++] = value == 0.0F ? 0.0F : value;
    return;
  }
  const float run = -value;
  if (run < 1.0F || run != std::floor(run))
    throw Error("a run of " + numberText(run) + " zeros is not a whole number " +
                soFar(numValues_, values_.size()));
  const std::size_t room = values_.size() - numValues_;
  if (static_cast<double>(run) > static_cast<double>(room))
    throw Error("a run of " + fixedText(static_cast<double>(run), 0) + " zeros does not fit " +
                soFar(numValues_, values_.size()));
  numValues_ += static_cast<std::size_t>(run);  // the values are zero already
}

void FrameTextDecoder::finish() {
  if (numDigits_ != 0)
    throw Error("frame_data ends within a token: " + std::to_string(numDigits_) +
                " of 8 hexadecimal digits " + soFar(numValues_, values_.size()));
  if (numValues_ != values_.size())
    throw Error("only " + std::to_string(numValues_) + " of " + std::to_string(values_.size()) +
                " values");
}

void appendFrameText(std::span<const float> values,
                     std::size_t tokensPerLine,
                     std::string_view lineStart,
                     std::string_view lineEnd,
                     std::string& out) {
  std::size_t numTokens = 0;
  const auto addToken = [&](float value) {
    if (numTokens % tokensPerLine == 0) out += lineStart;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    appendHexDigits(out, bits, kDigitsPerToken);
    if (++numTokens % tokensPerLine == 0) out += lineEnd;
  };
  std::size_t zeros = 0;
  const auto endRun = [&] {
    if (zeros > 0) addToken(-static_cast<float>(zeros));
    zeros = 0;
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0.0F) {
      ++zeros;
      continue;
    }
    if (!isTouched(values[i]) || !std::isfinite(values[i]))
      throw std::invalid_argument("appendFrameText: value " + std::to_string(i) + " is " +
                                  numberText(values[i]));
    endRun();
    addToken(values[i]);
  }
  endRun();
  if (numTokens % tokensPerLine != 0) out += lineEnd;
}

}  // namespace palpate
