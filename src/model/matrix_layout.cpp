#include "palpate/model/matrix_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {
constexpr int kMaxSide = 256;
}

double TaxelPitch::lengthMm(double dx, double dy) const noexcept {
  return isSquare() ? std::hypot(dx, dy) * x : std::hypot(dx * x, dy * y);
}

Json pitchJson(const TaxelPitch& pitch) {
  if (pitch.isSquare()) return pitch.x;
  const std::array<double, 2> both{pitch.x, pitch.y};
  return Json::array(both);
}

std::string pitchText(const TaxelPitch& pitch, int digits) {
  const auto text = [digits](double mm) {
    return digits < 0 ? numberText(mm) : fixedText(mm, digits);
  };
  return text(pitch.x) + (pitch.isSquare() ? "" : " x " + text(pitch.y)) + " mm";
}

MatrixLayout MatrixLayout::full(int rows, int columns, const TaxelPitch& pitchMm) {
  MatrixLayout layout{rows, columns, pitchMm, {}, {}, {}, {}};
  if (rows >= 1 && rows <= kMaxSide && columns >= 1 && columns <= kMaxSide) {
    layout.staticMask.assign(layout.numCells(), 1);
    layout.dynamicMask = layout.staticMask;
  }
  layout.validate();
  return layout;
}

std::size_t MatrixLayout::numCells() const noexcept {
  return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
}

std::size_t MatrixLayout::numTaxels() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(staticMask.begin(), staticMask.end(), [](auto on) { return on != 0; }));
}

std::size_t MatrixLayout::numEnabled() const noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < staticMask.size(); ++i) count += staticMask[i] && dynamicMask[i];
  return count;
}

bool MatrixLayout::exists(int y, int x) const noexcept {
  return y >= 0 && y < rows && x >= 0 && x < columns &&
         staticMask[static_cast<std::size_t>(y * columns + x)] != 0;
}

bool MatrixLayout::enabled(int y, int x) const noexcept {
  return exists(y, x) && dynamicMask[static_cast<std::size_t>(y * columns + x)] != 0;
}

void MatrixLayout::validate() const {
  const auto side = [](const char* name, int value) {
    if (value < 1 || value > kMaxSide)
      throw std::invalid_argument("MatrixLayout: " + std::string(name) + " must be 1..256, is " +
                                  std::to_string(value));
  };
  side("rows", rows);
  side("columns", columns);
  for (const double mm : {pitchMm.x, pitchMm.y})
    if (!std::isfinite(mm) || mm <= 0.0 || mm > 1000.0)
      throw std::invalid_argument("MatrixLayout: pitchMm must be above 0 and at most 1000 mm, is " +
                                  std::to_string(mm));
  if (staticMask.size() != numCells() || dynamicMask.size() != numCells())
    throw std::invalid_argument("MatrixLayout: a mask doesn't have rows * columns places");
  if (touch.components != 1 && touch.components != 3)
    throw std::invalid_argument("MatrixLayout: components must be 1 or 3, is " +
                                std::to_string(touch.components));
  for (const float limit : {touch.threshold, touch.sigmas})
    if (!std::isfinite(limit) || limit < 0.0F)
      throw std::invalid_argument("MatrixLayout: a limit of touch is below 0");
}

SensorLayout::SensorLayout(std::vector<MatrixLayout> matrices) : matrices_(std::move(matrices)) {
  if (matrices_.empty()) throw std::invalid_argument("SensorLayout: no matrix");
  for (const MatrixLayout& matrix : matrices_) {
    matrix.validate();
    offsets_.push_back(numPlaces_);
    numPlaces_ += matrix.numCells();
    readingOffsets_.push_back(numReadings_);
    numReadings_ += matrix.numReadings();
    decidesTouch_ = decidesTouch_ || matrix.touch.decides();
  }
}

bool SensorLayout::hasSquareTaxels() const noexcept {
  return std::all_of(matrices_.begin(), matrices_.end(), [](const MatrixLayout& matrix) {
    return matrix.pitchMm.isSquare();
  });
}

std::size_t SensorLayout::numTaxels() const noexcept {
  std::size_t count = 0;
  for (const MatrixLayout& matrix : matrices_) count += matrix.numTaxels();
  return count;
}

void requireMatrix(const std::filesystem::path& file,
                   const SensorLayout& layout,
                   std::optional<std::int64_t> matrix) {
  const auto last = static_cast<std::int64_t>(layout.numMatrices()) - 1;
  if (matrix && *matrix > last)
    throw Error(file.string() + ": has no matrix " + std::to_string(*matrix) + ", only 0.." +
                std::to_string(last));
}

}  // namespace palpate
