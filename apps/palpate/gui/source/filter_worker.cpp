#include "gui/source/filter_worker.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <algorithm>

#include <palpate/core/error.h>
#include <palpate/filter/filter_chain.h>
#include <palpate/filter/filtered_profile.h>

namespace palpate::gui {
namespace {

constexpr std::size_t kMeasuredFrames = 200;
// Measuring takes about this long at most.
constexpr qint64 kMeasuredMs = 200;

class Nowhere final : public FrameSink {
 public:
  void take(TactileFrame&) override {}
};

}  // namespace

OpenedRecordingPtr filteredRecording(const OpenedRecordingPtr& source,
                                     const Recipe& recipe,
                                     const Progress& progress) {
  // A recipe that needs all frames at once filters in a first pass, before the signals are
  // computed.
  const auto part = [&](double from, double to) -> Progress {
    if (!progress) return {};
    return
        [&progress, from, to](double fraction) { return progress(from + (to - from) * fraction); };
  };
  const Profile profile = filteredProfile(
      source->profile, recipe, {settingsTimesUs(source->events.events)}, part(0.0, 0.5));
  const OpenedRecordingPtr made = makeOpenedRecording(source->path, profile, part(0.5, 1.0));
  auto filtered = std::make_shared<OpenedRecording>(*made);
  filtered->timing = source->timing;
  filtered->events = source->events;
  filtered->eventsFailure = source->eventsFailure;
  filtered->saturatedFrames = source->saturatedFrames;
  return filtered;
}

FilterFigures figuresOf(const OpenedRecording& source, const Recipe& recipe) {
  FilterFigures figures;
  const double rateHz = source.timing.rateHz > 0.0 ? source.timing.rateHz : kUsualRateHz;
  figures.latency = latencyFrames(recipe, rateHz);
  for (const FilterStep& step : recipe.steps)
    figures.latencies.push_back(latencyFrames(step, rateHz));
  Nowhere nowhere;
  FilterChain chain(recipe, nowhere);
  const std::size_t numFrames = source.profile.numFrames();
  const std::size_t loudest = source.isLong() ? numFrames / 2 : source.table.frameOfLargestSum();
  const std::size_t from = loudest > kMeasuredFrames / 2 ? loudest - kMeasuredFrames / 2 : 0;
  TactileFrame frame;
  UnreadableSamples unreadable;
  chain.measureCosts(true);
  QElapsedTimer timer;
  timer.start();
  for (std::size_t i = from;
       i < std::min(numFrames, from + kMeasuredFrames) && timer.elapsed() < kMeasuredMs;
       ++i) {
    if (source.profile.readFrame(i, frame, &unreadable)) chain.push(frame);
  }
  chain.finish();
  figures.costsUs = chain.costsUs();
  return figures;
}

FilterWorker::FilterWorker(QObject* parent) : QObject(parent) { pool_.setMaxThreadCount(1); }

FilterWorker::~FilterWorker() {
  cancel();
  pool_.waitForDone();
}

void FilterWorker::cancel() {
  if (stop_) *stop_ = true;
  ++generation_;
  busy_ = false;
}

void FilterWorker::postResult(std::uint64_t generation, std::function<void()> what) {
  QMetaObject::invokeMethod(
      this,
      [this, generation, what = std::move(what)] {
        if (generation == generation_) what();
      },
      Qt::QueuedConnection);
}

void FilterWorker::start(const OpenedRecordingPtr& source, const Recipe& recipe) {
  cancel();
  busy_ = true;
  stop_ = std::make_shared<std::atomic<bool>>(false);
  pool_.start([this, source, recipe, stop = stop_, generation = generation_] {
    if (*stop) return;
    try {
      const OpenedRecordingPtr filtered = filteredRecording(source, recipe, [&](double fraction) {
        postResult(generation, [this, fraction] { emit progressed(fraction); });
        return !*stop;
      });
      postResult(generation, [this, source, filtered] { emit made(source, filtered); });
      const FilterFigures figures = figuresOf(*source, recipe);
      postResult(generation, [this, figures] {
        busy_ = false;
        emit measured(figures);
      });
    } catch (const Cancelled&) {
    } catch (const std::exception& error) {
      const QString message = error.what();
      postResult(generation, [this, message] {
        busy_ = false;
        emit failed(message);
      });
    }
  });
}

void FilterWorker::wait() {
  while (busy_) {
    pool_.waitForDone();
    QCoreApplication::sendPostedEvents(this, QEvent::MetaCall);
  }
}

}  // namespace palpate::gui
