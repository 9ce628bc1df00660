// Order of names as people count: "run_2" before "run_10".
#pragma once

#include <compare>
#include <string_view>

namespace palpate {

// Byte by byte, but digits in a row count as one number, of any length; leading zeros matter only
// where nothing else differs. Case counts: give small letters.
std::strong_ordering naturalOrder(std::string_view left, std::string_view right) noexcept;

}  // namespace palpate
