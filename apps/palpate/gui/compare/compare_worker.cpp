#include "gui/compare/compare_worker.h"

#include <algorithm>
#include <cmath>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/signals/frame_difference.h>

namespace palpate::gui {
namespace {

constexpr std::size_t kCompareWorkerMostKept = 12;  // numbers of recordings and of curves
constexpr std::size_t kPairsLookedAt = 4000;        // of a long recording: for the colour range

// Shares of the whole work.
constexpr double kTimedShare = 0.2;
constexpr double kCurveShare = 0.3;

// Number of frames of A within the common span.
std::size_t framesInCommon(const TimedProfile& a, const TimedProfile& b, double offsetS) {
  const auto span = commonSpan(a, b, offsetS);
  if (!span) return 0;
  const auto at = [&](double seconds) {
    return a.profile.frameAt(a.profile.frameTimeUs(0) + std::llround(seconds * kUsPerS))
        .value_or(0);
  };
  return at(span->toS) - at(span->fromS) + 1;
}

}  // namespace

// Results are found by the address of their recording; the pointers are weak, so that a closed
// recording is freed.
struct CompareWorker::Kept {
  struct Timed {
    std::weak_ptr<const OpenedRecording> of;
    std::shared_ptr<const TimedProfile> timed;
  };
  struct Curve {
    std::weak_ptr<const OpenedRecording> of;
    SeriesChoice choice;
    std::shared_ptr<const Series> series;
  };
  std::deque<Timed> timed;
  std::deque<Curve> curves;

  void forgetClosed() {
    std::erase_if(timed, [](const Timed& each) { return each.of.expired(); });
    std::erase_if(curves, [](const Curve& each) { return each.of.expired(); });
  }
};

ChosenOffset chosenOffset(const TimedProfile& a,
                          const TimedProfile& b,
                          Alignment alignment,
                          double handOffsetS) {
  if (alignment == Alignment::kManual) return {alignment, handOffsetS};
  if (const auto offsetS = offsetBetween(a, b, alignment)) return {alignment, *offsetS};
  return {Alignment::kStart, 0.0};
}

CompareWorker::CompareWorker(QObject* parent) : QObject(parent), kept_(std::make_shared<Kept>()) {
  pool_.setMaxThreadCount(1);
}

CompareWorker::~CompareWorker() {
  cancel();
  pool_.waitForDone();
}

void CompareWorker::cancel() {
  ++generation_;
  pool_.clear();
}

void CompareWorker::ask(const CompareQuestion& question) {
  cancel();
  pool_.start([this, question, generation = generation_.load()] { work(question, generation); });
}

std::shared_ptr<const TimedProfile> CompareWorker::timed(const OpenedRecordingPtr& recording,
                                                         const Progress& progress) {
  for (const auto& each : kept_->timed)
    if (each.of.lock() == recording) return each.timed;
  auto timed = std::make_shared<TimedProfile>(timedProfile(recording->profile, {}, progress));
  kept_->timed.push_back({recording, timed});
  if (kept_->timed.size() > kCompareWorkerMostKept) kept_->timed.pop_front();
  return timed;
}

std::shared_ptr<const Series> CompareWorker::curve(const OpenedRecordingPtr& recording,
                                                   const SeriesChoice& choice,
                                                   const Progress& progress) {
  // The index that means "all matrices" differs between hands.
  if (!hasSeries(recording->profile, choice)) return nullptr;
  for (const auto& each : kept_->curves)
    if (each.of.lock() == recording && each.choice == choice) return each.series;
  auto series = std::make_shared<Series>(
      readSeries(recording->profile, choice, -kEndOfTimeS, kEndOfTimeS, progress));
  kept_->curves.push_back({recording, choice, series});
  if (kept_->curves.size() > kCompareWorkerMostKept) kept_->curves.pop_front();
  return series;
}

void CompareWorker::work(const CompareQuestion& question, int generation) {
  CompareAnswer answer;
  const auto report = [&] {
    if (generation != generation_) throw Cancelled();
    QMetaObject::invokeMethod(
        this,
        [this, generation, answer] {
          if (generation == generation_) emit answered(answer);
        },
        Qt::QueuedConnection);
  };
  // Progress of one part of the work, which starts at what is done so far.
  const auto part = [&](double share) {
    return Progress([this, generation, base = answer.done, share, &answer, &report](double done) {
      const double now = base + share * done;
      constexpr double kStep = 0.02;
      if (now - answer.done >= kStep) {
        answer.done = now;
        report();
      }
      return generation == generation_;
    });
  };
  try {
    kept_->forgetClosed();
    answer.a = timed(question.a, part(kTimedShare / 2));
    answer.done = kTimedShare / 2;
    answer.b = timed(question.b, part(kTimedShare / 2));
    answer.done = kTimedShare;
    const auto [alignment, offsetS] =
        chosenOffset(*answer.a, *answer.b, question.alignment, question.handOffsetS);
    answer.alignment = alignment;
    answer.offsetS = offsetS;
    report();
    const auto choiceFor = [&](const OpenedRecording& recording) {
      SeriesChoice choice = question.choice;
      // The index after the last matrix of A means all of them, for B too.
      if (choice.index == question.a->numMatrices()) choice.index = recording.numMatrices();
      return choice;
    };
    answer.curveA = curve(question.a, choiceFor(*question.a), part(kCurveShare));
    answer.done = kTimedShare + kCurveShare;
    answer.curveB = curve(question.b, choiceFor(*question.b), part(kCurveShare));
    answer.done = kTimedShare + 2 * kCurveShare;
    report();
    if (answer.curveA && answer.curveB)
      answer.figures = compareCurves(*answer.curveA,
                                     *answer.curveB,
                                     offsetS,
                                     {gapFromS(answer.a->timing), gapFromS(answer.b->timing)});
    report();
    const FrameComparison comparison(question.a->profile.hand().layout,
                                     question.b->profile.hand().layout);
    double largest = 0.0;
    float largestValue = 0.0F;
    const std::size_t stride =
        std::max<std::size_t>(1, framesInCommon(*answer.a, *answer.b, offsetS) / kPairsLookedAt);
    visitFramePairs(
        *answer.a,
        *answer.b,
        offsetS,
        stride,
        [&](const FramePair&, const TactileFrame& inA, const TactileFrame& inB) {
          largest = std::max(largest, comparison.largest(inA, inB));
          for (const TactileFrame* frame : {&inA, &inB})
            for (const float value : frame->values) largestValue = std::max(largestValue, value);
        },
        part(1.0 - answer.done));
    answer.largestDifference = largest;
    answer.largestValue = static_cast<double>(largestValue);
  } catch (const Cancelled&) {
    return;
  } catch (const std::exception& error) {
    answer.failure = QString::fromUtf8(error.what());
  }
  answer.done = 1.0;
  answer.complete = true;
  try {
    report();
    // A new question was asked meanwhile.
  } catch (const Cancelled&) {
  }
}

}  // namespace palpate::gui
