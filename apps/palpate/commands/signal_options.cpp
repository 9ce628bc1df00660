#include "commands/signal_options.h"

#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/signals/signal_name.h"

#include "commands/command_line.h"

namespace palpate::commands {
namespace {

constexpr std::size_t kMaxNamed = 8;  // taxels in one line

std::string placeText(std::size_t matrix, std::int64_t x, std::int64_t y) {
  return "matrix " + std::to_string(matrix) + ", x " + std::to_string(x) + ", y " +
         std::to_string(y);
}

// Describes the taxels that exist: all by name when they are few, else the columns of that row.
std::string whatExists(const MatrixLayout& matrix, std::int64_t y) {
  if (matrix.numEnabled() == 0) return "no taxel of this matrix is scanned";
  std::string text;
  if (matrix.numEnabled() <= kMaxNamed) {
    for (int row = 0; row < matrix.rows; ++row)
      for (int x = 0; x < matrix.columns; ++x)
        if (matrix.enabled(row, x))
          text +=
              (text.empty() ? "" : "; ") + ("x " + std::to_string(x)) + " y " + std::to_string(row);
    return "there are " + text;
  }
  if (y >= matrix.rows)
    return "x is 0.." + std::to_string(matrix.columns - 1) + ", y 0.." +
           std::to_string(matrix.rows - 1);
  for (int x = 0; x < matrix.columns; ++x)
    if (matrix.enabled(static_cast<int>(y), x))
      text += (text.empty() ? "" : ", ") + std::to_string(x);
  return text.empty() ? "row " + std::to_string(y) + " has none"
                      : "row " + std::to_string(y) + " has x " + text;
}

// Whether the text can only be meant as the name of a signal: it has no operator of a formula.
bool looksLikeName(const std::string& text) {
  return text.find_first_of("+-*/^()<>=?&|!. ") == std::string::npos;
}

}  // namespace

SeriesChoice taxelOf(const SensorLayout& layout,
                     std::size_t m,
                     std::int64_t x,
                     std::int64_t y,
                     const std::string& file) {
  const MatrixLayout& matrix = layout.matrix(m);
  const bool inside = x < matrix.columns && y < matrix.rows;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  if (!inside || !matrix.enabled(row, column)) {
    const bool masked = inside && matrix.exists(row, column);
    throw Error(file + ": " + placeText(m, x, y) +
                (masked ? ": this taxel is masked, it was not scanned; " : ": no such taxel; ") +
                whatExists(matrix, y));
  }
  SeriesChoice choice{.kind = SeriesChoice::Kind::kTaxels, .taxels = TaxelSelection(layout)};
  choice.taxels.toggle(m, row, column);
  return choice;
}

TypedSignal typedSignal(const std::string& text,
                        const Profile& profile,
                        const std::string& file,
                        const std::string& option) {
  const SensorLayout& layout = profile.layout();
  if (const auto choice = signalNamed(text, profile);
      choice && choice->kind == SeriesChoice::Kind::kColumn)
    return {.choice = choice};
  const auto name = parseSignalName(text);
  if (!name) {
    const std::string refusal =
        option + ": \"" + text + "\" is not a signal: signals are " + kSignalNames;
    if (looksLikeName(text)) throw UsageError(refusal);
    try {
      return {.formula = Formula(text)};
    } catch (const std::invalid_argument& error) {
      throw UsageError(refusal + "; as a formula: " + error.what());
    }
  }
  if (name->kind == SeriesChoice::Kind::kMatrix || name->kind == SeriesChoice::Kind::kTaxels)
    requireMatrix(file, layout, name->index);
  if (name->kind == SeriesChoice::Kind::kTaxels)
    return {.choice =
                taxelOf(layout, static_cast<std::size_t>(*name->index), name->x, name->y, file)};
  return {.choice = signalNamed(text, layout)};
}

std::vector<std::string> namesOf(const TypedSignal& signal, const SensorLayout& layout) {
  if (signal.formula) return signal.formula->names();
  return {nameOf(*signal.choice, layout)};
}

Series typedSeries(const Profile& profile,
                   const TypedSignal& signal,
                   double fromS,
                   double toS,
                   const std::string& file,
                   const Progress& progress) {
  try {
    if (signal.formula) return formulaSeries(profile, *signal.formula, fromS, toS, progress);
  } catch (const std::invalid_argument& error) {
    throw Error(file + ": " + error.what());
  }
  if (!hasSeries(profile, *signal.choice)) {
    const std::string why = whyMissing(profile, *signal.choice);
    throw Error(file + ": has no " + nameOf(*signal.choice, profile.layout()) +
                (why.empty() ? "" : ": " + why));
  }
  return readSeries(profile, *signal.choice, fromS, toS, progress);
}

}  // namespace palpate::commands
