// The slip methods `ncc-paraboloid` and `ncc-gauss3`: normalised cross-correlation of two frames
// over their overlap at every shift,
//
//   rho(s) = sum A(p) B(p + s) / sqrt(sum A(p)^2 sum B(p + s)^2),  p and p + s inside of the matrix
//
// If it were normalised over the whole frames, the peak would be biased towards 0. A shift at which
// less than half of the sum of squares of either frame overlaps counts as no match.
#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

#include "slip/translation_method.h"

namespace palpate {
namespace {

// Taxels on either side of the peak: 7 x 7.
constexpr int kNccMethodAround = 3;
constexpr float kNccMethodLeastOverlap = 0.5F;
// Standard deviation of the weights of the paraboloid [taxels].
constexpr double kNeighborhoodSd = 1.0;

struct Shift {
  double x = 0.0;
  double y = 0.0;
  double peak = 0.0;
};

class NccMethod final : public TranslationMethod {
 public:
  NccMethod(const MatrixLayout& layout, const SlipTrackerOptions& options, bool paraboloid)
      : rows_(layout.rows),
        columns_(layout.columns),
        farthest_(options.maxStepTaxels),
        paraboloid_(paraboloid),
        last_(layout.numCells()),
        reference_(layout.numCells()),
        now_(layout.numCells()) {
    reach_ = farthest_ + kNccMethodAround;
    known_.resize(static_cast<std::size_t>((2 * reach_ + 1) * (2 * reach_ + 1)));
    // Summed-area table of the squares.
    const auto sums = static_cast<std::size_t>((rows_ + 1) * (columns_ + 1));
    squaresA_.resize(sums);
    squaresB_.resize(sums);
  }

  TranslationReading update(const ConstMatrixMap& frame,
                            const ContactMoments& moments,
                            bool measurable,
                            bool stepPossible) override {
    TranslationReading reading;
    for (Eigen::Index i = 0; i < frame.size(); ++i)
      now_[static_cast<std::size_t>(i)] = isTouched(frame.data()[i]) ? frame.data()[i] : 0.0F;
    reading.residual = 1.0;
    if (measurable && stepPossible && hasLast_) {
      if (const auto shift = shiftOf(last_, moments.x - lastX_, moments.y - lastY_)) {
        reading.valid = true;
        reading.dx = shift->x;
        reading.dy = shift->y;
        reading.residual = 1.0 - shift->peak;
        reading.confidence = shift->peak;
      }
    }
    if (measurable && hasReference_) {
      if (const auto shift =
              shiftOf(reference_, moments.x - referenceX_, moments.y - referenceY_)) {
        reading.refValid = true;
        reading.refDx = shift->x;
        reading.refDy = shift->y;
      }
    }
    last_.swap(now_);
    lastX_ = moments.x;
    lastY_ = moments.y;
    hasLast_ = measurable;
    return reading;
  }
  void lost() override { hasLast_ = false; }
  void takeReference() override {
    std::copy(last_.begin(), last_.end(), reference_.begin());
    referenceX_ = lastX_;
    referenceY_ = lastY_;
    hasReference_ = true;
  }
  void dropReference() override { hasReference_ = false; }

 private:
  // Returns the shift from the frame `from` to the newest frame. The search starts at the shift of
  // the centroid, because far from the reference there is no match near 0.
  std::optional<Shift> shiftOf(const std::vector<float>& from, double guessX, double guessY) {
    baseX_ = std::clamp(static_cast<int>(std::lround(guessX)), 1 - columns_, columns_ - 1);
    baseY_ = std::clamp(static_cast<int>(std::lround(guessY)), 1 - rows_, rows_ - 1);
    sumSquares(from, squaresA_);
    sumSquares(now_, squaresB_);
    leastA_ = kNccMethodLeastOverlap * squaresA_.back();
    leastB_ = kNccMethodLeastOverlap * squaresB_.back();
    from_ = from.data();
    std::fill(known_.begin(), known_.end(), kUnknown);
    // Hill climbing from the start: tests the eight neighbours and continues from the best of them.
    int x = 0;
    int y = 0;
    float best = at(0, 0);
    for (int moves = 0; moves < 2 * farthest_; ++moves) {
      int bestX = x;
      int bestY = y;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (std::abs(x + dx) > farthest_ || std::abs(y + dy) > farthest_) continue;
          const float value = at(x + dx, y + dy);
          if (value > best) {
            best = value;
            bestX = x + dx;
            bestY = y + dy;
          }
        }
      if (bestX == x && bestY == y) break;
      x = bestX;
      y = bestY;
    }
    if (best <= 0.0F) return std::nullopt;
    double offX = 0.0;
    double offY = 0.0;
    if (!(paraboloid_ ? paraboloidPeak(x, y, offX, offY) : gaussianPeak(x, y, offX, offY)))
      return std::nullopt;
    return Shift{baseX_ + x + offX, baseY_ + y + offY, std::min(static_cast<double>(best), 1.0)};
  }

  void sumSquares(const std::vector<float>& values, std::vector<float>& sums) const {
    const int stride = columns_ + 1;
    for (int y = 0; y < rows_; ++y) {
      float row = 0.0F;
      for (int x = 0; x < columns_; ++x) {
        const float value = values[static_cast<std::size_t>(y * columns_ + x)];
        row += value * value;
        sums[static_cast<std::size_t>((y + 1) * stride + x + 1)] =
            sums[static_cast<std::size_t>(y * stride + x + 1)] + row;
      }
    }
  }
  float squaresOver(const std::vector<float>& sums, int y0, int y1, int x0, int x1) const {
    const int stride = columns_ + 1;
    const auto sum = [&](int y, int x) { return sums[static_cast<std::size_t>(y * stride + x)]; };
    return sum(y1, x1) - sum(y0, x1) - sum(y1, x0) + sum(y0, x0);
  }

  // Returns rho at a shift relative to the start; below 0: no match.
  float at(int x, int y) {
    if (std::abs(x) > reach_ || std::abs(y) > reach_) return kNoMatch;
    float& known = known_[static_cast<std::size_t>((y + reach_) * (2 * reach_ + 1) + x + reach_)];
    if (known != kUnknown) return known;
    known = kNoMatch;
    const int sx = baseX_ + x;
    const int sy = baseY_ + y;
    const int x0 = std::max(0, -sx);
    const int x1 = std::min(columns_, columns_ - sx);
    const int y0 = std::max(0, -sy);
    const int y1 = std::min(rows_, rows_ - sy);
    if (x0 >= x1 || y0 >= y1) return known;
    const float squaresA = squaresOver(squaresA_, y0, y1, x0, x1);
    const float squaresB = squaresOver(squaresB_, y0 + sy, y1 + sy, x0 + sx, x1 + sx);
    if (squaresA < leastA_ || squaresB < leastB_ || squaresA <= 0.0F || squaresB <= 0.0F)
      return known;
    float product = 0.0F;
    for (int row = y0; row < y1; ++row) {
      const float* a = from_ + row * columns_;
      const float* b = now_.data() + (row + sy) * columns_ + sx;
      for (int column = x0; column < x1; ++column) product += a[column] * b[column];
    }
    known = product / std::sqrt(squaresA * squaresB);
    return known;
  }

  bool gaussianPeak(int x, int y, double& offX, double& offY) {
    const auto along = [](float before, float peak, float behind, double& off) {
      if (before <= 0.0F || behind <= 0.0F) return false;
      const double low = std::log(static_cast<double>(before));
      const double middle = std::log(static_cast<double>(peak));
      const double high = std::log(static_cast<double>(behind));
      const double bend = low - 2.0 * middle + high;
      off = bend < -1e-12 ? std::clamp(0.5 * (low - high) / bend, -1.0, 1.0) : 0.0;
      return true;
    };
    return along(at(x - 1, y), at(x, y), at(x + 1, y), offX) &&
           along(at(x, y - 1), at(x, y), at(x, y + 1), offY);
  }

  // Fits a x^2 + b y^2 + c x y + d x + e y + f by weighted least squares to 7 x 7 places around the
  // peak.
  bool paraboloidPeak(int x, int y, double& offX, double& offY) {
    using Six = Eigen::Matrix<double, 6, 1>;
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Six right = Six::Zero();
    int points = 0;
    for (int dy = -kNccMethodAround; dy <= kNccMethodAround; ++dy)
      for (int dx = -kNccMethodAround; dx <= kNccMethodAround; ++dx) {
        const double value = static_cast<double>(at(x + dx, y + dy));
        if (value < 0.0) continue;
        const double u = dx;
        const double v = dy;
        const double weight =
            std::exp(-0.5 * (u * u + v * v) / (kNeighborhoodSd * kNeighborhoodSd));
        Six row;
        row << u * u, v * v, u * v, u, v, 1.0;
        normal.noalias() += weight * row * row.transpose();
        right += weight * value * row;
        ++points;
      }
    if (points < 9) return false;
    const Six fit = normal.ldlt().solve(right);
    const double a = fit(0);
    const double b = fit(1);
    const double c = fit(2);
    const double d = fit(3);
    const double e = fit(4);
    const double curvature = c * c - 4.0 * a * b;
    // The paraboloid has no maximum.
    if (!(curvature < -1e-12) || a >= 0.0) return false;
    offX = std::clamp((2.0 * d * b - c * e) / curvature, -1.5, 1.5);
    offY = std::clamp((2.0 * a * e - d * c) / curvature, -1.5, 1.5);
    return true;
  }

  static constexpr float kUnknown = -2.0F;
  static constexpr float kNoMatch = -1.0F;
  const int rows_;
  const int columns_;
  const int farthest_;
  const bool paraboloid_;
  int reach_ = 0;
  std::vector<float> last_;
  std::vector<float> reference_;
  std::vector<float> now_;
  std::vector<float> known_;
  std::vector<float> squaresA_;
  std::vector<float> squaresB_;
  const float* from_ = nullptr;
  float leastA_ = 0.0F;
  float leastB_ = 0.0F;
  int baseX_ = 0;
  int baseY_ = 0;
  double lastX_ = 0.0;
  double lastY_ = 0.0;
  double referenceX_ = 0.0;
  double referenceY_ = 0.0;
  bool hasLast_ = false;
  bool hasReference_ = false;
};

}  // namespace

std::unique_ptr<TranslationMethod> makeNccMethod(const MatrixLayout& layout,
                                                 const SlipTrackerOptions& options,
                                                 bool paraboloid) {
  return std::make_unique<NccMethod>(layout, options, paraboloid);
}

}  // namespace palpate
