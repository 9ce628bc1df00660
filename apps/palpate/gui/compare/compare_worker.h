// Computes in its own thread what a comparison needs and what takes long: first contacts, curves
// and figures. Results are kept for later questions; a new question cancels the running one.
#pragma once

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/batch/grasp_files.h>
#include <palpate/recording/recording_event.h>
#include <palpate/signals/alignment.h>
#include <palpate/signals/curve_comparison.h>
#include <palpate/signals/profile_series.h>

#include "gui/compare/compare_overlay.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// A recording with its events as they are now, which tell its grasps.
struct ComparedRecording {
  OpenedRecordingPtr recording;
  std::vector<RecordingEvent> events;
};

// What is compared and how.
struct CompareQuestion {
  // a: never null
  OpenedRecordingPtr a;
  OpenedRecordingPtr b;
  Alignment alignment = Alignment::kContact;
  // The offset for kManual [s].
  double handOffsetS = 0.0;
  // What the curves show.
  SeriesChoice choice = {};
  // Index of the chosen grasp of A and of B, for kGrasp.
  std::size_t graspA = 0;
  std::size_t graspB = 0;
  CompareOverlay overlay = CompareOverlay::kPair;
  CompareBand band = CompareBand::kNone;
  // All open recordings, A and B too.
  std::vector<ComparedRecording> recordings = {};
};

// What is known so far; results that are not computed yet are null or empty.
struct CompareAnswer {
  std::shared_ptr<const TimedProfile> a, b;
  // kStart when kContact was requested and there is no contact, or kGrasp and there is no grasp.
  Alignment alignment = Alignment::kContact;
  // [s]; valid once a and b are set
  double offsetS = 0.0;
  // The grasps of A and of B; empty: none, or not looked for.
  std::vector<GraspFrames> graspsA, graspsB;
  ComparedCurves overlaid;
  // Null in a complete answer when that recording does not have the chosen matrix.
  std::shared_ptr<const Series> curveA, curveB;
  std::optional<CurveComparison> figures;
  // The figures are over the part of the two chosen grasps that both have, not over all that the
  // recordings have in common.
  bool figuresOfGrasps = false;
  // Largest difference of any taxel over the common span [counts].
  std::optional<double> largestDifference;
  // Largest value of both recordings in the frames that were read [counts].
  double largestValue = 0.0;
  // Frames of A and of B that can't be read because they are damaged.
  std::size_t unreadableA = 0, unreadableB = 0;
  // Progress, 0..1.
  double done = 0.0;
  bool complete = false;
  // Why the work failed, in one line; for example an unreadable block of a file.
  QString failure;
};

// The offset for an alignment, and the alignment that was used: kStart when kContact was requested
// and there is no contact, or kGrasp and no grasp is chosen.
struct ChosenOffset {
  Alignment alignment = Alignment::kStart;
  double offsetS = 0.0;
};
ChosenOffset chosenOffset(const TimedProfile& a,
                          const TimedProfile& b,
                          Alignment alignment,
                          double handOffsetS);

class CompareWorker : public QObject {
  Q_OBJECT
 public:
  explicit CompareWorker(QObject* parent = nullptr);
  // Cancels the work and waits until it ends.
  ~CompareWorker() override;

  // Replaces the previous question; answered() is emitted several times, the last time with a
  // complete answer.
  void ask(const CompareQuestion& question);
  void cancel();
  void waitForDone() { pool_.waitForDone(); }

 signals:
  void answered(const palpate::gui::CompareAnswer& answer);

 private:
  struct Kept;
  void work(const CompareQuestion& question, int generation);
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

  // Has one thread, which alone uses `kept_`.
  QThreadPool pool_;
  std::shared_ptr<Kept> kept_;
  // Number of the newest question.
  std::atomic<int> generation_ = 0;
};

}  // namespace palpate::gui
