#include "palpate/emulator/synthetic_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/profile_builder.h"

namespace palpate {
namespace {

// Largest counts seen on a real taxel: the sensor saturates gradually and never reaches full scale.
constexpr double kHighestCounts = 3560.0;
constexpr double kGraspFraction = 0.62;  // fraction of a grasp's time with contact
constexpr double kCloseFraction = 0.25;  // fraction of the contact: force rises
constexpr double kOpenFraction = 0.12;   // fraction of the contact: force falls

// A pinch: a fingertip and the opposite one carry the load, unequally and slightly off centre.
struct Contact {
  std::size_t matrix;
  double share;    // of peakCounts
  double centreX;  // [taxels]
  double centreY;
  // Distance that the contact creeps while it is held [taxels].
  double driftY;
};
constexpr std::array<Contact, 2> kContacts{{{1, 1.0, 2.7, 8.1, 0.5}, {5, 0.62, 2.2, 7.4, -0.4}}};

// Joint angles of the hand open and closed on the object [deg] (parallel pinch, thumb out of the
// way).
constexpr std::array<double, 7> kOpenDeg{90.0, -35.0, 35.0, -90.0, 0.0, -35.0, 35.0};
constexpr std::array<double, 7> kClosedDeg{90.0, -14.0, 14.0, -90.0, 0.0, -14.0, 14.0};
// Motors, FPGA, circuit board, shortly after power-up [deg C], and their rise per minute of work.
constexpr std::array<double, 9> kStartDegC{35.5, 35.0, 31.25, 35.25, 31.5, 34.5, 32.0, 44.5, 44.25};
constexpr double kWarmingDegCPerMinute = 0.5;

double smoothStep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// State within a grasp cycle: force and closing, both 0..1.
struct Phase {
  double force = 0.0;
  double closing = 0.0;
  double held = 0.0;  // 0 at first contact .. 1 at release
};

Phase phaseAt(double timeS, const SyntheticOptions& options) {
  Phase phase;
  if (options.grasps == 0) return phase;
  const double share = options.durationS / options.grasps;
  const double inCycle = std::fmod(timeS, share) / share;  // 0..1
  const double begin = 0.5 * (1.0 - kGraspFraction);
  const double end = begin + kGraspFraction;
  phase.closing = smoothStep(inCycle / begin) - smoothStep((inCycle - end) / begin);
  const double contact = (inCycle - begin) / kGraspFraction;
  if (contact <= 0.0 || contact >= 1.0) return phase;
  phase.held = contact;
  // The force rises, creeps up a little (foam), and falls.
  phase.force = smoothStep(contact / kCloseFraction) * (0.93 + 0.07 * contact) *
                (1.0 - smoothStep((contact - 1.0 + kOpenFraction) / kOpenFraction));
  return phase;
}

double saturated(double counts) { return kHighestCounts * std::tanh(counts / kHighestCounts); }

class SyntheticProfileGenerator {
 public:
  explicit SyntheticProfileGenerator(const SyntheticOptions& options)
      : options_(options), layout_(sdh2().layout), random_(options.seed) {}

  TactileFrame frameAt(double timeS) {
    TactileFrame frame(layout_);
    const Phase phase = phaseAt(timeS, options_);
    if (phase.force <= 0.0) return frame;
    for (const Contact& contact : kContacts) press(contact, phase, frame);
    return frame;
  }

 private:
  // A Gaussian pressure patch, threshold subtracted, whole counts.
  void press(const Contact& contact, const Phase& phase, TactileFrame& frame) {
    const MatrixLayout& layout = layout_->matrix(contact.matrix);
    auto values = frame.matrix(contact.matrix);
    // A larger force also widens the contact area.
    const double radius = options_.contactRadiusTaxels * (0.6 + 0.4 * phase.force);
    const double centreY = contact.centreY + contact.driftY * phase.held;
    for (int y = 0; y < layout.rows; ++y) {
      for (int x = 0; x < layout.columns; ++x) {
        if (!layout.enabled(y, x)) continue;
        const double dx = (x - contact.centreX) / radius;
        const double dy = (y - centreY) / radius;
        double counts = (options_.peakCounts + options_.thresholdCounts) * contact.share *
                        phase.force * std::exp(-0.5 * (dx * dx + dy * dy));
        counts = saturated(counts) - options_.thresholdCounts;
        if (counts <= 0.0) continue;
        counts = std::max(0.0, counts + options_.noiseCounts * gaussian());
        values(y, x) = static_cast<float>(std::min(std::round(counts), kHighestCounts));
      }
    }
  }

  // Box-Muller, from the engine's own bits: std::normal_distribution differs between libraries.
  double gaussian() {
    const double u = (random_() + 1.0) / 4294967296.0;  // (0, 1]
    const double v = random_() / 4294967296.0;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

  const SyntheticOptions& options_;
  std::shared_ptr<const SensorLayout> layout_;
  std::mt19937 random_;
};

// Calls add(hostUs, timeS) at every sample of a stream.
template <typename Add>
void sampleStream(const SyntheticOptions& options, double rateHz, Add add) {
  if (rateHz <= 0.0) return;
  const auto count = static_cast<std::int64_t>(std::floor(options.durationS * rateHz)) + 1;
  for (std::int64_t i = 0; i < count; ++i) {
    const double timeS = static_cast<double>(i) / rateHz;
    // Whole milliseconds, as recordings have them.
    const auto ms = static_cast<std::int64_t>(std::llround(timeS * 1e3));
    add(options.startUs + ms * 1000, timeS);
  }
}

}  // namespace

void SyntheticOptions::validate() const {
  constexpr OptionCheck check{"SyntheticOptions"};
  check(kDurationS, "durationS", durationS);
  check(kRateHz, "rateHz", rateHz);
  check(OptionRange{0.0, 1000.0}, "angleRateHz", angleRateHz);
  check(OptionRange{0.0, 100.0}, "temperatureRateHz", temperatureRateHz);
  check(kGrasps, "grasps", grasps);
  check(kPeakCounts, "peakCounts", peakCounts);
  check(OptionRange{0.5, 5.0}, "contactRadiusTaxels", contactRadiusTaxels);
  check(OptionRange{0.0, 4095.0}, "thresholdCounts", thresholdCounts);
  check(kNoiseCounts, "noiseCounts", noiseCounts);
  // With fewer frames per grasp, grasps could be lost between frames.
  constexpr double kFewestFrames = 12.0;
  if (grasps * kFewestFrames > durationS * rateHz)
    throw std::invalid_argument("synthetic recording: " + std::to_string(grasps) +
                                " grasps do not fit into " +
                                std::to_string(static_cast<long>(durationS * rateHz)) + " frames");
}

Profile synthesize(const SyntheticOptions& options, SyntheticTruth* truth) {
  options.validate();
  SyntheticProfileGenerator generator(options);
  ProfileBuilder builder(sdh2().layout);
  std::vector<SyntheticGrasp> grasps;
  bool touching = false;
  sampleStream(options, options.rateHz, [&](std::int64_t hostUs, double timeS) {
    const TactileFrame frame = generator.frameAt(timeS);
    const std::size_t index = builder.numFrames();
    const bool touches = std::any_of(
        frame.values.begin(), frame.values.end(), [](float value) { return isTouched(value); });
    if (touches && !touching) grasps.push_back({index, index});
    if (touches) grasps.back().end = index;
    touching = touches;
    builder.addFrame(hostUs, frame.values);
  });
  sampleStream(options, options.angleRateHz, [&](std::int64_t hostUs, double timeS) {
    const double closing = phaseAt(timeS, options).closing;
    std::array<double, kOpenDeg.size()> deg{};
    for (std::size_t i = 0; i < deg.size(); ++i)
      deg[i] = kOpenDeg[i] + closing * (kClosedDeg[i] - kOpenDeg[i]);
    builder.addAngles(hostUs, deg);
  });
  sampleStream(options, options.temperatureRateHz, [&](std::int64_t hostUs, double timeS) {
    std::array<double, kStartDegC.size()> degC{};
    for (std::size_t i = 0; i < degC.size(); ++i) {
      const double warm = kStartDegC[i] + kWarmingDegCPerMinute * timeS / 60.0;
      degC[i] = std::round(warm * 8.0) / 8.0;  // resolution of the sensors
    }
    builder.addTemperatures(hostUs, degC);
  });
  if (truth) truth->grasps = std::move(grasps);
  ProfileInfo info;
  info.format = "synthetic";
  return builder.finish(std::move(info));
}

}  // namespace palpate
