#include "palpate/signals/signal_name.h"

#include <cctype>

#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::string_view kHand = "hand";
using SignalNameKind = SeriesChoice::Kind;

std::optional<std::int64_t> countIn(std::string_view text) {
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) == 0)
    return std::nullopt;
  const auto number = parseInteger(text);
  return number && *number >= 0 ? number : std::nullopt;
}

std::optional<std::int64_t> countBehind(std::string_view text, std::string_view word) {
  if (!text.starts_with(word)) return std::nullopt;
  return countIn(text.substr(word.size()));
}

// The matrix of `place`, which is a number or "hand", and the signal or taxel of `rest`.
std::optional<SignalName> signalAt(bool hand,
                                   std::optional<std::int64_t> matrix,
                                   std::string_view rest,
                                   std::string_view betweenXAndY,
                                   std::string_view beforeX) {
  if (!hand && !matrix) return std::nullopt;
  SignalName name{.index = matrix};
  if (const auto signal = signalKindNamed(rest)) {
    if (hand && isComponent(*signal)) return std::nullopt;
    name.signal = *signal;
    return name;
  }
  const auto second = rest.find(betweenXAndY);
  if (hand || second == std::string_view::npos) return std::nullopt;
  const auto x = countBehind(rest.substr(0, second), beforeX);
  const auto y = countIn(rest.substr(second + betweenXAndY.size()));
  if (!x || !y) return std::nullopt;
  name.kind = SignalNameKind::kTaxels;
  name.x = *x;
  name.y = *y;
  return name;
}

// "wrist_fz"
std::string columnName(const std::string& series, const std::string& column) {
  std::string name = series + "_";
  for (const char letter : column) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (plain || name.back() != '_') name += plain ? letter : '_';
  }
  return name;
}

bool partOfName(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

}  // namespace

std::optional<SignalName> parseSignalName(std::string_view text) {
  if (const auto axis = countBehind(text, "angle"))
    return SignalName{.kind = SignalNameKind::kAngle, .index = axis};
  if (const auto sensor = countBehind(text, "temperature"))
    return SignalName{.kind = SignalNameKind::kTemperature, .index = sensor};
  if (const auto colon = text.find(':'); colon != std::string_view::npos) {
    const std::string_view place = text.substr(0, colon);
    return signalAt(place == kHand, countIn(place), text.substr(colon + 1), ":", "");
  }
  const auto underline = text.find('_');
  if (underline == std::string_view::npos) return std::nullopt;
  const std::string_view place = text.substr(0, underline);
  return signalAt(place == kHand, countBehind(place, "m"), text.substr(underline + 1), "_y", "x");
}

std::optional<SeriesChoice> signalNamed(std::string_view name, const SensorLayout& layout) {
  const auto parsed = parseSignalName(name);
  if (!parsed) return std::nullopt;
  const auto numMatrices = static_cast<std::int64_t>(layout.numMatrices());
  const auto index = static_cast<std::size_t>(parsed->index.value_or(numMatrices));
  SeriesChoice choice{.kind = parsed->kind, .index = index, .signal = parsed->signal};
  if (parsed->kind == SignalNameKind::kAngle || parsed->kind == SignalNameKind::kTemperature)
    return choice;
  if (parsed->index && *parsed->index >= numMatrices) return std::nullopt;
  if (parsed->kind == SignalNameKind::kMatrix) return choice;
  const MatrixLayout& matrix = layout.matrix(index);
  if (parsed->x >= matrix.columns || parsed->y >= matrix.rows) return std::nullopt;
  const int row = static_cast<int>(parsed->y), column = static_cast<int>(parsed->x);
  if (!matrix.enabled(row, column)) return std::nullopt;
  choice = {.kind = SignalNameKind::kTaxels, .taxels = TaxelSelection(layout)};
  choice.taxels.toggle(index, row, column);
  return choice;
}

std::optional<SeriesChoice> signalNamed(std::string_view name, const Profile& profile) {
  if (auto ofHand = signalNamed(name, profile.layout());
      ofHand && (!isComponent(ofHand->signal) || profile.givesReadings()))
    return ofHand;
  for (std::size_t s = kHandSeries; s < profile.series().size(); ++s) {
    const SeriesDescription& series = profile.series()[s];
    if (!name.starts_with(series.name)) continue;
    for (const Column& column : series.columns)
      if (columnName(series.name, column.name) == name)
        return SeriesChoice{
            .kind = SignalNameKind::kColumn, .series = series.name, .column = column.name};
  }
  return std::nullopt;
}

std::string nameOf(const SeriesChoice& choice, const SensorLayout& layout) {
  const std::string number = std::to_string(choice.index);
  switch (choice.kind) {
    case SignalNameKind::kAngle:
      return "angle" + number;
    case SignalNameKind::kTemperature:
      return "temperature" + number;
    case SignalNameKind::kColumn:
      return columnName(choice.series, choice.column);
    case SignalNameKind::kMatrix:
      return (choice.index == layout.numMatrices() ? std::string(kHand) : "m" + number) + "_" +
             std::string(signalName(choice.signal));
    case SignalNameKind::kTaxels:
      break;
    default:
      return {};
  }
  if (choice.taxels.count() != 1 || !TaxelSelection(layout).sameSensor(choice.taxels)) return {};
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    for (int y = 0; y < matrix.rows; ++y)
      for (int x = 0; x < matrix.columns; ++x)
        if (choice.taxels.contains(m, y, x))
          return "m" + std::to_string(m) + "_x" + std::to_string(x) + "_y" + std::to_string(y);
  }
  return {};
}

std::string withSignalNames(const std::string& formula) {
  std::string written;
  for (std::size_t i = 0; i < formula.size();) {
    if (!partOfName(formula[i])) {
      written += formula[i++];
      continue;
    }
    std::size_t end = i;
    while (end < formula.size() && partOfName(formula[end])) ++end;
    const std::string word = formula.substr(i, end - i);
    const bool place = word == kHand || countIn(word).has_value();
    std::size_t after = end;
    if (place && end < formula.size() && formula[end] == ':')
      for (after = end + 1; after < formula.size() && partOfName(formula[after]);) ++after;
    const std::string signal = after > end ? formula.substr(end + 1, after - end - 1) : "";
    if (signalKindNamed(signal)) {
      written += (word == kHand ? word : "m" + word) + "_" + signal;
      i = after;
    } else {
      written += word;
      i = end;
    }
  }
  return written;
}

}  // namespace palpate
