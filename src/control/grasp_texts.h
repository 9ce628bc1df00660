// Texts of a grasp that more than one part of its state machine uses. Those that read its state are
// its members (grasp_texts.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace palpate {

inline constexpr std::string_view kStopsAreSent = ": stops are sent until one is answered";
inline constexpr std::string_view kNotEased = ": the hand holds, perhaps above its limit";
inline constexpr std::string_view kUnwatched = "the hand holds, without slip detection";

std::string millisecondsText(std::int64_t us);
// "no tactile frames for 130 ms".
std::string silenceText(std::int64_t silenceUs);

}  // namespace palpate
