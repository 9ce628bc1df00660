#include "palpate/capture/capture_queue.h"

#include <algorithm>

#include "palpate/core/json.h"

namespace palpate {
namespace {

// The name of a stream in JSON, and of one of its items in a text.
std::pair<std::string, std::string> namesOf(CaptureStream stream,
                                            const std::vector<std::string>& series) {
  if (stream == CaptureStream::kTactile) return {"tactile", "frame"};
  if (stream == CaptureStream::kAngles) return {"angles", "angle sample"};
  if (stream == CaptureStream::kTemperatures) return {"temperatures", "temperature sample"};
  if (stream == CaptureStream::kEvents) return {"events", "event"};
  const std::size_t index = static_cast<std::size_t>(stream) - 1;
  std::string name = index < series.size() ? series[index] : "series " + std::to_string(index);
  return {name, "sample of " + name};
}

CaptureQueueStats::Port statsOf(const BoundedQueue<CaptureItem>& queue, std::size_t capacity) {
  return {queue.size(), queue.stats().highWater, capacity};
}

void moveAll(BoundedQueue<CaptureItem>& queue, std::vector<CaptureItem>& out) {
  for (std::size_t waiting = queue.size(); waiting > 0; --waiting) {
    std::optional<CaptureItem> item = queue.tryPop();
    if (!item) return;
    out.push_back(std::move(*item));
  }
}

}  // namespace

CaptureStream streamOf(const CaptureItem& item) noexcept {
  if (std::holds_alternative<SharedFrame>(item)) return CaptureStream::kTactile;
  const auto* sample = std::get_if<Sample>(&item);
  return sample ? static_cast<CaptureStream>(1 + sample->series) : CaptureStream::kEvents;
}

const Sample* sampleOf(const CaptureItem& item, std::size_t series) noexcept {
  const auto* sample = std::get_if<Sample>(&item);
  return sample && sample->series == series ? sample : nullptr;
}

bool leavesRoom(const CaptureItem& item, std::size_t used, std::size_t most) noexcept {
  const auto* sample = std::get_if<Sample>(&item);
  return !sample || sample->series < kHandSeries || used < most / 2;
}

// The angles that belong to a frame are the last ones at or before it, so they precede it.
bool isEarlier(const CaptureItem& a, const CaptureItem& b) noexcept {
  const std::int64_t aUs = stampOf(a), bUs = stampOf(b);
  return aUs != bUs ? aUs < bUs : streamOf(a) > streamOf(b);
}

std::int64_t stampOf(const CaptureItem& item) noexcept {
  if (const auto* frame = std::get_if<SharedFrame>(&item)) return (*frame)->hostUs;
  if (const auto* sample = std::get_if<Sample>(&item)) return sample->hostUs;
  return std::get_if<Event>(&item)->tUs;
}

Event gapEvent(CaptureStream stream,
               const CaptureLoss& loss,
               std::string_view reason,
               const std::vector<std::string>& series) {
  const auto [name, itemName] = namesOf(stream, series);
  Event event;
  event.tUs = loss.firstUs;
  event.t1Us = loss.lastUs;
  event.kind = "gap";
  const std::size_t noun =
      itemName.starts_with("sample of") ? std::string_view("sample").size() : itemName.size();
  event.text = std::to_string(loss.count) + " " + itemName.substr(0, noun) +
               (loss.count == 1 ? "" : "s") + itemName.substr(noun) +
               " lost: " + std::string(reason);
  event.json = Json::object()
                   .set("stream", name)
                   .set("lost", static_cast<std::int64_t>(loss.count))
                   .set("reason", reason)
                   .text(-1);
  return event;
}

CaptureQueue::CaptureQueue(std::string consumer, const CaptureQueueOptions& options)
    : consumer_(std::move(consumer)),
      options_(options),
      tactile_(options.tactileItems),
      motion_(options.motionItems),
      events_(options.eventItems) {}

BoundedQueue<CaptureItem>& CaptureQueue::queueOf(CaptureStream stream) {
  if (stream == CaptureStream::kTactile) return tactile_;
  return stream == CaptureStream::kEvents ? events_ : motion_;
}

void CaptureQueue::nameSeries(std::vector<std::string> names) {
  const std::lock_guard lock(lossMutex_);
  // What was lost of a series that is removed is still to be told.
  for (std::size_t i = 0; i < std::min(names.size(), options_.series.size()); ++i)
    if (names[i].empty()) names[i] = options_.series[i];
  options_.series = std::move(names);
}

bool CaptureQueue::put(CaptureItem item) {
  if (closed()) return false;
  const CaptureStream stream = streamOf(item);
  const std::int64_t stampUs = stampOf(item);
  BoundedQueue<CaptureItem>& queue = queueOf(stream);
  bool taken = false;
  if (options_.blockWhenFull) {
    taken = queue.push(std::move(item));
  } else {
    // The lock ensures that a gap ends before the item that ends it.
    const std::lock_guard lock(lossMutex_);
    taken = leavesRoom(item, queue.size(), options_.motionItems) && queue.tryPush(std::move(item));
    if (closed()) return taken;
    const auto index = static_cast<std::size_t>(stream);
    std::optional<CaptureLoss>& open = open_.at(index);
    if (!taken) {
      if (!open) open = CaptureLoss{stampUs, stampUs, 0};
      open->lastUs = stampUs;
      ++open->count;
      ++lost_.at(index);
    } else if (open) {
      ended_.emplace_back(
          gapEvent(stream, *open, consumer_ + " could not keep up", options_.series));
      open.reset();
    }
  }
  if (!taken || queue.size() >= options_.wakeAtItems) wake();
  return taken;
}

std::size_t CaptureQueue::take(std::vector<CaptureItem>& out, std::vector<Event>* ownGaps) {
  const auto before = static_cast<std::ptrdiff_t>(out.size());
  // Frames first: angles that were put before a frame are then taken together with it.
  moveAll(tactile_, out);
  moveAll(motion_, out);
  moveAll(events_, out);
  {
    const std::lock_guard lock(lossMutex_);
    if (ownGaps) ownGaps->insert(ownGaps->end(), ended_.begin(), ended_.end());
    std::move(ended_.begin(), ended_.end(), std::back_inserter(out));
    ended_.clear();
  }
  std::stable_sort(out.begin() + before, out.end(), isEarlier);
  return out.size() - static_cast<std::size_t>(before);
}

void CaptureQueue::takeOpenGaps(std::vector<CaptureItem>& out, std::vector<Event>* ownGaps) {
  const std::lock_guard lock(lossMutex_);
  for (std::size_t i = 0; i < kCaptureStreams; ++i) {
    if (!open_.at(i)) continue;
    Event gap = gapEvent(static_cast<CaptureStream>(i),
                         *open_.at(i),
                         consumer_ + " could not keep up",
                         options_.series);
    if (ownGaps) ownGaps->push_back(gap);
    out.emplace_back(std::move(gap));
    open_.at(i).reset();
  }
}

void CaptureQueue::wait(std::chrono::microseconds timeout, const std::stop_token& stop) {
  const auto enough = [this] {
    return woken_ || closed() || tactile_.size() >= options_.wakeAtItems ||
           motion_.size() >= options_.wakeAtItems || events_.size() >= options_.wakeAtItems;
  };
  std::unique_lock lock(wakeMutex_);
  wake_.wait_for(lock, stop, timeout, enough);
  woken_ = false;
}

void CaptureQueue::wake() {
  const std::lock_guard lock(wakeMutex_);
  woken_ = true;
  wake_.notify_all();
}

void CaptureQueue::close() {
  closed_.store(true);
  tactile_.close();
  motion_.close();
  events_.close();
  wake();
}

CaptureQueueStats CaptureQueue::stats() const {
  CaptureQueueStats stats{statsOf(tactile_, options_.tactileItems),
                          statsOf(motion_, options_.motionItems),
                          statsOf(events_, options_.eventItems),
                          {}};
  const std::lock_guard lock(lossMutex_);
  stats.lost = lost_;
  return stats;
}

}  // namespace palpate
