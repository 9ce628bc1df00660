// The slip methods `phase` and `phase-normalized`: the peak of the inverse transform of the
// cross-power spectrum, on a grid of 1/32 taxel.
//
// Frames are padded with zeros to twice their size, so that shifted contacts do not wrap around.
// The inverse transform is evaluated only where it is needed, as products with small matrices
// (matrix-multiply DFT, after Guizar-Sicairos et al. 2008): first at whole taxels around the shift
// of the centroids, then at 1/4, then at 1/32 of a taxel. Without normalisation the result is the
// cross-correlation of both frames; with normalisation all frequencies have equal weight, including
// those that contain only noise.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "slip/translation_method.h"

namespace palpate {
namespace {

struct Spectrum {
  std::vector<float> real;  // frequenciesY x frequenciesX
  std::vector<float> imaginary;
  // Centroid of the frame [taxels].
  double x = 0.0;
  double y = 0.0;
  // Sum of the squares of the frame.
  double power = 0.0;
  bool known = false;
};

class PhaseMethod final : public TranslationMethod {
 public:
  PhaseMethod(const MatrixLayout& layout, const SlipTrackerOptions& options, bool normalized)
      : rows_(layout.rows),
        columns_(layout.columns),
        sizeX_(2 * layout.columns),
        sizeY_(2 * layout.rows),
        halfX_(layout.columns + 1),
        normalized_(normalized),
        farthest_(options.maxStepTaxels) {
    const auto bins = static_cast<std::size_t>(sizeY_ * halfX_);
    for (Spectrum* spectrum : {&now_, &last_, &reference_}) {
      spectrum->real.resize(bins);
      spectrum->imaginary.resize(bins);
    }
    crossReal_.resize(bins);
    crossImaginary_.resize(bins);
    ofRowsReal_.resize(static_cast<std::size_t>(rows_ * halfX_));
    ofRowsImaginary_.resize(static_cast<std::size_t>(rows_ * halfX_));
    forwardX_ = waves(columns_, halfX_, sizeX_);
    forwardY_ = waves(rows_, sizeY_, sizeY_);
    const int most = std::max(2 * farthest_ + 1, 9);
    alongReal_.resize(static_cast<std::size_t>(most * halfX_));
    alongImaginary_.resize(static_cast<std::size_t>(most * halfX_));
    waveReal_.resize(static_cast<std::size_t>(std::max(sizeY_, halfX_)));
    waveImaginary_.resize(static_cast<std::size_t>(std::max(sizeY_, halfX_)));
  }

  TranslationReading update(const ConstMatrixMap& frame,
                            const ContactMoments& moments,
                            bool measurable,
                            bool stepPossible) override {
    TranslationReading reading;
    reading.residual = 1.0;
    transform(frame, moments);
    if (measurable && stepPossible && last_.known) {
      const Peak peak = peakOf(last_);
      reading.valid = true;
      reading.dx = peak.x;
      reading.dy = peak.y;
      reading.confidence = peak.height;
      reading.residual = 1.0 - peak.height;
    }
    if (measurable && reference_.known) {
      const Peak peak = peakOf(reference_);
      reading.refValid = true;
      reading.refDx = peak.x;
      reading.refDy = peak.y;
    }
    std::swap(last_, now_);
    last_.known = measurable;
    return reading;
  }
  void lost() override { last_.known = false; }
  void takeReference() override {
    std::copy(last_.real.begin(), last_.real.end(), reference_.real.begin());
    std::copy(last_.imaginary.begin(), last_.imaginary.end(), reference_.imaginary.begin());
    reference_.x = last_.x;
    reference_.y = last_.y;
    reference_.power = last_.power;
    reference_.known = true;
  }
  void dropReference() override { reference_.known = false; }

 private:
  struct Peak {
    double x = 0.0;
    double y = 0.0;
    // Relative to the largest possible value, 0..1.
    double height = 0.0;
  };
  struct Waves {
    std::vector<float> real;  // places x frequencies
    std::vector<float> imaginary;
  };

  static Waves waves(int places, int frequencies, int size) {
    Waves result;
    for (int place = 0; place < places; ++place)
      for (int frequency = 0; frequency < frequencies; ++frequency) {
        const double angle = -2.0 * std::numbers::pi * place * frequency / size;
        result.real.push_back(static_cast<float>(std::cos(angle)));
        result.imaginary.push_back(static_cast<float>(std::sin(angle)));
      }
    return result;
  }

  // Transforms a frame. Along x only the frequencies 0..columns are kept (the others are their
  // conjugates), along y all.
  void transform(const ConstMatrixMap& frame, const ContactMoments& moments) {
    const auto half = static_cast<std::size_t>(halfX_);
    std::fill(now_.real.begin(), now_.real.end(), 0.0F);
    std::fill(now_.imaginary.begin(), now_.imaginary.end(), 0.0F);
    double power = 0.0;
    for (int y = 0; y < rows_; ++y) {
      float* __restrict real = ofRowsReal_.data();
      float* __restrict imaginary = ofRowsImaginary_.data();
      std::fill_n(real, half, 0.0F);
      std::fill_n(imaginary, half, 0.0F);
      bool any = false;
      for (int x = 0; x < columns_; ++x) {
        const float value = frame.data()[y * columns_ + x];
        if (!isTouched(value)) continue;
        any = true;
        power += static_cast<double>(value) * static_cast<double>(value);
        const float* waveReal = forwardX_.real.data() + x * halfX_;
        const float* waveImaginary = forwardX_.imaginary.data() + x * halfX_;
        for (std::size_t k = 0; k < half; ++k) {
          real[k] += value * waveReal[k];
          imaginary[k] += value * waveImaginary[k];
        }
      }
      if (!any) continue;
      for (int l = 0; l < sizeY_; ++l) {
        const float c = forwardY_.real[static_cast<std::size_t>(y * sizeY_ + l)];
        const float s = forwardY_.imaginary[static_cast<std::size_t>(y * sizeY_ + l)];
        float* __restrict intoReal = now_.real.data() + l * halfX_;
        float* __restrict intoImaginary = now_.imaginary.data() + l * halfX_;
        for (std::size_t k = 0; k < half; ++k) {
          intoReal[k] += c * real[k] - s * imaginary[k];
          intoImaginary[k] += c * imaginary[k] + s * real[k];
        }
      }
    }
    now_.x = moments.x;
    now_.y = moments.y;
    now_.power = power;
    now_.known = true;
  }

  Peak peakOf(const Spectrum& from) {
    float all = 0.0F;
    for (std::size_t i = 0; i < crossReal_.size(); ++i) {
      float real = from.real[i] * now_.real[i] + from.imaginary[i] * now_.imaginary[i];
      float imaginary = from.real[i] * now_.imaginary[i] - from.imaginary[i] * now_.real[i];
      if (normalized_) {
        const float size = std::sqrt(real * real + imaginary * imaginary);
        const float scale = size > 1e-3F ? 1.0F / size : 0.0F;
        real *= scale;
        imaginary *= scale;
      }
      crossReal_[i] = real;
      crossImaginary_[i] = imaginary;
    }
    // Frequencies between the ends also represent their conjugates.
    for (int l = 0; l < sizeY_; ++l)
      for (int k = 1; k + 1 < halfX_; ++k) {
        crossReal_[static_cast<std::size_t>(l * halfX_ + k)] *= 2.0F;
        crossImaginary_[static_cast<std::size_t>(l * halfX_ + k)] *= 2.0F;
      }
    all = normalized_ ? static_cast<float>(sizeX_ * sizeY_)
                      : static_cast<float>(std::sqrt(from.power * now_.power) * sizeX_ * sizeY_);
    Peak peak{std::round(now_.x - from.x), std::round(now_.y - from.y), 0.0};
    peak = bestAround(peak, 1.0, farthest_);
    peak = bestAround(peak, 0.25, 3);
    peak = bestAround(peak, 1.0 / 32.0, 4);
    peak.height = std::clamp(peak.height / static_cast<double>(all), 0.0, 1.0);
    return peak;
  }

  // Returns the largest value of the inverse transform at 2 n + 1 places along both axes.
  Peak bestAround(const Peak& center, double step, int n) {
    const int places = 2 * n + 1;
    const auto half = static_cast<std::size_t>(halfX_);
    for (int i = 0; i < places; ++i) {
      fillWave(center.y + (i - n) * step, sizeY_, sizeY_);
      float* __restrict real = alongReal_.data() + i * halfX_;
      float* __restrict imaginary = alongImaginary_.data() + i * halfX_;
      std::fill_n(real, half, 0.0F);
      std::fill_n(imaginary, half, 0.0F);
      for (int l = 0; l < sizeY_; ++l) {
        const float c = waveReal_[static_cast<std::size_t>(l)];
        const float s = waveImaginary_[static_cast<std::size_t>(l)];
        const float* crossReal = crossReal_.data() + l * halfX_;
        const float* crossImaginary = crossImaginary_.data() + l * halfX_;
        for (std::size_t k = 0; k < half; ++k) {
          real[k] += c * crossReal[k] - s * crossImaginary[k];
          imaginary[k] += c * crossImaginary[k] + s * crossReal[k];
        }
      }
    }
    Peak best{center.x, center.y, -1e30};
    for (int j = 0; j < places; ++j) {
      const double x = center.x + (j - n) * step;
      // Beyond this the transform repeats itself.
      if (std::abs(x) > columns_ - 0.5) continue;
      fillWave(x, halfX_, sizeX_);
      for (int i = 0; i < places; ++i) {
        if (std::abs(center.y + (i - n) * step) > rows_ - 0.5) continue;
        const float* real = alongReal_.data() + i * halfX_;
        const float* imaginary = alongImaginary_.data() + i * halfX_;
        float sum = 0.0F;
        for (std::size_t k = 0; k < half; ++k)
          sum += waveReal_[k] * real[k] - waveImaginary_[k] * imaginary[k];
        if (static_cast<double>(sum) > best.height)
          best = {x, center.y + (i - n) * step, static_cast<double>(sum)};
      }
    }
    return best;
  }

  // Computes e^(i 2 pi f place / size); frequencies above half of the size are negative ones.
  void fillWave(double place, int frequencies, int size) {
    const double angle = 2.0 * std::numbers::pi * place / size;
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    float real = 1.0F;
    float imaginary = 0.0F;
    waveReal_[0] = real;
    waveImaginary_[0] = imaginary;
    const int positive = std::min(frequencies - 1, size / 2);
    for (int f = 1; f <= positive; ++f) {
      const float next = real * c - imaginary * s;
      imaginary = real * s + imaginary * c;
      real = next;
      waveReal_[static_cast<std::size_t>(f)] = real;
      waveImaginary_[static_cast<std::size_t>(f)] = imaginary;
    }
    for (int f = positive + 1; f < frequencies; ++f) {
      waveReal_[static_cast<std::size_t>(f)] = waveReal_[static_cast<std::size_t>(size - f)];
      waveImaginary_[static_cast<std::size_t>(f)] =
          -waveImaginary_[static_cast<std::size_t>(size - f)];
    }
  }

  const int rows_;
  const int columns_;
  const int sizeX_;
  const int sizeY_;
  const int halfX_;
  const bool normalized_;
  const int farthest_;
  Waves forwardX_;
  Waves forwardY_;
  Spectrum now_;
  Spectrum last_;
  Spectrum reference_;
  std::vector<float> crossReal_;
  std::vector<float> crossImaginary_;
  std::vector<float> ofRowsReal_;
  std::vector<float> ofRowsImaginary_;
  std::vector<float> alongReal_;
  std::vector<float> alongImaginary_;
  std::vector<float> waveReal_;
  std::vector<float> waveImaginary_;
};

}  // namespace

std::unique_ptr<TranslationMethod> makePhaseMethod(const MatrixLayout& layout,
                                                   const SlipTrackerOptions& options,
                                                   bool normalized) {
  return std::make_unique<PhaseMethod>(layout, options, normalized);
}

}  // namespace palpate
