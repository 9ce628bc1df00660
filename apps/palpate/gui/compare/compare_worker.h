// What a comparison needs and takes longer than a blink: first contacts, curves, figures. Computed
// beside the window, kept, and given up as soon as something else is asked for.
#pragma once

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <deque>
#include <memory>
#include <optional>

#include <palpate/signals/alignment.h>
#include <palpate/signals/curve_comparison.h>
#include <palpate/signals/profile_series.h>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

struct CompareQuestion {
  OpenedRecordingPtr a;  // never null
  OpenedRecordingPtr b;
  Alignment alignment = Alignment::kContact;
  double handOffsetS = 0.0;  // for kManual
  SeriesChoice choice;       // of the curves
};

// What is known so far; what isn't yet is null.
struct CompareAnswer {
  std::shared_ptr<const TimedProfile> a, b;
  // kStart where contact was asked for and there is none
  Alignment alignment = Alignment::kContact;
  double offsetS = 0.0;  // once a and b are there
  // null although complete: that recording hasn't the chosen matrix.
  std::shared_ptr<const Series> curveA, curveB;
  std::optional<CurveComparison> figures;
  std::optional<double> largestDifference;  // of any taxel over the common span [counts]
  double largestValue = 0.0;                // of both, in the frames that were looked at [counts]
  double done = 0.0;                        // 0..1
  bool complete = false;
  QString failure;  // one line; a block of a file that can't be read
};

// The offset of that alignment, and by what: by start, where contacts are asked for and there are
// none.
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
  // Gives up and waits.
  ~CompareWorker() override;

  // Replaces what was asked before; answered() comes several times, the last one complete.
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
                                      const Progress& progress);

  QThreadPool pool_;  // one thread: what is kept belongs to it
  std::shared_ptr<Kept> kept_;
  std::atomic<int> generation_ = 0;  // of the newest question
};

}  // namespace palpate::gui
