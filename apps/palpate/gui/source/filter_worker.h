// Looks at a recording through a recipe, beside the window: the filtered recording, and what each
// step costs and delays. Whoever changes the recipe again while it is at work gets the last one
// only.
#pragma once

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/filter/recipe.h>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

struct FilterFigures {
  std::vector<double> costsUs;  // per step and frame; 0: off
  // per step [frames]; nothing: a step of load never comes through
  std::vector<std::optional<int>> latencies;
  std::optional<int> latency;  // of the chain
};

// The same recording, filtered: stamps, angles, events and what was saturated are the source's.
// Throws std::invalid_argument (a matrix that it hasn't), Error, Cancelled.
OpenedRecordingPtr filteredRecording(const OpenedRecordingPtr& source,
                                     const Recipe& recipe,
                                     const Progress& progress = {});
// Costs are measured on up to 200 frames around the one of largest sum.
FilterFigures figuresOf(const OpenedRecording& source, const Recipe& recipe);

class FilterWorker : public QObject {
  Q_OBJECT
 public:
  explicit FilterWorker(QObject* parent = nullptr);
  ~FilterWorker() override;  // cancels and waits

  void start(const OpenedRecordingPtr& source, const Recipe& recipe);
  void cancel();
  bool busy() const noexcept { return busy_; }
  // For tests and pictures: until nothing is at work any more.
  void wait();

 signals:
  void progressed(double fraction);
  void made(const palpate::gui::OpenedRecordingPtr& source,
            const palpate::gui::OpenedRecordingPtr& filtered);
  void measured(const palpate::gui::FilterFigures& figures);
  void failed(const QString& message);

 private:
  void postResult(std::uint64_t generation, std::function<void()> what);

  QThreadPool pool_;
  std::shared_ptr<std::atomic<bool>> stop_;
  std::uint64_t generation_ = 0;
  bool busy_ = false;
};

}  // namespace palpate::gui
