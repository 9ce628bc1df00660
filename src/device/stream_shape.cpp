#include "palpate/device/stream_shape.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::size_t kLongestDescribedText = 200;

std::string describedText(const Json& object, const char* key) {
  if (!object.contains(key)) return {};
  return std::string(beginningOf(object.at(key).asString(), kLongestDescribedText));
}

bool equalsInAnyCase(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a,
      b,
      {},
      [](unsigned char c) { return std::tolower(c); },
      [](unsigned char c) { return std::tolower(c); });
}

// Whether `word` is `name`, which may have blanks where the word has '_' or '-'.
bool isSameWord(std::string_view word, std::string_view name) {
  return std::ranges::equal(word, name, [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b) || (b == ' ' && (a == '_' || a == '-'));
  });
}

std::string sizeText(std::int64_t rows, std::int64_t columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

std::string mismatchOf(const Json& matrices, const SensorLayout& layout) {
  if (!matrices.isArray()) throw Error("matrices is not a list");
  if (matrices.size() != layout.numMatrices())
    return "the sender has " + std::to_string(matrices.size()) + " matrices, the chosen hand " +
           std::to_string(layout.numMatrices());
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    const std::int64_t rows = matrices.at(m).at("rows").asInteger();
    const std::int64_t columns = matrices.at(m).at("columns").asInteger();
    if (rows != matrix.rows || columns != matrix.columns)
      return "matrix " + std::to_string(m) + " of the sender has " + sizeText(rows, columns) +
             " places, that of the chosen hand " + sizeText(matrix.rows, matrix.columns);
    const std::int64_t components = matrices.at(m).contains("components")
                                        ? matrices.at(m).at("components").asInteger()
                                        : matrix.touch.components;
    if (components != matrix.touch.components)
      return "matrix " + std::to_string(m) + " of the sender has " + std::to_string(components) +
             " components per taxel, that of the chosen hand " +
             std::to_string(matrix.touch.components);
  }
  return {};
}

}  // namespace

namespace {

std::size_t readingsOfTaxels(const MatrixLayout& matrix) {
  return matrix.numTaxels() * static_cast<std::size_t>(matrix.touch.components);
}

}  // namespace

StreamShape::StreamShape(const HandDescription& hand)
    : layout_(hand.layout),
      numAxes_(hand.axes.size()),
      numTemperatures_(hand.temperatureSensors.size()),
      unit_(hand.unit),
      handName_(hand.name) {
  if (!layout_ || layout_->numCells() == 0)
    throw std::invalid_argument("StreamShape: the hand has no matrices");
  for (std::size_t m = 0; m < layout_->numMatrices(); ++m) {
    const float fullScale = hand.maximumOf(m);
    if (!(fullScale > 0.0F) || !std::isfinite(fullScale))
      throw std::invalid_argument("StreamShape: the full scale of the hand is " +
                                  numberText(fullScale) + ", not above 0");
    fullScales_.push_back(fullScale);
  }
  for (const MatrixDescription& matrix : hand.matrices)
    names_.emplace_back(matrix.name, matrix.shortName);
  numPlaces_ = layout_->numReadings();
  for (const MatrixLayout& matrix : layout_->matrices()) numTaxels_ += readingsOfTaxels(matrix);
  if (numTaxels_ == numPlaces_) return;
  for (const MatrixLayout& matrix : layout_->matrices())
    for (const std::uint8_t exists : matrix.staticMask)
      exists_.insert(exists_.end(), static_cast<std::size_t>(matrix.touch.components), exists);
}

bool StreamShape::fits(StreamItemKind kind, std::size_t count) const noexcept {
  switch (kind) {
    case StreamItemKind::kFrame:
      return count > 0 && (count == numPlaces_ || count == numTaxels_);
    case StreamItemKind::kAngles:
      return count > 0 && count == numAxes_;
    case StreamItemKind::kTemperatures:
      return count > 0 && count == numTemperatures_;
    case StreamItemKind::kDescription:
      break;
  }
  return false;
}

std::string StreamShape::expected(StreamItemKind kind) const {
  if (kind == StreamItemKind::kAngles)
    return numAxes_ == 0 ? "none: the hand has no axes" : std::to_string(numAxes_);
  if (kind == StreamItemKind::kTemperatures)
    return numTemperatures_ == 0 ? "none: the hand has no temperature sensors"
                                 : std::to_string(numTemperatures_);
  if (numTaxels_ == numPlaces_) return std::to_string(numPlaces_);
  return std::to_string(numPlaces_) + " (places) or " + std::to_string(numTaxels_) + " (taxels)";
}

std::string StreamShape::arrange(std::span<float> values, std::size_t count) const {
  if (values.size() != numPlaces_ || !fits(StreamItemKind::kFrame, count))
    throw std::invalid_argument("StreamShape::arrange: wrong number of values");
  std::string outside;
  std::size_t from = 0;
  for (std::size_t m = 0; m < fullScales_.size(); ++m) {
    const MatrixLayout& matrix = layout_->matrix(m);
    const std::size_t to =
        from + (count == numPlaces_ ? matrix.numReadings() : readingsOfTaxels(matrix));
    const float most = fullScales_[m];
    const float least = matrix.touch.isSigned ? -most : 0.0F;
    const auto isGood = [=](float value) { return value >= least && value <= most; };
    // Without an early exit, so that the compiler makes vector instructions of it.
    bool allGood = true;
    for (std::size_t i = from; i < to; ++i) allGood &= isGood(values[i]);
    for (std::size_t i = from; i < to && !allGood; ++i) {
      // Whatever is sent for a place without a taxel is not used.
      if (isGood(values[i]) || (count == numPlaces_ && !exists_.empty() && exists_[i] == 0))
        continue;
      const bool isNumber = std::isfinite(values[i]);
      if (outside.empty())
        outside =
            "value " + std::to_string(i + 1) + " is " + numberText(values[i]) +
            (isNumber ? ", not in " + numberText(least) + ".." + numberText(most) + " " + unit_
                      : ": 0 is kept");
      if (!isNumber) values[i] = 0.0F;
    }
    from = to;
  }
  if (exists_.empty()) return outside;
  // From the end, since a value moves only towards the end.
  std::size_t next = count;
  for (std::size_t i = numPlaces_; i-- > 0;) {
    if (exists_[i] == 0)
      values[i] = 0.0F;
    else if (count != numPlaces_)
      values[i] = values[--next];
  }
  return outside;
}

std::optional<std::size_t> StreamShape::matrixNamed(std::string_view name) const noexcept {
  const auto found = std::ranges::find_if(names_, [&](const auto& each) {
    return equalsInAnyCase(name, each.first) || equalsInAnyCase(name, each.second);
  });
  if (name.empty() || found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

bool StreamShape::isOwnName(std::string_view name) const noexcept {
  return equalsInAnyCase(name, "frame") || isSameWord(name, handName_) ||
         std::ranges::any_of(names_, [&](const auto& each) {
           return isSameWord(name, each.first) || isSameWord(name, each.second);
         });
}

std::string StreamShape::check(std::span<const double> numbers) const {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i]))
      return "value " + std::to_string(i + 1) + " is " + numberText(numbers[i]);
  return {};
}

StreamDescription readStreamDescription(std::string_view text, const StreamShape& shape) {
  const Json object = Json::parse(text);
  if (!object.isObject()) throw Error("the description is not a JSON object");
  StreamDescription described{describedText(object, "name"),
                              describedText(object, "serial"),
                              describedText(object, "firmware"),
                              {}};
  if (object.contains("matrices"))
    described.mismatch = mismatchOf(object.at("matrices"), shape.layout());
  return described;
}

}  // namespace palpate
