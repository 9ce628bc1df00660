// Orders names with numbers by the value of the numbers: "run_2" before "run_10". Lists of ports
// and recordings use it.
#pragma once

#include <compare>
#include <string_view>

namespace palpate {

// Compares byte by byte, but consecutive digits as one number of any length. Leading zeros matter
// only when everything else is equal. The comparison is case-sensitive; pass lower-case names to
// ignore case.
std::strong_ordering naturalOrder(std::string_view left, std::string_view right) noexcept;

}  // namespace palpate
