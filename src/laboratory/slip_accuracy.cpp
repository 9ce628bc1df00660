#include "palpate/laboratory/slip_accuracy.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include "palpate/core/error.h"
#include "palpate/laboratory/cramer_rao_bound.h"
#include "palpate/slip/slip_detector.h"
#include "palpate/slip/slip_tracker.h"

namespace palpate {
namespace {

// Time between frames [us], for methods that use time stamps.
constexpr std::int64_t kFrameUs = 31'500;
// Number of frames after the first.
constexpr int kFrames = 100;
constexpr int kEdgeFrames = 10;
constexpr double kEdgeTaxels = 1.5;
constexpr int kTiltFrames = 12;
constexpr double kTilt = 0.4;
constexpr int kTiltStays = 12;
constexpr std::size_t kFirstFrames = 10;
constexpr int kBoundEvery = 10;

struct Sums {
  double squares = 0.0;
  double components = 0.0;
  double along = 0.0;
  double steps = 0.0;
  double truthX2 = 0.0, crossX = 0.0, truthY2 = 0.0, crossY = 0.0;
  double drift = 0.0, driftN = 0.0;
  double driftDeg = 0.0, driftDegN = 0.0;
  double deg = 0.0, degN = 0.0;
  double bound = 0.0, boundN = 0.0;
  double boundDeg = 0.0, boundDegN = 0.0;
  double edge = 0.0, edgeN = 0.0;
  double tilt = 0.0, tiltN = 0.0;
  // First frames, later frames.
  std::array<double, 2> squaresOf{}, componentsOf{}, normalised{}, normalisedN{};
  std::array<double, 10> driftAt{}, driftAtN{};
  double worstTiltX = 0.0, worstTiltY = 0.0;
  double ns = 0.0;
  double frames = 0.0;
  int invalid = 0;

  void add(const Sums& o) {
    squares += o.squares, components += o.components, along += o.along, steps += o.steps;
    truthX2 += o.truthX2, crossX += o.crossX, truthY2 += o.truthY2, crossY += o.crossY;
    drift += o.drift, driftN += o.driftN, driftDeg += o.driftDeg, driftDegN += o.driftDegN;
    deg += o.deg, degN += o.degN, bound += o.bound, boundN += o.boundN;
    boundDeg += o.boundDeg, boundDegN += o.boundDegN, edge += o.edge, edgeN += o.edgeN;
    tilt += o.tilt, tiltN += o.tiltN, ns += o.ns, frames += o.frames, invalid += o.invalid;
    for (std::size_t i = 0; i < squaresOf.size(); ++i) {
      squaresOf[i] += o.squaresOf[i], componentsOf[i] += o.componentsOf[i];
      normalised[i] += o.normalised[i], normalisedN[i] += o.normalisedN[i];
    }
    for (std::size_t i = 0; i < driftAt.size(); ++i)
      driftAt[i] += o.driftAt[i], driftAtN[i] += o.driftAtN[i];
    worstTiltX = std::max(worstTiltX, o.worstTiltX);
    worstTiltY = std::max(worstTiltY, o.worstTiltY);
  }
};

double ratio(double sum, double count) { return count > 0.0 ? sum / count : 0.0; }
double root(double sum, double count) { return std::sqrt(ratio(sum, count)); }

SlipAccuracy accuracyOf(const Sums& s) {
  SlipAccuracy a;
  a.rmse = root(s.squares, s.components);
  a.bias = ratio(s.along, s.steps);
  a.gainX = ratio(s.crossX, s.truthX2);
  a.gainY = ratio(s.crossY, s.truthY2);
  a.drift100 = root(s.drift, s.driftN);
  a.driftDeg100 = root(s.driftDeg, s.driftDegN);
  a.rmseDeg = root(s.deg, s.degN);
  a.crb = root(s.bound, s.boundN);
  a.crbDeg = root(s.boundDeg, s.boundDegN);
  a.edge = root(s.edge, s.edgeN);
  a.tilt = root(s.tilt, s.tiltN);
  for (std::size_t i = 0; i < a.drift.size(); ++i) a.drift[i] = root(s.driftAt[i], s.driftAtN[i]);
  a.rmseFirst = root(s.squaresOf[0], s.componentsOf[0]);
  a.rmseLater = root(s.squaresOf[1], s.componentsOf[1]);
  a.normalisedFirst = root(s.normalised[0], s.normalisedN[0]);
  a.normalisedLater = root(s.normalised[1], s.normalisedN[1]);
  a.worstTiltX = s.worstTiltX;
  a.worstTiltY = s.worstTiltY;
  a.invalid = s.invalid;
  a.steps = static_cast<int>(s.steps) + s.invalid;
  a.nsPerStep = ratio(s.ns, s.frames);
  return a;
}

struct Readings {
  std::vector<std::vector<float>> frames;
  std::vector<SyntheticContact> contacts;
};

// Moves the point (x, y) of the first contact to its position on the second one.
void carry(const SyntheticContact& from, const SyntheticContact& to, double& x, double& y) {
  const double turn = (to.angleDeg - from.angleDeg) * std::numbers::pi / 180.0;
  const double px = x - from.x;
  const double py = y - from.y;
  x = to.x + std::cos(turn) * px - std::sin(turn) * py;
  y = to.y + std::sin(turn) * px + std::cos(turn) * py;
}

class Trial {
 public:
  Trial(const SyntheticSensor& sensor, SlipShape shape, std::uint64_t seed)
      : slip_(sensor, seed), random_(seed * 977 + 5), shape_(shape) {}

  Readings wander() {
    const double phaseX = 2.0 * std::numbers::pi * uniform();
    const double phaseY = 2.0 * std::numbers::pi * uniform();
    const double phaseTurn = 2.0 * std::numbers::pi * uniform();
    const double aboutX = 2.4 + 0.2 * uniform() + middleX();
    const double aboutY = 6.2 + 0.6 * uniform() + middleY();
    Readings readings;
    for (int i = 0; i <= kFrames; ++i) {
      SyntheticContact contact;
      contact.shape = shape_;
      contact.x = aboutX + 0.6 * std::sin(0.13 * i + phaseX);
      contact.y = aboutY + 1.2 * std::sin(0.09 * i + phaseY);
      if (hasOrientation(shape_)) contact.angleDeg = 15.0 * std::sin(0.07 * i + phaseTurn);
      read(contact, readings);
    }
    return readings;
  }
  Readings leave() {
    Readings readings;
    SyntheticContact contact;
    contact.shape = shape_;
    contact.y = 6.3 + 0.4 * uniform() + middleY();
    const double from = static_cast<double>(slip_.sensor().layout.columns) - 2.5;
    for (int i = 0; i <= kEdgeFrames; ++i) {
      contact.x = from + kEdgeTaxels * i / kEdgeFrames;
      read(contact, readings);
    }
    return readings;
  }
  Readings tilt() {
    Readings readings;
    SyntheticContact contact;
    contact.shape = shape_;
    contact.x = 2.3 + 0.4 * uniform() + middleX();
    contact.y = 6.3 + 0.4 * uniform() + middleY();
    for (int i = 0; i <= kTiltFrames; ++i) {
      contact.tiltY = kTilt * i / kTiltFrames;
      read(contact, readings);
    }
    return readings;
  }
  Readings tiltAlong(double SyntheticContact::*axis, double tilt) {
    Readings readings;
    SyntheticContact contact;
    contact.shape = shape_;
    contact.x = 2.3 + 0.4 * uniform() + middleX();
    contact.y = 6.3 + 0.4 * uniform() + middleY();
    for (int i = 0; i <= kTiltFrames + kTiltStays; ++i) {
      contact.*axis = tilt * std::min(i, kTiltFrames) / kTiltFrames;
      read(contact, readings);
    }
    return readings;
  }

 private:
  double uniform() { return static_cast<double>(random_() >> 11U) / 9007199254740992.0; }
  // The positions above are for a 14 x 6 matrix; these offsets centre them on the matrix in use.
  double middleX() const { return 0.5 * (slip_.sensor().layout.columns - 6); }
  double middleY() const { return 0.5 * (slip_.sensor().layout.rows - 14); }
  void read(const SyntheticContact& contact, Readings& readings) {
    const MatrixLayout& layout = slip_.sensor().layout;
    std::vector<float> values(layout.numCells());
    slip_.read(contact, MatrixMap(values.data(), layout.rows, layout.columns));
    readings.frames.push_back(std::move(values));
    readings.contacts.push_back(contact);
  }

  SyntheticSlip slip_;
  std::mt19937_64 random_;
  SlipShape shape_;
};

std::vector<SlipMotion> follow(const BenchmarkedMethod& method,
                               const MatrixLayout& layout,
                               const Readings& readings,
                               Sums& sums) {
  const SlipEstimator reader = method.begin(layout);
  std::vector<SlipMotion> motions;
  motions.reserve(readings.frames.size());
  const auto begin = std::chrono::steady_clock::now();
  for (const auto& values : readings.frames)
    motions.push_back(reader(ConstMatrixMap(values.data(), layout.rows, layout.columns)));
  sums.ns +=
      std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
  sums.frames += static_cast<double>(readings.frames.size());
  return motions;
}

// Largest motion since the reference that is read in any frame. The computing time isn't counted.
double largestReading(const BenchmarkedMethod& method,
                      const Readings& readings,
                      const SyntheticSensor& sensor) {
  Sums uncounted;
  double largest = 0.0;
  for (const SlipMotion& motion : follow(method, sensor.layout, readings, uncounted))
    if (motion.refValid) largest = std::max(largest, std::hypot(motion.refDx, motion.refDy));
  return largest;
}

void judgeWandering(const Readings& readings, const std::vector<SlipMotion>& motions, Sums& sums) {
  const SyntheticContact& first = readings.contacts.front();
  const bool turns = hasOrientation(first.shape);
  double lastX = motions.front().x;
  double lastY = motions.front().y;
  const double startX = lastX;
  const double startY = lastY;
  for (std::size_t i = 1; i < motions.size(); ++i) {
    double x = startX;
    double y = startY;
    carry(first, readings.contacts[i], x, y);
    const double trueX = x - lastX;
    const double trueY = y - lastY;
    lastX = x;
    lastY = y;
    const SlipMotion& motion = motions[i];
    if (i % 10 == 0 && i / 10 <= sums.driftAt.size() && motion.refValid) {
      sums.driftAt[i / 10 - 1] +=
          std::pow(motion.refDx - (x - startX), 2) + std::pow(motion.refDy - (y - startY), 2);
      sums.driftAtN[i / 10 - 1] += 2.0;
    }
    if (!motion.valid) {
      ++sums.invalid;
      continue;
    }
    const double offX = motion.dx - trueX;
    const double offY = motion.dy - trueY;
    sums.squares += offX * offX + offY * offY;
    sums.components += 2.0;
    const std::size_t part = i <= kFirstFrames ? 0 : 1;
    sums.squaresOf[part] += offX * offX + offY * offY;
    sums.componentsOf[part] += 2.0;
    if (motion.sdX > 0.0 && motion.sdY > 0.0) {
      sums.normalised[part] += std::pow(offX / motion.sdX, 2) + std::pow(offY / motion.sdY, 2);
      sums.normalisedN[part] += 2.0;
    }
    const double length = std::hypot(trueX, trueY);
    if (length > 0.0) sums.along += (offX * trueX + offY * trueY) / length;
    sums.steps += 1.0;
    sums.truthX2 += trueX * trueX;
    sums.crossX += trueX * motion.dx;
    sums.truthY2 += trueY * trueY;
    sums.crossY += trueY * motion.dy;
    if (turns && motion.rotation.valid) {
      const double off = motion.rotation.rotationDeg -
                         (readings.contacts[i].angleDeg - readings.contacts[i - 1].angleDeg);
      sums.deg += off * off;
      sums.degN += 1.0;
    }
  }
  const SlipMotion& end = motions.back();
  if (end.refValid) {
    sums.drift +=
        std::pow(end.refDx - (lastX - startX), 2) + std::pow(end.refDy - (lastY - startY), 2);
    sums.driftN += 2.0;
  }
  if (turns && end.rotation.refValid) {
    sums.driftDeg += std::pow(
        end.rotation.refRotationDeg - (readings.contacts.back().angleDeg - first.angleDeg), 2);
    sums.driftDegN += 1.0;
  }
}

void addBounds(const Readings& readings, const SyntheticSensor& sensor, Sums& sums) {
  for (std::size_t i = 0; i < readings.contacts.size(); i += kBoundEvery) {
    const CramerRaoBound bound = cramerRaoBound(readings.contacts[i], sensor);
    sums.bound += bound.x * bound.x + bound.y * bound.y;
    sums.boundN += 2.0;
    if (std::isfinite(bound.angleDeg)) {
      sums.boundDeg += bound.angleDeg * bound.angleDeg;
      sums.boundDegN += 1.0;
    }
  }
}

}  // namespace

void SlipAccuracyOptions::validate() const {
  SyntheticSensor noisy = sensor;
  noisy.noiseSd = noiseSd;
  noisy.validate();
  constexpr OptionCheck check{"SlipAccuracyOptions"};
  check(kNoiseSd, "noiseSd", noiseSd);
  check(kTrials, "trials", trials);
}

namespace {

SlipEstimator beginHypothesisMethod(const MatrixLayout& layout) {
  SlipDetectorOptions options;
  options.reference = SlipReference::kFirst;
  auto detector = std::make_shared<SlipDetector>(layout, options);
  return [detector, timeUs = std::int64_t{0}](const ConstMatrixMap& frame) mutable {
    timeUs += kFrameUs;
    return detector->update(frame, timeUs).motion;
  };
}

}  // namespace

std::vector<BenchmarkedMethod> benchmarkedMethods() {
  std::vector<BenchmarkedMethod> methods;
  for (const SlipMethod method : slipMethods()) {
    if (method == SlipMethod::kContest) {
      methods.push_back({std::string(nameOf(method)), &beginHypothesisMethod});
      continue;
    }
    methods.push_back({std::string(nameOf(method)), [method](const MatrixLayout& layout) {
                         SlipTrackerOptions options;
                         options.method = method;
                         auto tracker = std::make_shared<SlipTracker>(layout, options);
                         return [tracker](const ConstMatrixMap& frame) {
                           return tracker->update(frame);
                         };
                       }});
  }
  return methods;
}

std::vector<MethodAccuracy> measureSlipAccuracy(const std::vector<BenchmarkedMethod>& methods,
                                                const SlipAccuracyOptions& options,
                                                const Progress& progress) {
  options.validate();
  SyntheticSensor sensor = options.sensor;
  sensor.noiseSd = options.noiseSd;
  std::vector<SlipShape> shapes = options.shapes;
  if (shapes.empty()) shapes.assign(slipShapes().begin(), slipShapes().end());

  std::vector<MethodAccuracy> results(methods.size());
  std::vector<Sums> all(methods.size());
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    std::vector<Sums> ofShape(methods.size());
    for (int trial = 0; trial < options.trials; ++trial) {
      const double done = static_cast<double>(s) + static_cast<double>(trial) / options.trials;
      if (progress && !progress(done / static_cast<double>(shapes.size()))) throw Cancelled();
      Trial truth(sensor,
                  shapes[s],
                  options.seed * 1'000'003 + static_cast<std::uint64_t>(trial) * 101 +
                      static_cast<std::uint64_t>(shapes[s]));
      const Readings wandering = truth.wander();
      const Readings leaving = truth.leave();
      const Readings tilting = truth.tilt();
      std::vector<Readings> tiltsX;
      std::vector<Readings> tiltsY;
      for (const double tilt : {kTilt, -kTilt}) {
        tiltsX.push_back(truth.tiltAlong(&SyntheticContact::tiltX, tilt));
        tiltsY.push_back(truth.tiltAlong(&SyntheticContact::tiltY, tilt));
      }
      Sums bounds;
      addBounds(wandering, sensor, bounds);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        Sums& sums = ofShape[m];
        sums.add(bounds);
        judgeWandering(wandering, follow(methods[m], sensor.layout, wandering, sums), sums);
        const SlipMotion left = follow(methods[m], sensor.layout, leaving, sums).back();
        sums.edge += std::pow((left.refValid ? left.refDx : 0.0) - kEdgeTaxels, 2);
        sums.edgeN += 1.0;
        const SlipMotion tilted = follow(methods[m], sensor.layout, tilting, sums).back();
        sums.tilt += std::pow(tilted.refDx, 2) + std::pow(tilted.refDy, 2);
        sums.tiltN += 1.0;
        for (const Readings& one : tiltsX)
          sums.worstTiltX = std::max(sums.worstTiltX, largestReading(methods[m], one, sensor));
        for (const Readings& one : tiltsY)
          sums.worstTiltY = std::max(sums.worstTiltY, largestReading(methods[m], one, sensor));
      }
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
      results[m].shapes.push_back({shapes[s], accuracyOf(ofShape[m])});
      all[m].add(ofShape[m]);
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    results[m].name = methods[m].name;
    results[m].all = accuracyOf(all[m]);
  }
  return results;
}

}  // namespace palpate
