// Computes what a comparison needs and what takes long: first contacts, curves and figures.
#pragma once

#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/batch/grasp_files.h>
#include <palpate/model/event.h>
#include <palpate/signals/alignment.h>
#include <palpate/signals/curve_comparison.h>
#include <palpate/signals/profile_series.h>

#include "gui/compare/compare_overlay.h"
#include "gui/source/latest_answer.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// A recording with its events as they are now, which tell its grasps.
struct ComparedRecording {
  OpenedRecordingPtr recording;
  std::vector<Event> events;
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

// answered() comes several times, the last time with a complete answer. Results are kept for later
// questions.
class CompareWorker : public LatestAnswer<CompareQuestion, CompareAnswer> {
  Q_OBJECT
 public:
  explicit CompareWorker(QObject* parent = nullptr);

 signals:
  void answered(const palpate::gui::CompareAnswer& answer);
};

}  // namespace palpate::gui
