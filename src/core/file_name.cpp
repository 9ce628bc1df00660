#include "palpate/core/file_name.h"

#include <cstddef>

namespace palpate {
namespace {

bool isDigit(char letter) { return letter >= '0' && letter <= '9'; }

// Removes the number at the start of `text` and returns it without leading zeros.
std::string_view takeNumber(std::string_view& text) {
  std::size_t zeros = 0;
  while (zeros < text.size() && text[zeros] == '0') ++zeros;
  std::size_t end = zeros;
  while (end < text.size() && isDigit(text[end])) ++end;
  const std::string_view number = text.substr(zeros, end - zeros);
  text.remove_prefix(end);
  return number;
}

}  // namespace

std::strong_ordering naturalOrder(std::string_view left, std::string_view right) noexcept {
  std::string_view a = left;
  std::string_view b = right;
  while (!a.empty() && !b.empty()) {
    if (isDigit(a.front()) && isDigit(b.front())) {
      const std::string_view x = takeNumber(a);
      const std::string_view y = takeNumber(b);
      if (x.size() != y.size()) return x.size() <=> y.size();
      if (const auto order = x.compare(y); order != 0) return order <=> 0;
      continue;
    }
    if (a.front() != b.front())
      return static_cast<unsigned char>(a.front()) <=> static_cast<unsigned char>(b.front());
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.size() != b.size()) return a.size() <=> b.size();
  return left.compare(right) <=> 0;
}

}  // namespace palpate
