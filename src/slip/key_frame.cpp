#include "palpate/slip/key_frame.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/slip/contact_moments.h"

#include "slip/spline_weights.h"

namespace palpate {
namespace {

// Places of coefficients on every side of the matrix.
constexpr int kKeyFrameAround = 2;
// Pole of the inverse filter of the cubic spline: sqrt(3) - 2.
constexpr float kPole = -0.26794919F;

using spline::SplineWeights;

// Replaces the values along one line by the coefficients of the spline through them. The line is
// mirrored at its ends.
void inverseFilter(float* line, int length, int step) noexcept {
  // The spline through one place is constant.
  if (length == 1) return;
  // The line is mirrored about its end places: the sum runs over the line and its mirror image, and
  // each term is smaller by a factor of 0.27.
  const int period = 2 * length - 2;
  float sum = 0.0F;
  float power = 1.0F;
  for (int i = 0; i < std::min(period, 14); ++i) {
    sum += power * line[(i < length ? i : period - i) * step];
    power *= kPole;
  }
  line[0] = sum;
  for (int i = 1; i < length; ++i) line[i * step] += kPole * line[(i - 1) * step];
  const int last = (length - 1) * step;
  line[last] = kPole / (kPole * kPole - 1.0F) * (line[last] + kPole * line[last - step]);
  for (int i = length - 2; i >= 0; --i)
    line[i * step] = kPole * (line[(i + 1) * step] - line[i * step]);
  for (int i = 0; i < length; ++i) line[i * step] *= 6.0F;
}

// Extrapolates a line by two places at either end, with the parabola (or the line, or the constant)
// through its last places.
void goOn(float* line, int length, int step) noexcept {
  for (int side = 0; side < 2; ++side) {
    float* end = side == 0 ? line : line + (length - 1) * step;
    const int in = side == 0 ? step : -step;
    for (int i = 1; i <= kKeyFrameAround; ++i) {
      float* place = end - i * in;
      if (length >= 3)
        *place = 3.0F * place[in] - 3.0F * place[2 * in] + place[3 * in];
      else
        *place = length == 2 ? 2.0F * place[in] - place[2 * in] : place[in];
    }
  }
}

}  // namespace

void KeyFrameOptions::validate() const {
  if (!(blurTaxels >= 0.0 && blurTaxels <= 2.0))
    throw std::invalid_argument("KeyFrameOptions: blurTaxels is " + std::to_string(blurTaxels) +
                                ", not 0..2");
  if (!(fillOfThreshold >= 0.0 && fillOfThreshold <= 1.0))
    throw std::invalid_argument("KeyFrameOptions: fillOfThreshold is " +
                                std::to_string(fillOfThreshold) + ", not 0..1");
}

void smoothMatrix(const MatrixLayout& layout,
                  double blurTaxels,
                  const float* in,
                  float* out) noexcept {
  const int rows = layout.rows;
  const int columns = layout.columns;
  if (blurTaxels <= 0.0) {
    for (int y = 0, i = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x, ++i)
        out[i] = layout.enabled(y, x) && isTouched(in[i]) ? in[i] : 0.0F;
    return;
  }
  const auto side = static_cast<float>(std::exp(-0.5 / (blurTaxels * blurTaxels)));
  for (int y = 0, i = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x, ++i) {
      out[i] = 0.0F;
      if (!layout.enabled(y, x)) continue;
      float sum = 0.0F;
      float weights = 0.0F;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (!layout.enabled(y + dy, x + dx)) continue;
          const float weight = (dx == 0 ? 1.0F : side) * (dy == 0 ? 1.0F : side);
          const float value = in[i + dy * columns + dx];
          sum += isTouched(value) ? weight * value : 0.0F;
          weights += weight;
        }
      out[i] = sum / weights;
    }
}

KeyFrame::KeyFrame(const MatrixLayout& layout, const KeyFrameOptions& options)
    : layout_(layout), options_(options) {
  layout_.validate();
  options_.validate();
  const std::size_t places = layout_.numCells();
  enabled_.resize(places);
  for (int y = 0; y < layout_.rows; ++y)
    for (int x = 0; x < layout_.columns; ++x)
      enabled_[static_cast<std::size_t>(y * layout_.columns + x)] = layout_.enabled(y, x) ? 1 : 0;
  smoothed_.resize(places);
  filled_.resize(places);
  stride_ = layout_.columns + 2 * kKeyFrameAround;
  const auto padded = static_cast<std::size_t>(stride_ * (layout_.rows + 2 * kKeyFrameAround));
  coefficients_.resize(padded);
  unknown_.resize(padded);
}

bool KeyFrame::set(const ConstMatrixMap& frame) {
  if (frame.rows() != layout_.rows || frame.cols() != layout_.columns)
    throw std::invalid_argument("KeyFrame: the frame doesn't have the size of the matrix");
  const ContactMoments moments = contactMoments(frame);
  active_ = 0;
  if (moments.active < kMinTaxels) return false;
  centerX_ = moments.x;
  centerY_ = moments.y;
  sum_ = moments.sum;
  least_ = 0.0F;
  for (Eigen::Index i = 0; i < frame.size(); ++i)
    if (isTouched(frame.data()[i]) && (least_ == 0.0F || frame.data()[i] < least_))
      least_ = frame.data()[i];
  smoothMatrix(layout_, options_.blurTaxels, frame.data(), smoothed_.data());
  active_ = moments.active;
  fill();
  interpolate();
  computeRotationSensitivity();
  return true;
}

void KeyFrame::fill() {
  std::fill(unknown_.begin(), unknown_.end(), 0.0F);
  const int rows = layout_.rows;
  const int columns = layout_.columns;
  const auto silent = static_cast<float>(options_.fillOfThreshold) * least_;
  for (int y = 0, i = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x, ++i) {
      const auto place = static_cast<std::size_t>(i);
      filled_[place] = smoothed_[place];
      if (enabled_[place] != 0 && isTouched(smoothed_[place])) continue;
      float sum = 0.0F;
      int neighbors = 0;
      int near = 0;
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, rows - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, columns - 1); ++nx) {
          const auto other = static_cast<std::size_t>(ny * columns + nx);
          if (enabled_[other] == 0) continue;
          const int weight = nx == x || ny == y ? 2 : 1;
          sum += static_cast<float>(weight) * smoothed_[other];
          neighbors += weight;
          near += isTouched(smoothed_[other]) ? 1 : 0;
        }
      float& unknown =
          unknown_[static_cast<std::size_t>((y + kKeyFrameAround) * stride_ + x + kKeyFrameAround)];
      if (enabled_[place] == 0) {
        filled_[place] = neighbors > 0 ? sum / static_cast<float>(neighbors) : 0.0F;
        unknown = near > 0 ? 1.0F : 0.0F;
      } else if (near > 0) {
        filled_[place] = silent;
        unknown = 1.0F;
      }
    }
}

// Outside of the matrix the surface is continued as a parabola, so that a contact that is cut off
// by an edge keeps its slope there. Values outside are never compared with a taxel; they only serve
// as the boundary of the spline.
void KeyFrame::interpolate() noexcept {
  const int rows = layout_.rows;
  const int columns = layout_.columns;
  float* inner = coefficients_.data() + kKeyFrameAround * stride_ + kKeyFrameAround;
  for (int y = 0; y < rows; ++y) {
    float* line = inner + y * stride_;
    std::copy_n(filled_.data() + y * columns, columns, line);
    goOn(line, columns, 1);
    inverseFilter(line - kKeyFrameAround, stride_, 1);
  }
  for (int x = -kKeyFrameAround; x < columns + kKeyFrameAround; ++x) {
    goOn(inner + x, rows, stride_);
    inverseFilter(inner + x - kKeyFrameAround * stride_, rows + 2 * kKeyFrameAround, stride_);
  }
}

void KeyFrame::computeRotationSensitivity() noexcept {
  rotationSensitivity_ = -1.0F;
  if (!layout_.pitchMm.isSquare()) return;
  const int rows = layout_.rows;
  const int columns = layout_.columns;
  float around = 0.0F;
  float all = 0.0F;
  for (int y = 1; y < rows - 1; ++y)
    for (int x = 1; x < columns - 1; ++x) {
      const float* at = filled_.data() + y * columns + x;
      const float slopeX = at[1] - at[-1];
      const float slopeY = at[columns] - at[-columns];
      const float ux = static_cast<float>(x) - static_cast<float>(centerX_);
      const float uy = static_cast<float>(y) - static_cast<float>(centerY_);
      const float turn = slopeX * uy - slopeY * ux;
      around += turn * turn;
      all += (slopeX * slopeX + slopeY * slopeY) * (ux * ux + uy * uy);
    }
  rotationSensitivity_ = all > 0.0F ? around / all : 0.0F;
}

float KeyFrame::coefficient(int y, int x) const noexcept {
  const int row = std::clamp(y + kKeyFrameAround, 0, layout_.rows + 2 * kKeyFrameAround - 1);
  const int column = std::clamp(x + kKeyFrameAround, 0, stride_ - 1);
  return coefficients_[static_cast<std::size_t>(row * stride_ + column)];
}

KeyFrame::Sample KeyFrame::at(float x, float y) const noexcept {
  const float floorX = std::floor(x);
  const float floorY = std::floor(y);
  const float tx = x - floorX;
  const float ty = y - floorY;
  const int corner = (static_cast<int>(floorY) + kKeyFrameAround) * stride_ +
                     static_cast<int>(floorX) + kKeyFrameAround;
  const float* places = coefficients_.data() + corner - stride_ - 1;
  const SplineWeights weightsY = spline::weights(ty);
  const SplineWeights slopesY = spline::slopes(ty);
  SplineWeights values = SplineWeights::Zero();
  SplineWeights slopes = SplineWeights::Zero();
  for (int j = 0; j < 4; ++j) {
    const SplineWeights line = Eigen::Map<const SplineWeights>(places + j * stride_);
    values += weightsY(j) * line;
    slopes += slopesY(j) * line;
  }
  const SplineWeights weightsX = spline::weights(tx);
  Sample sample;
  sample.value = (values * weightsX).sum();
  sample.alongX = (values * spline::slopes(tx)).sum();
  sample.alongY = (slopes * weightsX).sum();
  const float* unknown = unknown_.data() + corner;
  sample.unknown = (1.0F - ty) * ((1.0F - tx) * unknown[0] + tx * unknown[1]) +
                   ty * ((1.0F - tx) * unknown[stride_] + tx * unknown[stride_ + 1]);
  return sample;
}

}  // namespace palpate
