#include "gui/compare/compare_worker.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include <palpate/core/error.h>
#include <palpate/core/time.h>
#include <palpate/signals/frame_difference.h>

namespace palpate::gui {
namespace {

constexpr std::size_t kCompareWorkerMostKept = 32;  // numbers of recordings and of curves
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

// The events that tell grasps.
std::vector<Event> segmentsAmong(const std::vector<Event>& events) {
  std::vector<Event> segments;
  for (const Event& event : events)
    if (event.kind == "segment") segments.push_back(event);
  return segments;
}

SeriesChoice choiceFor(const CompareQuestion& question, const OpenedRecording& recording) {
  SeriesChoice choice = question.choice;
  // The index after the last matrix of A means all of them, for the others too.
  if (choice.index == question.a->numMatrices()) choice.index = recording.numMatrices();
  return choice;
}

// The longest interval of a curve that isn't a gap: of the frames, or of the samples of a column.
double longestOf(const CompareQuestion& question, const Series& series, const TimedProfile& timed) {
  return question.choice.kind == SeriesChoice::Kind::kColumn ? gapOfTimesS(series.timeS)
                                                             : gapFromS(timed.timing);
}

// What the two chosen grasps have in common; empty: no grasps are compared.
std::optional<TimeSpan> graspSpanOf(const CompareQuestion& question, const CompareAnswer& answer) {
  if (answer.alignment != Alignment::kGrasp || answer.graspsA.empty() || answer.graspsB.empty())
    return std::nullopt;
  const auto chosen = [](const std::vector<GraspFrames>& grasps, std::size_t index) {
    const GraspFrames& grasp = grasps[std::min(index, grasps.size() - 1)];
    return FrameRange{grasp.begin, grasp.end};
  };
  return graspsInCommon(*answer.a,
                        chosen(answer.graspsA, question.graspA),
                        *answer.b,
                        chosen(answer.graspsB, question.graspB),
                        answer.offsetS);
}

// The span of all drawn curves on A's time axis; empty: none is drawn.
std::optional<TimeSpan> drawnSpanOf(const ComparedCurves& compared) {
  std::optional<TimeSpan> span;
  for (const OverlaidCurve& each : compared.curves) {
    if (!each.drawn || each.curve.series->timeS.empty()) continue;
    const auto& timeS = each.curve.series->timeS;
    const double shiftS = compared.zeroS - each.curve.zeroS;
    const TimeSpan own{std::max(each.curve.fromS, timeS.front()) + shiftS,
                       std::min(each.curve.toS, timeS.back()) + shiftS};
    if (!span) span = own;
    span = TimeSpan{std::min(span->fromS, own.fromS), std::max(span->toS, own.toS)};
  }
  return span;
}

// Results are found by the address of their recording; the pointers are weak, so that a closed
// recording is freed.
class CompareKept {
 public:
  CompareAnswer answerTo(const CompareQuestion& question,
                         const Progress& progress,
                         const CompareWorker::Tell& tell);

 private:
  struct Timed {
    std::weak_ptr<const OpenedRecording> of;
    std::shared_ptr<const TimedProfile> timed;
  };
  struct Curve {
    std::weak_ptr<const OpenedRecording> of;
    SeriesChoice choice;
    std::shared_ptr<const Series> series;
    std::size_t unreadable = 0;  // samples of it
  };
  struct Grasps {
    std::weak_ptr<const OpenedRecording> of;
    std::vector<Event> segments;
    std::vector<GraspFrames> grasps;
  };

  std::shared_ptr<const TimedProfile> timed(const OpenedRecordingPtr& recording,
                                            const Progress& progress);
  std::shared_ptr<const Series> curve(const OpenedRecordingPtr& recording,
                                      const SeriesChoice& choice,
                                      const Progress& progress,
                                      std::size_t* numUnreadable = nullptr);
  std::vector<GraspFrames> grasps(const ComparedRecording& of, const Progress& progress);
  ComparedCurves overlaid(const CompareQuestion& question,
                          const CompareAnswer& answer,
                          const Progress& progress);
  void forgetClosed() {
    std::erase_if(timed_, [](const Timed& each) { return each.of.expired(); });
    std::erase_if(curves_, [](const Curve& each) { return each.of.expired(); });
    std::erase_if(grasps_, [](const Grasps& each) { return each.of.expired(); });
  }

  std::deque<Grasps> grasps_;
  std::deque<Timed> timed_;
  std::deque<Curve> curves_;
};

std::shared_ptr<const TimedProfile> CompareKept::timed(const OpenedRecordingPtr& recording,
                                                       const Progress& progress) {
  for (const auto& each : timed_)
    if (each.of.lock() == recording) return each.timed;
  UnreadableSamples unreadable;  // the curve counts them
  auto timed =
      std::make_shared<TimedProfile>(timedProfile(recording->profile, {}, progress, &unreadable));
  timed_.push_back({recording, timed});
  if (timed_.size() > kCompareWorkerMostKept) timed_.pop_front();
  return timed;
}

std::shared_ptr<const Series> CompareKept::curve(const OpenedRecordingPtr& recording,
                                                 const SeriesChoice& choice,
                                                 const Progress& progress,
                                                 std::size_t* numUnreadable) {
  // The index that means "all matrices" differs between hands.
  if (!hasSeries(recording->profile, choice)) return nullptr;
  for (const auto& each : curves_)
    if (each.of.lock() == recording && each.choice == choice) {
      if (numUnreadable) *numUnreadable = each.unreadable;
      return each.series;
    }
  UnreadableSamples unreadable;
  auto series = std::make_shared<Series>(
      readSeries(recording->profile, choice, -kEndOfTimeS, kEndOfTimeS, progress, &unreadable));
  if (numUnreadable) *numUnreadable = unreadable.count;
  curves_.push_back({recording, choice, series, unreadable.count});
  if (curves_.size() > kCompareWorkerMostKept) curves_.pop_front();
  return series;
}

std::vector<GraspFrames> CompareKept::grasps(const ComparedRecording& of,
                                             const Progress& progress) {
  const auto segments = segmentsAmong(of.events);
  for (const auto& each : grasps_)
    if (each.of.lock() == of.recording && each.segments == segments) return each.grasps;
  auto found = graspFrames(of.recording->profile, of.events, progress);
  grasps_.push_back({of.recording, segments, found});
  if (grasps_.size() > kCompareWorkerMostKept) grasps_.pop_front();
  return found;
}

// `ofEach`: an average for each recording, of its grasps.
void addAverages(bool ofEach, ComparedCurves& compared, const Progress& progress) {
  std::map<std::size_t, std::vector<AlignedCurve>> groups;
  std::map<std::size_t, QString> names;
  for (const OverlaidCurve& each : compared.curves) {
    groups[ofEach ? each.recording : 0].push_back(each.curve);
    if (ofEach) names[each.recording] = each.name.section(", grasp ", 0, 0);
  }
  AverageOptions options{.band = compared.band == CompareBand::kPercentiles
                                     ? AverageBand::kPercentiles
                                     : AverageBand::kStandardDeviation};
  const auto average = [&] {
    compared.averages.clear();
    double longestS = 0.0;
    for (const auto& [recording, curves] : groups) {
      if (ofEach && curves.size() < options.least) continue;
      auto made = std::make_shared<const AverageCurve>(averageCurve(curves, options, progress));
      longestS = std::max(longestS, made->stepS);
      compared.averages.push_back({names[recording], recording, curves.size(), made});
    }
    return longestS;
  };
  options.stepS = average();
  // Once more where the steps differ.
  if (std::any_of(compared.averages.begin(), compared.averages.end(), [&](const auto& each) {
        return each.curve->stepS != options.stepS;
      }))
    average();
  QStringList single;
  for (const auto& [recording, curves] : groups)
    if (ofEach && curves.size() < options.least) single.append(names[recording]);
  if (single.isEmpty()) return;
  if (!compared.leftOut.isEmpty()) compared.leftOut += ". ";
  compared.leftOut += "No average of one grasp: " + single.join(", ");
}

ComparedCurves CompareKept::overlaid(const CompareQuestion& question,
                                     const CompareAnswer& answer,
                                     const Progress& progress) {
  constexpr double kMarginS = 0.5;  // before and after a grasp
  const bool ofGrasps = question.overlay == CompareOverlay::kGraspsOfA ||
                        question.overlay == CompareOverlay::kAllGrasps;
  ComparedCurves compared{.band = question.band};
  const TimedProfile& inA = *answer.a;
  if (ofGrasps && !answer.graspsA.empty()) {
    const std::size_t chosen = std::min(question.graspA, answer.graspsA.size() - 1);
    compared.zeroS = inA.timeS(answer.graspsA[chosen].begin);
  } else if (answer.alignment == Alignment::kGrasp) {
    compared.zeroS = inA.timeS(*inA.grasp);
  } else if (inA.contact) {
    compared.zeroS = inA.timeS(*inA.contact);
  }
  QStringList without;
  std::size_t others = 2;
  for (const ComparedRecording& each : question.recordings) {
    const OpenedRecordingPtr& recording = each.recording;
    const bool isA = recording == question.a, isB = recording == question.b;
    const bool other = !isA && !isB;
    const std::size_t number = isA ? 0 : isB ? 1 : others++;
    if (other && question.overlay == CompareOverlay::kPair) continue;
    if (!isA && question.overlay == CompareOverlay::kGraspsOfA) continue;
    const auto series = curve(recording, choiceFor(question, *recording), progress);
    const auto timedOne = timed(recording, progress);
    const QString name = fileNameOf(*recording);
    if (!series || series->timeS.empty()) {
      without.append(name + (series ? " has no frames"
                             : question.choice.kind == SeriesChoice::Kind::kColumn
                                 ? " has no such series"
                                 : " has no such matrix"));
      continue;
    }
    const double longestS = longestOf(question, *series, *timedOne);
    if (ofGrasps) {
      std::vector<TimeSpan> spans;
      for (const GraspFrames& grasp : grasps(each, progress))
        spans.push_back({timedOne->timeS(grasp.begin), timedOne->timeS(grasp.end)});
      if (spans.empty()) without.append(name + " has no grasp");
      std::size_t grasp = 0;
      for (AlignedCurve& stretch : alignedStretches(series, spans, kMarginS, longestS))
        compared.curves.push_back({name + ", grasp " + QString::number(++grasp), stretch, number});
      continue;
    }
    std::optional<double> offsetS;
    if (isA) {
      offsetS = 0.0;
    } else if (isB) {
      offsetS = answer.offsetS;
    } else {
      TimedProfile aligned = *timedOne;
      Alignment how = answer.alignment;
      if (how == Alignment::kManual) how = Alignment::kContact;
      if (how == Alignment::kGrasp)
        if (const auto found = grasps(each, progress); !found.empty())
          aligned.grasp = found.front().begin;
      offsetS = offsetBetween(inA, aligned, how);
      if (!offsetS)
        without.append(name + (how == Alignment::kGrasp ? " has no grasp" : " has no contact"));
    }
    if (!offsetS) continue;
    compared.curves.push_back(
        {name,
         {.series = series, .zeroS = compared.zeroS - *offsetS, .longestS = longestS},
         number,
         other});
  }
  // The same recording twice: B is a second curve of it. Among all recordings it counts once.
  if (question.overlay == CompareOverlay::kPair && question.a == question.b && answer.curveB)
    compared.curves.push_back({"B",
                               {.series = answer.curveB,
                                .zeroS = compared.zeroS - answer.offsetS,
                                .longestS = longestOf(question, *answer.curveB, *answer.b)},
                               1,
                               false});
  if (ofGrasps) compared.span = drawnSpanOf(compared);
  if (!without.isEmpty()) compared.leftOut = "Left out: " + without.join(", ");
  if (question.band != CompareBand::kNone)
    addAverages(question.overlay == CompareOverlay::kAllGrasps, compared, progress);
  return compared;
}

CompareAnswer CompareKept::answerTo(const CompareQuestion& question,
                                    const Progress& progress,
                                    const CompareWorker::Tell& tell) {
  CompareAnswer answer;
  const auto report = [&] {
    if (!progress(answer.done)) throw Cancelled();
    tell(answer);
  };
  // Progress of one part of the work, which starts at what is done so far.
  const auto part = [&](double share) {
    return Progress([&, base = answer.done, share](double done) {
      const double now = base + share * done;
      constexpr double kStep = 0.02;
      if (now - answer.done >= kStep) {
        answer.done = now;
        report();
      }
      return progress(answer.done);
    });
  };
  try {
    forgetClosed();
    answer.a = timed(question.a, part(kTimedShare / 2));
    answer.done = kTimedShare / 2;
    answer.b = timed(question.b, part(kTimedShare / 2));
    answer.done = kTimedShare;
    const bool ofGrasps = question.overlay == CompareOverlay::kGraspsOfA ||
                          question.overlay == CompareOverlay::kAllGrasps;
    if (question.alignment == Alignment::kGrasp || ofGrasps) {
      for (const ComparedRecording& each : question.recordings) {
        if (each.recording == question.a) answer.graspsA = grasps(each, part(0.0));
        if (each.recording == question.b) answer.graspsB = grasps(each, part(0.0));
      }
      const auto withGrasp =
          [](const TimedProfile& of, const std::vector<GraspFrames>& found, std::size_t chosen) {
            auto with = std::make_shared<TimedProfile>(of);
            if (!found.empty()) with->grasp = found[std::min(chosen, found.size() - 1)].begin;
            return with;
          };
      answer.a = withGrasp(*answer.a, answer.graspsA, question.graspA);
      answer.b = withGrasp(*answer.b, answer.graspsB, question.graspB);
    }
    const auto [alignment, offsetS] =
        chosenOffset(*answer.a, *answer.b, question.alignment, question.handOffsetS);
    answer.alignment = alignment;
    answer.offsetS = offsetS;
    report();
    answer.curveA =
        curve(question.a, choiceFor(question, *question.a), part(kCurveShare), &answer.unreadableA);
    answer.done = kTimedShare + kCurveShare;
    answer.curveB =
        curve(question.b, choiceFor(question, *question.b), part(kCurveShare), &answer.unreadableB);
    answer.done = kTimedShare + 2 * kCurveShare;
    report();
    const auto within = graspSpanOf(question, answer);
    answer.figuresOfGrasps = within.has_value();
    if (answer.curveA && answer.curveB)
      answer.figures = compareCurves(*answer.curveA,
                                     *answer.curveB,
                                     offsetS,
                                     {longestOf(question, *answer.curveA, *answer.a),
                                      longestOf(question, *answer.curveB, *answer.b)},
                                     within);
    if (question.overlay != CompareOverlay::kPair || question.band != CompareBand::kNone)
      answer.overlaid = overlaid(question, answer, part(0.0));
    report();
    const FrameComparison comparison(question.a->profile.hand().layout,
                                     question.b->profile.hand().layout);
    double largest = 0.0;
    float largestValue = 0.0F;
    UnreadableSamples unreadable;  // the curves count them
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
        part(1.0 - answer.done),
        &unreadable);
    answer.largestDifference = largest;
    answer.largestValue = static_cast<double>(largestValue);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    answer.failure = QString::fromUtf8(error.what());
  }
  answer.done = 1.0;
  answer.complete = true;
  return answer;
}

}  // namespace

ChosenOffset chosenOffset(const TimedProfile& a,
                          const TimedProfile& b,
                          Alignment alignment,
                          double handOffsetS) {
  if (alignment == Alignment::kManual) return {alignment, handOffsetS};
  if (const auto offsetS = offsetBetween(a, b, alignment)) return {alignment, *offsetS};
  return {Alignment::kStart, 0.0};
}

CompareWorker::CompareWorker(QObject* parent)
    : LatestAnswer(
          [kept = std::make_shared<CompareKept>()](
              const CompareQuestion& question, const Progress& progress, const Tell& tell) {
            return kept->answerTo(question, progress, tell);
          },
          [this](const CompareAnswer& answer) { emit answered(answer); },
          [this](const QString& why) {
            CompareAnswer answer;
            answer.done = 1.0;
            answer.complete = true;
            answer.failure = why;
            emit answered(answer);
          },
          parent) {}

}  // namespace palpate::gui
