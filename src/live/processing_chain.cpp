#include "palpate/live/processing_chain.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"
#include "palpate/model/in_time_order.h"

namespace palpate {
namespace {

constexpr std::chrono::milliseconds kLook{100};  // longest wait without an item
// Capacity for samples per waiting frame: at 250 Hz and 15 frames/s there are 17.
constexpr std::size_t kMotionPerFrame = 32;
constexpr std::size_t kProgressEvery = 256;

}  // namespace

ProcessingChain::ProcessingChain(std::vector<std::unique_ptr<Stage>> stages, ChainOptions options)
    : stages_(std::move(stages)), options_(std::move(options)) {
  if (stages_.empty() || std::any_of(stages_.begin(), stages_.end(), [](const auto& stage) {
        return stage == nullptr;
      }))
    throw std::invalid_argument("ProcessingChain: no stage");
  if (options_.waitingFrames == 0)
    throw std::invalid_argument("ProcessingChain: waitingFrames must be at least 1");
}

ProcessingChain::~ProcessingChain() { stop(); }

void ProcessingChain::connect(CaptureSession& session) {
  if (thread_.joinable()) throw std::logic_error("ProcessingChain::connect: it is running");
  CaptureQueueOptions queue;
  queue.tactileItems = options_.waitingFrames;
  queue.motionItems = options_.waitingFrames * kMotionPerFrame;
  queue.blockWhenFull = options_.lossless;
  queue_.reset();
  reset();
  queue_ = session.subscribe("live processing", queue);
}

void ProcessingChain::start() {
  if (thread_.joinable()) return;
  if (!queue_) throw std::logic_error("ProcessingChain::start: it listens to no session");
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void ProcessingChain::stop() noexcept {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
  thread_ = {};
}

void ProcessingChain::run(const std::stop_token& stop) {
  const auto queue = queue_;
  try {
    while (!stop.stop_requested()) {
      if (processWaiting() > 0) continue;
      if (queue->closed()) return;
      queue->wait(kLook, stop);
    }
    return;
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    failure_ = error.what();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = "an unknown exception";
  }
  queue->close();  // otherwise a lossless source would wait forever
}

std::size_t ProcessingChain::step() {
  if (!queue_) throw std::logic_error("ProcessingChain::step: it listens to no session");
  const std::uint64_t before = stats().frames;
  while (processWaiting() > 0) {
  }
  return stats().frames - before;
}

// Returns how many items were taken or processed.
//
// The queues are emptied one after the other, frames first. An item later than the newest frame
// taken may therefore follow another frame that arrived after its queue was emptied. Such items are
// held back until the next call, which finds that frame.
std::size_t ProcessingChain::processWaiting() {
  std::int64_t safeUs = std::numeric_limits<std::int64_t>::min();
  for (const CaptureItem& item : items_) safeUs = std::max(safeUs, stampOf(item));  // held back
  const std::size_t held = items_.size();
  const std::size_t taken = queue_->take(items_);
  if (taken == 0) queue_->takeOpenGaps(items_);
  for (const CaptureItem& item : items_)
    if (streamOf(item) == CaptureStream::kTactile || taken == 0)
      safeUs = std::max(safeUs, stampOf(item));
  std::stable_sort(items_.begin(), items_.end(), isEarlier);
  const auto end = std::find_if(items_.begin(), items_.end(), [&](const CaptureItem& item) {
    return stampOf(item) > safeUs;
  });
  const std::size_t handled = held + taken + (taken == 0 ? items_.size() - held : 0);
  std::for_each(items_.begin(), end, [this](const CaptureItem& item) { process(item); });
  items_.erase(items_.begin(), end);
  const std::uint64_t skipped =
      queue_->stats().lost.at(static_cast<std::size_t>(CaptureStream::kTactile));
  const std::lock_guard lock(mutex_);
  stats_.skipped = skipped;
  return handled;
}

void ProcessingChain::reset() {
  for (const auto& stage : stages_) stage->reset();
  items_.clear();
  angles_.reset();
  temperatures_.reset();
  further_.clear();
  furtherSeries_ = options_.furtherSeries;
  newest_.take();
  const std::lock_guard lock(mutex_);
  stats_ = {};
  failure_.clear();
}

void ProcessingChain::process(const CaptureItem& item) {
  if (const auto* frame = std::get_if<SharedFrame>(&item)) {
    processFrame(*frame);
  } else if (const auto* sample = std::get_if<Sample>(&item)) {
    if (sample->series == kAngleSeries) angles_ = *sample;
    if (sample->series == kTemperatureSeries) temperatures_ = *sample;
    if (sample->series >= kHandSeries) {
      const FurtherSample& taken = takeFurther(*sample);
      if (options_.onFurther) options_.onFurther(taken);
    }
    for (const auto& stage : stages_) stage->onSample(*sample);
  } else {
    const auto& event = std::get<Event>(item);
    if (event.kind == "link" && !further_.empty()) forgetRemoved();
    for (const auto& stage : stages_) stage->onEvent(event);
  }
}

// A series that was removed (CaptureSession::removeSeries) has no name any more.
void ProcessingChain::forgetRemoved() {
  if (!furtherSeries_) return;
  const auto all = furtherSeries_();
  std::erase_if(further_, [&](const FurtherSample& each) {
    const std::size_t index = each.sample.series - kHandSeries;
    return index < all.size() && all[index].name.empty();
  });
}

const FurtherSample& ProcessingChain::takeFurther(const Sample& sample) {
  const auto at = std::ranges::lower_bound(
      further_, sample.series, {}, [](const FurtherSample& each) { return each.sample.series; });
  const bool known = at != further_.end() && at->sample.series == sample.series;
  if (known && at->series->columns.size() == sample.values.size()) {
    at->sample = sample;
    return *at;
  }
  const std::size_t index = sample.series - kHandSeries;
  const auto all = furtherSeries_ ? furtherSeries_() : std::vector<SeriesDescription>();
  SeriesDescription series;
  if (index < all.size()) series = all[index];
  if (series.name.empty()) series.name = "series_" + std::to_string(sample.series);
  if (series.columns.size() != sample.values.size()) {
    series.columns.clear();
    for (std::size_t i = 1; i <= sample.values.size(); ++i)
      series.columns.push_back({std::to_string(i), {}});
  }
  FurtherSample taken{std::make_shared<const SeriesDescription>(std::move(series)), sample};
  if (known) return *at = std::move(taken);
  return *further_.insert(at, std::move(taken));
}

void ProcessingChain::processFrame(const SharedFrame& frame) {
  const std::int64_t fromUs = systemClock().monotonicUs();
  LiveResults results;
  results.frame = frame;
  results.angles = angles_;
  results.temperatures = temperatures_;
  results.further = further_;
  found_.clear();
  for (const auto& stage : stages_) stage->onFrame(results, found_);
  const auto tookUs = static_cast<double>(systemClock().monotonicUs() - fromUs);
  {
    const std::lock_guard lock(mutex_);
    ++stats_.frames;
    stats_.lastUs = tookUs;
    stats_.longestUs = std::max(stats_.longestUs, tookUs);
  }
  if (options_.onResults) options_.onResults(results);
  if (options_.onEvent)
    for (const Event& event : found_) options_.onEvent(event);
  newest_.put(std::move(results));
}

void ProcessingChain::runOver(const Profile& profile,
                              std::vector<Event> events,
                              const Progress& progress) {
  if (thread_.joinable()) throw std::logic_error("ProcessingChain::runOver: it is running");
  reset();
  furtherSeries_ = [further = std::vector(profile.series().begin() + kHandSeries,
                                          profile.series().end())] { return further; };
  std::stable_sort(
      events.begin(), events.end(), [](const auto& a, const auto& b) { return a.tUs < b.tUs; });
  InTimeOrder order(profile, events);
  while (const auto item = order.take()) {
    switch (const std::size_t i = item->index; item->kind) {
      case InTimeOrder::Kind::kEvent:
        process(events[i]);
        break;
      case InTimeOrder::Kind::kSample:
        process(profile.sample(item->series, i));
        break;
      case InTimeOrder::Kind::kFrame:
        reportProgress(progress, i, profile.numFrames(), kProgressEvery);
        processFrame(std::make_shared<const TactileFrame>(profile.frame(i)));
        break;
    }
  }
}

ChainStats ProcessingChain::stats() const {
  const std::lock_guard lock(mutex_);
  return stats_;
}

std::string ProcessingChain::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

}  // namespace palpate
