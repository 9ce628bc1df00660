#include "palpate/emulator/noisy_contacts.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "palpate/emulator/assumed_characteristics.h"
#include "palpate/emulator/sensor_model.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

namespace palpate {
namespace {

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;
constexpr double kFaintCounts = 0.5;
constexpr double kNoisyContactsMaxCounts = 4095.0;
// Phases of a contact: the load rises, holds, falls; then a rest follows.
constexpr double kComesS = 0.4, kHoldsS = 1.2, kGoesS = 0.3, kRestsS = 1.1;
constexpr double kContactS = kComesS + kHoldsS + kGoesS + kRestsS;

// Fraction of the full load at a time since the contact began.
double loadAt(double timeS) {
  if (timeS < kComesS) return timeS / kComesS;
  timeS -= kComesS + kHoldsS;
  if (timeS < 0.0) return 1.0;
  return std::max(0.0, 1.0 - timeS / kGoesS);
}

// Pressure of a contact relative to its peak, at a distance from its centre [taxels] along its own
// axes.
double pressureShare(ContactSize size, double along, double across, double radius) {
  switch (size) {
    case ContactSize::kPoint:
    case ContactSize::kPair:
      // A tip narrower than a taxel: its share on each of the taxels below it.
      return std::max(0.0, 1.0 - std::abs(along)) * std::max(0.0, 1.0 - std::abs(across));
    case ContactSize::kPen:
      return std::clamp(radius + 0.5 - std::abs(along), 0.0, 1.0) *
             std::max(0.0, 1.0 - std::abs(across));
    case ContactSize::kBall: {  // Hertz
      const double r2 = (along * along + across * across) / (radius * radius);
      return r2 < 1.0 ? std::sqrt(1.0 - r2) : 0.0;
    }
    case ContactSize::kBroad:
      break;
  }
  return std::clamp(radius + 0.5 - std::abs(along), 0.0, 1.0) *
         std::clamp(2.0 / 3.0 * radius + 0.5 - std::abs(across), 0.0, 1.0);
}

// Whether a contact can be placed on a matrix: off its sides, on two taxels of one column.
bool hasPlaceForContact(const MatrixLayout& matrix) {
  for (int y = 1; y < matrix.rows - 1; ++y)
    for (int x = 1; x < matrix.columns - 1; ++x)
      if (matrix.exists(y, x) && matrix.exists(y + 1, x)) return true;
  return false;
}

class NoisyContactsGenerator {
 public:
  explicit NoisyContactsGenerator(const NoisyContactsOptions& options)
      : options_(options),
        layout_(*options_.hand.layout),
        characteristics_(characteristicsIn(options_.hand)),
        noisy_(options_.hand, characteristics_, options.seed),
        quiet_(options_.hand, withoutNoise(characteristics_)),
        random_(options.seed),
        full_(layout_.numCells()),
        pressure_(layout_.numCells()),
        degC_(layout_.numMatrices(), options.degC),
        counts_(layout_.numCells()) {
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      const int threshold = noiseThresholdCounts(
          characteristics_.matrices[m], options.degC, options.noiseMultiple, options.belowCounts);
      thresholds_.push_back(threshold);
      for (SensorModel* sensor : {&noisy_, &quiet_}) {
        sensor->settings()[m].sensitivity = options.sensitivity;
        sensor->settings()[m].thresholdCounts = threshold;
      }
    }
    restCounts_.resize(layout_.numCells());
    quiet_.scan(degC_, options.degC, restCounts_);
  }

  NoisyContacts run() {
    ProfileBuilder builder(options_.hand);
    std::vector<CellTruthMask> truth;
    std::vector<float> values(layout_.numCells());
    for (std::size_t i = 0; i < options_.frames; ++i) {
      load(i);
      noisy_.advance(pressure_, 1.0 / options_.rateHz);
      quiet_.advance(pressure_, 1.0 / options_.rateHz);
      noisy_.scan(degC_, options_.degC, counts_);
      std::copy(counts_.begin(), counts_.end(), values.begin());
      builder.addFrame(timeUs(static_cast<double>(i) / options_.rateHz), values);
      truth.push_back(truthNow());
    }
    const std::vector<double> temperatures(options_.hand.temperatureSensors.size(), options_.degC);
    for (double s = 0.0; s * options_.rateHz < static_cast<double>(options_.frames); s += 1.0)
      if (!temperatures.empty()) builder.addTemperatures(timeUs(s), temperatures);
    ProfileInfo info;
    info.format = "synthetic";
    return {builder.finish(std::move(info)), std::move(truth), std::move(contacts_), thresholds_};
  }

 private:
  static SensorCharacteristics characteristicsIn(const HandDescription& hand) {
    return hand.file && hand.file->characteristics ? *hand.file->characteristics
                                                   : assumedCharacteristics(hand);
  }
  static SensorCharacteristics withoutNoise(SensorCharacteristics sensor) {
    for (MatrixCharacteristics& matrix : sensor.matrices) {
      matrix.taxelSd = matrix.sharedSd = 0.0;
      for (OffsetTaxel& taxel : matrix.raised) taxel.sd = 0.0;
    }
    return sensor;
  }
  static std::int64_t timeUs(double s) { return kStartUs + std::llround(s * 1e6); }

  double draw(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  // Pressure of the contact in a frame, before the effect of the rubber.
  void load(std::size_t frame) {
    if (!options_.contacts) return;
    // The sequence begins with a rest.
    const double timeS = static_cast<double>(frame) / options_.rateHz - kRestsS;
    if (timeS < 0.0) return;
    const auto index = static_cast<std::size_t>(timeS / kContactS);
    if (index >= contacts_.size()) begin(index, frame);
    contacts_.back().end = frame + 1;
    const double share = loadAt(timeS - static_cast<double>(index) * kContactS);
    for (std::size_t i = 0; i < full_.size(); ++i) pressure_[i] = share * full_[i];
  }

  void begin(std::size_t index, std::size_t frame) {
    NoisyContact contact;
    contact.size = kAllContactSizes[index % kAllContactSizes.size()];
    // Every size occurs on every matrix.
    contact.matrix =
        (index / kAllContactSizes.size() + index % kAllContactSizes.size()) % layout_.numMatrices();
    contact.begin = frame;
    contact.peakKpa = std::exp(draw(std::log(options_.minKpa), std::log(options_.maxKpa)));
    contacts_.push_back(contact);
    place(contact);
    spreadPressure(layout_, characteristics_.neighbourFraction, full_);
  }

  // Places the contact at a random position and rotation on the matrix.
  void place(const NoisyContact& contact) {
    std::fill(full_.begin(), full_.end(), 0.0);
    const MatrixLayout& matrix = layout_.matrix(contact.matrix);
    double y = 0.0, x = 0.0;
    // Repeated, because a few places of a matrix have no taxel.
    do {
      y = std::floor(draw(1.0, matrix.rows - 1.0));
      x = std::floor(draw(1.0, matrix.columns - 1.0));
    } while (!matrix.exists(static_cast<int>(y), static_cast<int>(x)) ||
             !matrix.exists(static_cast<int>(y) + 1, static_cast<int>(x)));
    double angle = 0.0, radius = 0.0;
    switch (contact.size) {
      case ContactSize::kPoint:
        y += draw(-0.1, 0.1);
        x += draw(-0.1, 0.1);
        break;
      case ContactSize::kPair:
        y += 0.5;
        break;
      case ContactSize::kPen:
        angle = draw(0.0, 3.14159265358979);
        radius = draw(2.0, 3.0);
        break;
      case ContactSize::kBall:
        radius = draw(2.0, 3.0);
        break;
      case ContactSize::kBroad:
        angle = draw(0.0, 3.14159265358979);
        radius = 3.0;
        break;
    }
    for (int row = 0; row < matrix.rows; ++row)
      for (int column = 0; column < matrix.columns; ++column) {
        if (!matrix.exists(row, column)) continue;
        const double dy = row - y, dx = column - x;
        const double along = std::cos(angle) * dy + std::sin(angle) * dx;
        const double across = std::cos(angle) * dx - std::sin(angle) * dy;
        full_[layout_.offset(contact.matrix) +
              static_cast<std::size_t>(row * matrix.columns + column)] =
            contact.peakKpa * pressureShare(contact.size, along, across, radius);
      }
  }

  CellTruthMask truthNow() {
    CellTruthMask truth(layout_.numCells(), CellTruth::kNothing);
    quiet_.scan(degC_, options_.degC, counts_);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double kpa = quiet_.responseKpa(i);
      if (counts_[i] > restCounts_[i])
        truth[i] = CellTruth::kTouched;
      else if (kpa > 0.0 &&
               options_.sensitivity * characteristics_.countsAbove(kpa, options_.degC) >=
                   kFaintCounts)
        truth[i] = CellTruth::kFaint;
    }
    return truth;
  }

  const NoisyContactsOptions options_;
  const SensorLayout& layout_;
  const SensorCharacteristics characteristics_;
  SensorModel noisy_;
  SensorModel quiet_;  // the same without noise
  std::mt19937_64 random_;
  // Per place [kPa]: pressure of the contact at full load, and now.
  std::vector<double> full_, pressure_;
  std::vector<double> degC_;
  std::vector<std::uint16_t> counts_, restCounts_;
  std::vector<int> thresholds_;
  std::vector<NoisyContact> contacts_;
};

}  // namespace

std::string_view nameOf(ContactSize size) {
  switch (size) {
    case ContactSize::kPoint:
      return "point";
    case ContactSize::kPair:
      return "pair";
    case ContactSize::kPen:
      return "pen";
    case ContactSize::kBall:
      return "ball";
    case ContactSize::kBroad:
      break;
  }
  return "broad";
}

void NoisyContactsOptions::validate() const {
  constexpr OptionCheck check{"NoisyContactsOptions"};
  check(kFrames, "frames", static_cast<double>(frames));
  check(OptionRange{1.0, 1000.0}, "rateHz", rateHz);
  check(kDegC, "degC", degC);
  check(OptionRange{0.0, 1.0}, "sensitivity", sensitivity);
  check(OptionRange{-20.0, 20.0}, "noiseMultiple", noiseMultiple);
  check(kBelowCounts, "belowCounts", belowCounts);
  check(OptionRange{1e-3, 1e3}, "minKpa", minKpa);
  check(OptionRange{minKpa, 1e3}, "maxKpa", maxKpa);
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
    if (!hasPlaceForContact(hand.layout->matrix(m)))
      throw std::invalid_argument("noisy contacts: " + hand.matrixName(m) +
                                  " is too small for the contacts");
}

NoisyContacts makeNoisyContacts(const NoisyContactsOptions& options) {
  options.validate();
  return NoisyContactsGenerator(options).run();
}

int noiseThresholdCounts(const MatrixCharacteristics& matrix,
                         double degC,
                         double noiseMultiple,
                         double belowCounts) {
  const double theta =
      matrix.noiseIntercept + matrix.noiseSlope * degC + noiseMultiple * matrix.noiseRmse;
  return static_cast<int>(
      std::lround(std::clamp(theta - belowCounts, 0.0, kNoisyContactsMaxCounts)));
}

}  // namespace palpate
