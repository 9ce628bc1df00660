#include "gui/source/filter_worker.h"

#include <QElapsedTimer>
#include <algorithm>

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
                                     const Progress& progress,
                                     const std::optional<Baselines>& baselines) {
  // A recipe that needs all frames at once filters in a first pass, before the signals are
  // computed.
  const Profile profile =
      filteredProfile(baselines ? source->profile.withBaselines(*baselines) : source->profile,
                      recipe,
                      {settingsTimesUs(source->events.events)},
                      partOf(progress, 0.0, 0.5));
  const OpenedRecordingPtr made =
      makeOpenedRecording(source->path, profile, partOf(progress, 0.5, 1.0));
  auto filtered = std::make_shared<OpenedRecording>(*made);
  filtered->timing = source->timing;
  filtered->events = source->events;
  filtered->meta = source->meta;
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
  FilterChain chain(withRest(recipe, source.profile, {settingsTimesUs(source.events.events)}),
                    nowhere);
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

FilterWorker::FilterWorker(QObject* parent)
    : LatestAnswer(
          [](const FilterQuestion& question, const Progress& progress, const Tell& tell) {
            FilterAnswer answer{
                .source = question.source,
                .filtered = filteredRecording(
                    question.source, question.recipe, progress, question.baselines)};
            tell(answer);
            answer.figures = figuresOf(*question.source, question.recipe);
            return answer;
          },
          [this](const FilterAnswer& answer) {
            if (answer.figures)
              emit measured(*answer.figures);
            else
              emit made(answer.source, answer.filtered);
          },
          [this](const QString& why) { emit failed(why); },
          parent) {}

}  // namespace palpate::gui
