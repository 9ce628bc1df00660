#include "palpate/slip/surface_information.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <Eigen/Core>

namespace palpate {
namespace {

constexpr int kSurfaceSide = 2 * SurfaceInformation::kReach + 1;
constexpr auto kSurfaceMiddle = static_cast<std::size_t>(SurfaceInformation::kReach);
// Coefficients of the inverse spectrum: of 1, k^2, k^4 and k^6.
constexpr std::array<double, 4> kInverseSpectrum{0.01, 0.4, 0.0, 0.24};

using SurfaceStencil = std::array<std::array<double, static_cast<std::size_t>(kSurfaceSide)>,
                                  static_cast<std::size_t>(kSurfaceSide)>;

// Applies the negative Laplacian with five points.
SurfaceStencil negativeLaplacian(const SurfaceStencil& in, double knot) {
  SurfaceStencil out{};
  for (std::size_t y = 0; y < in.size(); ++y)
    for (std::size_t x = 0; x < in.size(); ++x) {
      const double value = in[y][x] / (knot * knot);
      out[y][x] += 4.0 * value;
      if (y > 0) out[y - 1][x] -= value;
      if (y + 1 < in.size()) out[y + 1][x] -= value;
      if (x > 0) out[y][x - 1] -= value;
      if (x + 1 < in.size()) out[y][x + 1] -= value;
    }
  return out;
}

}  // namespace

SurfaceInformation::SurfaceInformation(int rows, int columns) : rows_(rows), columns_(columns) {
  if (rows <= 2 * kReach || columns <= 2 * kReach + 1)
    throw std::invalid_argument("SurfaceInformation: the grid has no places inside");
  const auto size = static_cast<std::size_t>(rows * columns);
  information_.resize(size * kRow);
  for (std::vector<float>* values : {&right_, &residual_, &direction_, &product_})
    values->resize(size);
  SurfaceStencil power{};
  power[kSurfaceMiddle][kSurfaceMiddle] = 1.0;
  prior_.assign(kRow, 0.0F);
  for (const double part : kInverseSpectrum) {
    for (std::size_t y = 0; y < power.size(); ++y)
      for (std::size_t x = 0; x < power.size(); ++x)
        prior_[y * kLine + x] += static_cast<float>(part * kKnotTaxels * kKnotTaxels * power[y][x]);
    power = negativeLaplacian(power, kKnotTaxels);
  }
  begin(1.0);
}

void SurfaceInformation::begin(double sd) noexcept {
  priorScale_ = static_cast<float>(1.0 / (sd * sd));
  // Directions outside of the range of the readings stay 0.
  for (std::vector<float>* values : {&right_, &residual_, &direction_})
    std::fill(values->begin(), values->end(), 0.0F);
  isResidualOld_ = false;
  using Row = Eigen::Array<float, kRow, 1>;
  const Row row = priorScale_ * Eigen::Map<const Row>(prior_.data());
  for (std::size_t i = 0; i < information_.size(); i += kRow)
    Eigen::Map<Row>(information_.data() + i) = row;
  left_ = columns_;
  last_ = -1;
  top_ = rows_;
  bottom_ = -1;
}

void SurfaceInformation::add(const float* coefficients,
                             int corner,
                             const float* weightsX,
                             const float* weightsY,
                             float gain,
                             float reading,
                             float variance) noexcept {
  const int row = corner / columns_;
  const int column = corner % columns_;
  // One column more than the reach is kept free on the right: multiply() reads lines of eight.
  const int left = std::max(kReach, std::min(left_, column));
  const int last = std::min(columns_ - kReach - 2, std::max(last_, column + 3));
  const int top = std::max(kReach, std::min(top_, row));
  const int bottom = std::min(rows_ - kReach - 1, std::max(bottom_, row + 3));
  if (left != left_ || last != last_ || top != top_ || bottom != bottom_) isResidualOld_ = true;
  left_ = left;
  last_ = last;
  top_ = top;
  bottom_ = bottom;
  using Four = Eigen::Array<float, 4, 1>;
  const Four across = Eigen::Map<const Four>(weightsX);
  const float information = gain * gain / variance;
  const float toward = gain * reading / variance;
  float value = 0.0F;
  for (int j = 0; j < 4; ++j)
    value +=
        weightsY[j] * (across * Eigen::Map<const Four>(coefficients + corner + j * columns_)).sum();
  const float change = gain * (reading - gain * value) / variance;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const float weight = weightsY[j] * weightsX[i];
      const auto place = static_cast<std::size_t>(corner + j * columns_ + i);
      right_[place] += toward * weight;
      residual_[place] += change * weight;
      float* from = information_.data() + place * kRow + (kReach - j) * kLine + kReach - i;
      for (int other = 0; other < 4; ++other)
        Eigen::Map<Four>(from + other * kLine) += (information * weight * weightsY[other]) * across;
    }
}

void SurfaceInformation::fade(const float* coefficients, float kept) noexcept {
  using Row = Eigen::Array<float, kRow, 1>;
  const Row prior = priorScale_ * Eigen::Map<const Row>(prior_.data());
  // Some readings also reach coefficients that are not solved for; nothing is read of these.
  for (int y = top_; y <= bottom_; ++y)
    for (int x = left_; x <= last_; ++x) {
      const auto place = static_cast<std::size_t>(y * columns_ + x);
      right_[place] *= kept;
      Eigen::Map<Row> row(information_.data() + place * kRow);
      row = prior + kept * (row - prior);
    }
  findResidual(coefficients);
}

void SurfaceInformation::findResidual(const float* coefficients) noexcept {
  multiply(coefficients, product_.data());
  for (int y = top_; y <= bottom_; ++y)
    for (int x = left_; x <= last_; ++x) {
      const auto place = static_cast<std::size_t>(y * columns_ + x);
      residual_[place] = right_[place] - product_[place];
    }
  isResidualOld_ = false;
}

float SurfaceInformation::diagonal(int place) const noexcept {
  return information_[static_cast<std::size_t>(place) * kRow + kReach * kLine + kReach];
}

void SurfaceInformation::multiply(const float* in, float* out) const noexcept {
  using Line = Eigen::Array<float, kLine, 1>;
  for (int y = top_; y <= bottom_; ++y)
    for (int x = left_; x <= last_; ++x) {
      const int place = y * columns_ + x;
      const float* row = information_.data() + static_cast<std::size_t>(place) * kRow;
      const float* from = in + place - kReach * columns_ - kReach;
      Line sum = Line::Zero();
      for (int j = 0; j < kSurfaceSide; ++j)
        sum +=
            Eigen::Map<const Line>(row + j * kLine) * Eigen::Map<const Line>(from + j * columns_);
      out[place] = sum.sum();
    }
}

void SurfaceInformation::solve(float* coefficients, int iterations) noexcept {
  const auto forEach = [this](const auto& visit) {
    for (int y = top_; y <= bottom_; ++y)
      for (int x = left_; x <= last_; ++x) visit(y * columns_ + x);
  };
  const auto at = [](std::vector<float>& values, int place) -> float& {
    return values[static_cast<std::size_t>(place)];
  };
  if (isResidualOld_) findResidual(coefficients);
  float rest = 0.0F;
  forEach([&](int place) {
    const float residual = at(residual_, place);
    at(direction_, place) = residual / diagonal(place);
    rest += residual * at(direction_, place);
  });
  for (int i = 0; i < iterations && rest > 0.0F; ++i) {
    multiply(direction_.data(), product_.data());
    float bend = 0.0F;
    forEach([&](int place) { bend += at(direction_, place) * at(product_, place); });
    if (!(bend > 0.0F)) return;
    const float length = rest / bend;
    float next = 0.0F;
    forEach([&](int place) {
      coefficients[place] += length * at(direction_, place);
      float& residual = at(residual_, place);
      residual -= length * at(product_, place);
      next += residual * residual / diagonal(place);
    });
    const float kept = next / rest;
    rest = next;
    forEach([&](int place) {
      float& direction = at(direction_, place);
      direction = at(residual_, place) / diagonal(place) + kept * direction;
    });
  }
}

}  // namespace palpate
