#include "palpate/model/series.h"

#include <algorithm>
#include <stdexcept>

namespace palpate {
namespace {

bool isLetter(char c) { return c >= 'a' && c <= 'z'; }
bool isPart(char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; }
bool isPrintable(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
}

}  // namespace

void validate(const SeriesDescription& series) {
  const auto require = [&](bool holds, const std::string& rule) {
    if (!holds) throw std::invalid_argument("series " + series.name + ": " + rule);
  };
  require(!series.name.empty() && series.name.size() <= kMaxSeriesName &&
              isLetter(series.name.front()) &&
              std::all_of(series.name.begin(), series.name.end(), isPart),
          "a name is a small letter, then small letters, digits or _, " +
              std::to_string(kMaxSeriesName) + " characters at most");
  require(!series.columns.empty() && series.columns.size() <= kMaxColumns,
          "1 to " + std::to_string(kMaxColumns) + " columns");
  for (std::size_t i = 0; i < series.columns.size(); ++i) {
    const Column& column = series.columns[i];
    require(!column.name.empty() && isPrintable(column.name) && isPrintable(column.unit),
            "column " + std::to_string(i + 1) + " has no name that can be printed");
    require(std::none_of(series.columns.begin(),
                         series.columns.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const Column& other) { return other.name == column.name; }),
            "two columns have the name " + column.name);
  }
}

std::string seriesName(std::string_view text) {
  std::string name;
  for (char c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (isPart(c) && (isLetter(c) || !name.empty()))
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  name.resize(std::min(name.size(), kMaxSeriesName));
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "series" : name;
}

}  // namespace palpate
