#include "palpate/recognition/grasp_segments.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"
#include "palpate/model/hand_file.h"

namespace palpate {
namespace {

constexpr std::size_t kFramesPerReport = 512;
// Fraction of the frames in which a finger must touch to be one of the fingers of the grasp.
constexpr double kFingerShare = 0.5;
// Factor on the quality for each end that is not inside the recording.
constexpr double kEndOutside = 0.5;

// Contact in one frame.
struct FrameContact {
  // Whether the frame is in contact by the rule.
  bool contact = false;
  bool saturated = false;
  // Sum of all taxels [counts].
  double sum = 0.0;
};

// The fingers of a hand, and the finger of each matrix.
struct Fingers {
  // Finger numbers, ascending.
  std::vector<int> numbers;
  // Index into `numbers`, per matrix.
  std::vector<std::size_t> ofMatrix;

  explicit Fingers(const HandDescription& hand) {
    const std::size_t matrices = hand.layout->numMatrices();
    const auto numberOf = [&](std::size_t m) {
      return m < hand.matrices.size() ? hand.matrices[m].finger : static_cast<int>(m);
    };
    for (std::size_t m = 0; m < matrices; ++m) numbers.push_back(numberOf(m));
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (std::size_t m = 0; m < matrices; ++m)
      ofMatrix.push_back(static_cast<std::size_t>(
          std::lower_bound(numbers.begin(), numbers.end(), numberOf(m)) - numbers.begin()));
  }
};

// Contact of one matrix in one frame.
struct MatrixContact {
  bool active = false;
  double maximum = 0.0;  // [counts]
  double sum = 0.0;      // [counts]
};

std::vector<std::size_t> pinchingPads(const HandDescription& hand) {
  if (!hand.file || !hand.file->pinch)
    throw Error("the description of '" + shortened(hand.name) + "' names no two pads that pinch");
  return {hand.file->pinch->pads[0], hand.file->pinch->pads[1]};
}

MatrixContact contactOf(const ConstMatrixMap& values) {
  MatrixContact contact;
  const float* const end = values.data() + values.size();
  for (const float* value = values.data(); value != end; ++value) {
    if (!isTouched(*value)) continue;
    contact.active = true;
    contact.sum += static_cast<double>(*value);
    contact.maximum = std::max(contact.maximum, static_cast<double>(*value));
  }
  return contact;
}

class Finder {
 public:
  Finder(const Profile& profile, const GraspSegmentOptions& options)
      : profile_(profile), options_(options), fingers_(profile.hand()) {
    options_.validate();
    options_.minFingers = std::min(options_.minFingers, fingers_.numbers.size());
    if (options_.rule == GraspRule::kStudy && options_.studyMatrices.empty())
      options_.studyMatrices = pinchingPads(profile.hand());
    frames_.reserve(profile.numFrames());
    touches_.reserve(profile.numFrames() * fingers_.numbers.size());
  }

  // Adds the next frame, with the contact of each matrix.
  void add(const std::vector<MatrixContact>& matrices) {
    FrameContact frame;
    // First entry of this frame.
    const std::size_t first = touches_.size();
    touches_.resize(first + fingers_.numbers.size());
    std::size_t touching = 0;
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      if (!matrices[m].active) continue;
      auto touches = touches_[first + fingers_.ofMatrix[m]];
      if (!touches) ++touching;
      touches = true;
      frame.sum += matrices[m].sum;
      frame.saturated = frame.saturated ||
                        matrices[m].maximum >= static_cast<double>(profile_.hand().saturationOf(m));
    }
    if (options_.rule == GraspRule::kStudy)
      frame.contact = std::all_of(
          options_.studyMatrices.begin(), options_.studyMatrices.end(), [&](std::size_t m) {
            return m < matrices.size() && matrices[m].active;
          });
    else
      frame.contact = touching >= options_.minFingers;
    frames_.push_back(frame);
  }

  std::vector<GraspSegment> finish(const TimingReport& timing) const {
    std::vector<GraspSegment> segments;
    // First frame of a part without gaps.
    std::size_t from = 0;
    for (std::size_t g = 0; g <= timing.gaps.size(); ++g) {
      const std::size_t to = g < timing.gaps.size() ? timing.gaps[g].frame + 1 : frames_.size();
      findIn(from, std::min(to, frames_.size()), segments);
      from = to;
    }
    return segments;
  }

 private:
  // Finds grasps in frames from..to-1, between two gaps.
  void findIn(std::size_t from, std::size_t to, std::vector<GraspSegment>& segments) const {
    const std::size_t bridged = options_.rule == GraspRule::kStudy ? 0 : options_.bridgedFrames;
    for (std::size_t i = from; i < to;) {
      if (!frames_[i].contact) {
        ++i;
        continue;
      }
      const std::size_t begin = i;
      std::size_t end = i;
      for (++i; i < to && i - end <= bridged + 1; ++i)
        if (frames_[i].contact) end = i;
      i = end + 1;
      if (longEnough(begin, end)) segments.push_back(segment(begin, end, from, to));
    }
  }

  bool longEnough(std::size_t begin, std::size_t end) const {
    if (end - begin + 1 <= options_.moreThanFrames) return false;
    if (options_.rule == GraspRule::kStudy) return true;
    const auto lastsUs =
        static_cast<double>(profile_.frameTimeUs(end) - profile_.frameTimeUs(begin));
    return lastsUs > options_.moreThanS * kUsPerS;
  }

  GraspSegment segment(std::size_t begin, std::size_t end, std::size_t from, std::size_t to) const {
    GraspSegment found{.begin = begin, .end = end, .fingers = {}};
    const auto count = static_cast<double>(end - begin + 1);
    std::size_t touching = 0;
    std::size_t saturated = 0;
    // Number of frames with contact, per finger.
    std::vector<std::pair<std::size_t, int>> times;
    for (const int number : fingers_.numbers) times.emplace_back(0, number);
    for (std::size_t i = begin; i <= end; ++i) {
      touching += frames_[i].contact ? 1 : 0;
      saturated += frames_[i].saturated ? 1 : 0;
      for (std::size_t f = 0; f < times.size(); ++f)
        times[f].first += touches_[i * times.size() + f] ? 1 : 0;
    }
    std::stable_sort(
        times.begin(), times.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    const std::size_t least = options_.rule == GraspRule::kStudy ? 0 : options_.minFingers;
    for (const auto& [framesTouched, number] : times)
      if (static_cast<double>(framesTouched) >= kFingerShare * count ||
          found.fingers.size() < least)
        found.fingers.push_back(number);
    std::sort(found.fingers.begin(), found.fingers.end());
    found.quality = static_cast<double>(touching) / count *
                    (1.0 - static_cast<double>(saturated) / count) * steadiness(begin, end);
    if (begin == from) found.quality *= kEndOutside;
    if (end + 1 == to) found.quality *= kEndOutside;
    return found;
  }

  double steadiness(std::size_t begin, std::size_t end) const {
    const std::size_t quarter = (end - begin + 1) / 4;
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t i = begin + quarter; i <= end - quarter; ++i) {
      sum += frames_[i].sum;
      squares += frames_[i].sum * frames_[i].sum;
      count += 1.0;
    }
    const double mean = sum / count;
    if (!(mean > 0.0)) return 0.0;
    const double sd = std::sqrt(std::max(0.0, squares / count - mean * mean));
    return 1.0 - std::min(1.0, sd / mean);
  }

  const Profile& profile_;
  GraspSegmentOptions options_;
  Fingers fingers_;
  std::vector<FrameContact> frames_;
  // Whether a finger touches: for each frame all fingers.
  std::vector<bool> touches_;
};

}  // namespace

void GraspSegmentOptions::validate() const {
  if (minFingers < 1 || minFingers > 8)
    throw std::invalid_argument("GraspSegmentOptions: minFingers must be 1..8, is " +
                                std::to_string(minFingers));
  if (!(moreThanS >= 0.0))
    throw std::invalid_argument("GraspSegmentOptions: moreThanS must be 0 or more, is " +
                                std::to_string(moreThanS));
}

std::vector<GraspSegment> findGrasps(const Profile& profile,
                                     const GraspSegmentOptions& options,
                                     const Progress& progress) {
  Finder finder(profile, options);
  const std::size_t frames = profile.numFrames();
  std::vector<std::int64_t> stampsUs;
  stampsUs.reserve(frames);
  std::vector<MatrixContact> matrices(profile.layout().numMatrices());
  TactileFrame frame;
  for (std::size_t i = 0; i < frames; ++i) {
    reportProgress(progress, i, frames, kFramesPerReport);
    profile.readFrame(i, frame);
    stampsUs.push_back(frame.hostUs);
    const TactileFrame& values = frame;
    for (std::size_t m = 0; m < matrices.size(); ++m) matrices[m] = contactOf(values.matrix(m));
    finder.add(matrices);
  }
  return finder.finish(timingOf(stampsUs));
}

std::vector<GraspSegment> findGrasps(const Profile& profile,
                                     const SignalTable& table,
                                     const TimingReport& timing,
                                     const GraspSegmentOptions& options) {
  if (table.numFrames() != profile.numFrames() ||
      (table.numFrames() > 0 && table.numMatrices() != profile.layout().numMatrices()))
    throw std::invalid_argument("findGrasps: a table of " + std::to_string(table.numFrames()) +
                                " frames of " + std::to_string(table.numMatrices()) +
                                " matrices for a profile of " +
                                std::to_string(profile.numFrames()) + " of " +
                                std::to_string(profile.layout().numMatrices()));
  Finder finder(profile, options);
  std::vector<MatrixContact> matrices(table.numMatrices());
  for (std::size_t i = 0; i < table.numFrames(); ++i) {
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      const CharacteristicSignals& known = table.at(i, m);
      matrices[m] = {known.active > 0, known.maximum, known.sum};
    }
    finder.add(matrices);
  }
  return finder.finish(timing);
}

std::unique_ptr<ResultTable> graspTable(const Profile& profile,
                                        const GraspSegmentOptions& options,
                                        const Progress& progress) {
  using Grasp = GraspSegment;
  return std::make_unique<RowTable<Grasp>>(
      "grasps",
      std::vector<ColumnOf<Grasp>>{
          columnOf<Grasp>("begin", "", "first frame", &Grasp::begin),
          columnOf<Grasp>("end", "", "last frame", &Grasp::end),
          columnOf<Grasp>(
              "begin_ms",
              "ms",
              "host time of the first frame, since 1970",
              [profile](const Grasp& g) { return profile.frameTimeUs(g.begin) / kUsPerMs; }),
          columnOf<Grasp>(
              "end_ms",
              "ms",
              "host time of the last frame, since 1970",
              [profile](const Grasp& g) { return profile.frameTimeUs(g.end) / kUsPerMs; }),
          columnOf<Grasp>("fingers",
                          "",
                          "fingers that touch in at least half of its frames",
                          [](const Grasp& g) {
                            std::string fingers;
                            for (const int finger : g.fingers)
                              fingers += (fingers.empty() ? "" : " ") + std::to_string(finger);
                            return fingers;
                          }),
          columnOf<Grasp>("quality", "", "0 to 1", &Grasp::quality)},
      findGrasps(profile, options, progress));
}

}  // namespace palpate
