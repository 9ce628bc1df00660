#include "palpate/capture/capture_session.h"

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <unistd.h>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/device/dsa_frame.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/recording_losses.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxRestFrames = 2'000;  // of a baseline: memory is bounded at any rate
constexpr std::size_t kMaxShown = 1000;

std::unique_ptr<Device> required(std::unique_ptr<Device> device) {
  if (!device) throw std::invalid_argument("CaptureSession: no device");
  return device;
}

// Properties of the device as text for a recording's `meta`.
RecordingMeta describe(const Device& device) {
  RecordingMeta meta = handMeta(device.hand());
  meta["program"] = "palpate " PALPATE_VERSION;
  const DeviceInfo info = device.info();
  meta["serial"] = info.serial;
  meta["firmware"] = info.firmware;
  if (info.sensorRevision > 0) meta["sensor_revision"] = std::to_string(info.sensorRevision);
  if (!info.sensorSerial.empty()) meta["sensor_serial"] = info.sensorSerial;
  if (!info.motionFirmware.empty()) meta["motion_firmware"] = info.motionFirmware;
  if (info.matrices.empty()) return meta;
  Json settings = Json::array();
  for (const MatrixSettings& matrix : info.matrices)
    settings.push(Json::object()
                      .set("sensitivity", matrix.sensitivity)
                      .set("threshold_counts", matrix.thresholdCounts));
  meta["settings"] = settings.text(-1);
  return meta;
}

std::map<std::string, std::int64_t> countersOf(const DeviceStatus& status) {
  std::map<std::string, std::int64_t> counters;
  const auto add = [&counters](const std::string& prefix, const PortStatus& port) {
    counters[prefix + "bad_checksums"] = static_cast<std::int64_t>(port.badChecksums);
    counters[prefix + "suspect"] = static_cast<std::int64_t>(port.suspect);
    counters[prefix + "skipped_bytes"] = static_cast<std::int64_t>(port.skippedBytes);
    counters[prefix + "lost"] = static_cast<std::int64_t>(port.lost);
    counters[prefix + "reconnects"] = static_cast<std::int64_t>(port.reconnects);
    counters[prefix + "retries"] = static_cast<std::int64_t>(port.retries);
  };
  add("", status.tactile);
  if (status.tactile.estimatedLost > 0)
    counters["lost_estimated"] = static_cast<std::int64_t>(status.tactile.estimatedLost);
  if (status.tactile.outOfRange > 0)
    counters["out_of_range"] = static_cast<std::int64_t>(status.tactile.outOfRange);
  if (status.motion) add("motion_", *status.motion);
  return counters;
}

}  // namespace

CaptureSession::CaptureSession(std::unique_ptr<Device> device,
                               CaptureOptions options,
                               const Clock& clock)
    : options_(std::move(options)),
      clock_(clock),
      device_(required(std::move(device))),
      recorder_(
          [this] {
            RecorderOptions forRecorder = options_.recorder;
            forRecorder.notice = [this](const Event& event) {
              show(event);
              if (options_.recorder.notice) options_.recorder.notice(event);
            };
            return forRecorder;
          }(),
          clock),
      meter_(options_.health),
      scansItself_(device_->isFreeRunning()),
      hand_(device_->hand()) {
  OptionCheck{"CaptureOptions"}(CaptureOptions::kBaselineS, "baselineS", options_.baselineS);
  recorder_.nameSeries(seriesNames());
}

CaptureSession::~CaptureSession() {
  stop();
  recorder_.stop();  // a recording may have been requested although the device was never started
  const std::lock_guard lock(feedsMutex_);
  for (const auto& queue : feeds_) queue->close();
}

void CaptureSession::addSeries(std::unique_ptr<SeriesSource> source) {
  requireNoRecording();
  if (!source) throw std::invalid_argument("CaptureSession: no series");
  std::vector<std::string> taken = seriesNames();
  if (taken.size() == kMaxSeries)
    throw std::invalid_argument("at most " + std::to_string(kMaxSeries) + " series");
  // The names of other streams in events.
  taken.insert(taken.end(), {"tactile", "events"});
  if (std::ranges::find(taken, source->name()) != taken.end())
    throw std::invalid_argument("two series have the name " + source->name() +
                                ", or it is one of the hand's");
  std::size_t place = 0;
  {
    const std::lock_guard lock(sourcesMutex_);
    place = sources_.size();
    sources_.push_back(std::move(source));
  }
  nameSeries();
  if (started_) startSeries(place);
}

void CaptureSession::removeSeries(const std::string& name) {
  requireNoRecording();
  std::shared_ptr<SeriesSource> source;
  {
    const std::lock_guard lock(sourcesMutex_);
    const auto at = std::ranges::find_if(
        sources_, [&](const auto& each) { return each && each->name() == name; });
    if (at == sources_.end()) throw std::invalid_argument("no sensor has the name " + name);
    source = std::exchange(*at, nullptr);
  }
  source->stop();
  nameSeries();
  note({nowUs(), nowUs(), "link", {}, "series " + name + " was removed", ""});
}

void CaptureSession::requireNoRecording() const {
  if (recorder_.recording())
    throw std::logic_error("a recording is running: stop it before sensors are added or removed");
}

// The recorder and all consumers name series in their gaps.
void CaptureSession::nameSeries() {
  const std::vector<std::string> names = seriesNames();
  recorder_.nameSeries(names);
  const std::lock_guard lock(feedsMutex_);
  for (const auto& queue : feeds_) queue->nameSeries(names);
}

void CaptureSession::startSeries(std::size_t place) {
  std::shared_ptr<SeriesSource> source;
  {
    const std::lock_guard lock(sourcesMutex_);
    source = sources_[place];
  }
  if (!source) return;
  try {
    source->start(furtherSink_, kHandSeries + device_->series().size() + place);
  } catch (const std::exception& error) {  // no thread is left: the hand goes on without it
    onEvent({nowUs(), nowUs(), "alarm", {}, "series " + source->name() + ": " + error.what(), ""});
  }
}

std::vector<std::shared_ptr<SeriesSource>> CaptureSession::seriesSources() const {
  const std::lock_guard lock(sourcesMutex_);
  std::vector<std::shared_ptr<SeriesSource>> present = sources_;
  std::erase(present, nullptr);
  return present;
}

std::vector<SeriesDescription> CaptureSession::furtherSeries() const {
  std::vector<SeriesDescription> all = device_->series();
  const std::lock_guard lock(sourcesMutex_);
  for (const auto& source : sources_)
    all.push_back(source ? source->description() : SeriesDescription{});
  return all;
}

std::vector<std::string> CaptureSession::seriesNames() const {
  std::vector<std::string> names{"angles", "temperatures"};
  for (const SeriesDescription& series : furtherSeries()) names.push_back(series.name);
  return names;
}

void CaptureSession::start() {
  if (started_) return;
  if (!recorder_.recording()) recorder_.clearPreTrigger();
  meter_.reset();
  takeFrame();
  takeAngles();
  takeTemperatures();
  {
    const std::lock_guard lock(baselineMutex_);
    recent_.clear();  // the baseline stays: it is that of the sensor
  }
  {
    const std::lock_guard lock(shownMutex_);
    shown_.clear();
    lastTemperatures_.reset();
  }
  {
    const std::lock_guard lock(clocksMutex_);
    clocks_.clear();
  }
  hand_ = device_->hand();
  if (options_.ownThread) recorder_.run();
  device_->start(*this);
  started_ = true;
  for (std::size_t place = 0; place < sources_.size(); ++place) startSeries(place);
}

void CaptureSession::stop() noexcept {
  if (!started_) return;
  const auto sources = seriesSources();
  for (const auto& source : sources) source->requestStop();
  device_->stop();
  for (const auto& source : sources) source->stop();
  started_ = false;
  recorder_.stop();
  recorder_.halt();
}

void CaptureSession::startRecording(RecordingOptions options) {
  // Counts from before the recording are subtracted. One that waits for a contact begins when its
  // file is made; both functions below are called by the recorder alone.
  const auto before = std::make_shared<std::map<std::string, std::int64_t>>(counters());
  const auto waits = std::make_shared<bool>(options.startOnContact);
  const auto given = options.counters;
  // What the link counted when the recording ended: a gap that was open then and ends later is
  // counted by the link, too.
  const auto atEnd = std::make_shared<std::optional<std::map<std::string, std::int64_t>>>();
  options.openGaps = [this, atEnd](std::int64_t untilUs) {
    auto& last = atEnd->emplace(counters());
    std::vector<Event> gaps;
    if (auto gap = device_->openGap(untilUs)) gaps.push_back(std::move(*gap));
    for (const RecordingLoss& loss : lossesOf(gaps))
      for (const char* name : {"lost", "lost_estimated"})
        last[name] += static_cast<std::int64_t>(loss.lost);
    for (const auto& source : seriesSources()) {
      auto gap = source->openGap(untilUs);
      if (!gap) continue;
      for (const RecordingLoss& loss : lossesOf({&*gap, 1}))
        last[seriesCounter(source->name(), "lost")] += static_cast<std::int64_t>(loss.lost);
      gaps.push_back(std::move(*gap));
    }
    return gaps;
  };
  options.counters = [this, before, given, atEnd] {
    auto now = *atEnd ? **atEnd : counters();
    for (auto& [name, value] : now) {
      const auto earlier = before->find(name);
      if (earlier != before->end() && earlier->second <= value) value -= earlier->second;
    }
    if (given)
      for (const auto& [name, value] : given()) now[name] = value;
    return now;
  };
  options.series = [this] { return furtherSeries(); };
  options.describe = [this, before, waits, more = options.describe] {
    if (std::exchange(*waits, false)) *before = counters();
    auto meta = describe(*device_);
    if (more)
      for (const auto& [key, value] : more()) meta[key] = value;
    return meta;
  };
  recorder_.start(std::move(options));
}

Rest CaptureSession::restNow() const {
  std::deque<SharedFrame> recent;
  {
    const std::lock_guard lock(baselineMutex_);
    recent = recent_;
  }
  // A sensor that was disconnected has no recent frames.
  const std::int64_t sinceUs = nowUs() - static_cast<std::int64_t>(options_.baselineS * kUsPerS);
  while (!recent.empty() && recent.front()->hostUs < sinceUs) recent.pop_front();
  if (recent.size() < 2)
    throw Error("no baseline was taken: fewer than two frames came in the last " +
                fixedText(options_.baselineS, 1) + " s");
  RestMeter meter(static_cast<double>(device_->hand().maximumCounts));
  // Of a hand that was found or changed meanwhile the newest frames count.
  const auto first = std::find_if(recent.rbegin(), recent.rend(), [&](const SharedFrame& frame) {
    return frame->stored().size() != recent.back()->stored().size();
  });
  try {
    for (auto frame = first.base(); frame != recent.end(); ++frame) meter.add((*frame)->stored());
    return {meter.baseline(), meter.numFrames()};
  } catch (const std::invalid_argument& error) {
    throw Error(error.what());
  }
}

std::string CaptureSession::takeBaseline() {
  if (!device_->hand().layout->decidesTouch())
    throw Error(
        "a baseline needs readings of a hand that decides touch by them "
        "(components, signed, touch_threshold or touch_sigma in its hand.json); "
        "for others there is the filter baseline");
  Rest rest = restNow();
  Event event = baselineEvent(rest.baseline, nowUs());
  std::string text = baselineText(rest.baseline, rest.numFrames);
  event.text += ", " + text;
  {
    const std::lock_guard lock(baselineMutex_);
    // A replay has its own.
    earlierBaselines_.push_back(baseline_ || recent_.empty() ? baseline_
                                                             : recent_.back()->baseline);
    baseline_ = std::make_shared<const Baseline>(std::move(rest.baseline));
  }
  note(event);
  return text;
}

void CaptureSession::undoBaseline() {
  std::shared_ptr<const Baseline> before;
  {
    const std::lock_guard lock(baselineMutex_);
    if (earlierBaselines_.empty()) throw Error("there is no earlier baseline");
    before = earlierBaselines_.back();
    earlierBaselines_.pop_back();
    // Without an earlier one it is 0.
    if (!before)
      before = std::make_shared<const Baseline>(
          Baseline{std::vector<float>(baseline_->rest.size()), {}});
    baseline_ = before;
  }
  Event event = baselineEvent(*before, nowUs());
  event.text = kPreviousBaselineText;
  note(event);
}

bool CaptureSession::canUndoBaseline() const {
  const std::lock_guard lock(baselineMutex_);
  return !earlierBaselines_.empty();
}

std::map<std::string, std::int64_t> CaptureSession::counters() const {
  auto counters = countersOf(device_->status());
  for (const auto& source : seriesSources()) {
    const PortStatus port = source->status().port;
    const auto add = [&](const char* what, std::uint64_t count) {
      counters[seriesCounter(source->name(), what)] = static_cast<std::int64_t>(count);
    };
    add("lost", port.lost);
    add("suspect", port.suspect);
    add("reconnects", port.reconnects);
  }
  return counters;
}

RecordingReport CaptureSession::stopRecording() { return recorder_.stop(); }

void CaptureSession::mark(const std::string& text, std::optional<int> digit) {
  Event event;
  event.tUs = event.t1Us = nowUs();
  event.kind = text.empty() ? "mark" : "label";
  event.text = text;
  if (digit) event.json = Json::object().set("digit", *digit).text(-1);
  note(event);
}

void CaptureSession::note(const Event& event) {
  show(event);
  pass(event);
}

void CaptureSession::onFrame(TactileFrame&& frame) {
  if (!frame.readings.empty()) {
    const std::lock_guard lock(baselineMutex_);
    decideTouch(frame, baseline_ ? baseline_ : frame.baseline);  // a replay has its own
  }
  const bool saturated = numSaturated(hand_, frame) > 0;
  if (scansItself_ && frame.layout != expectedFor_) {
    expectedFor_ = frame.layout;
    std::size_t enabled = 0;
    for (const MatrixLayout& matrix : frame.layout->matrices()) enabled += matrix.numEnabled();
    meter_.expect(dsaScanRateHz(enabled));
  }
  // Only the line of a controller that scans by itself has a known rate.
  meter_.frame(clock_.monotonicUs(), saturated, scansItself_ ? dsaRunsOf(frame) : 0);
  addToClock(kMaxSeries, frame.hostUs, frame.deviceUs);
  auto shared = std::make_shared<const TactileFrame>(std::move(frame));
  {
    const std::lock_guard lock(baselineMutex_);
    recent_.push_back(shared);
    const auto keptUs = static_cast<std::int64_t>(options_.baselineS * kUsPerS);
    while (recent_.front()->hostUs < shared->hostUs - keptUs || recent_.size() > kMaxRestFrames)
      recent_.pop_front();
  }
  screenFrame_.put(shared);
  pass(CaptureItem(std::move(shared)));
}

void CaptureSession::addToClock(std::size_t of,
                                std::int64_t hostUs,
                                std::optional<std::int64_t> deviceUs) {
  if (!deviceUs) return;
  const std::lock_guard lock(clocksMutex_);
  clocks_[of].add({hostUs, deviceUs});
}

void CaptureSession::onSample(Sample&& sample) {
  addToClock(sample.series, sample.hostUs, sample.deviceUs);
  if (sample.series == kAngleSeries) screenAngles_.put(sample);
  if (sample.series == kTemperatureSeries) {
    screenTemperatures_.put(sample);
    const std::lock_guard lock(shownMutex_);
    lastTemperatures_ = sample;
  }
  const bool ofHand = sample.series < kHandSeries;
  pass(CaptureItem(std::move(sample)), ofHand);
}

void CaptureSession::onEvent(Event&& event) {
  show(event);
  pass(CaptureItem(std::move(event)));
}

void CaptureSession::pass(const CaptureItem& item, bool ofHand) {
  if (numFeeds_ > 0) {
    std::vector<std::shared_ptr<CaptureQueue>> feeds;
    {
      const std::lock_guard lock(feedsMutex_);
      std::erase_if(feeds_, [](const auto& queue) { return queue->closed(); });
      numFeeds_ = feeds_.size();
      feeds = feeds_;
    }
    for (const auto& queue : feeds)
      if (ofHand || !queue->onlyHand()) queue->put(item);  // may wait here for a replay
  }
  recorder_.push(item);
}

void CaptureSession::show(const Event& event) {
  const std::lock_guard lock(shownMutex_);
  if (shown_.size() == kMaxShown) shown_.pop_front();
  shown_.push_back(event);
}

std::shared_ptr<CaptureQueue> CaptureSession::subscribe(std::string consumer,
                                                        const CaptureQueueOptions& options) {
  auto queue = std::make_shared<CaptureQueue>(std::move(consumer), options);
  if (options.series.empty()) queue->nameSeries(seriesNames());
  const std::lock_guard lock(feedsMutex_);
  feeds_.push_back(queue);
  numFeeds_ = feeds_.size();
  // When the pointer is released the queue is closed, so that no producer waits for room in it.
  CaptureQueue* const bare = queue.get();
  return {bare, [owner = std::move(queue)](CaptureQueue*) { owner->close(); }};
}

SharedFrame CaptureSession::takeFrame() { return screenFrame_.take().value_or(nullptr); }

std::optional<Sample> CaptureSession::takeAngles() { return screenAngles_.take(); }

std::optional<Sample> CaptureSession::takeTemperatures() { return screenTemperatures_.take(); }

std::vector<Event> CaptureSession::takeEvents() {
  const std::lock_guard lock(shownMutex_);
  std::vector<Event> events(shown_.begin(), shown_.end());
  shown_.clear();
  return events;
}

LinkInputs CaptureSession::inputs() const {
  LinkInputs inputs;
  inputs.started = started_;
  inputs.device = device_->status();
  inputs.frames = meter_.read(clock_.monotonicUs());
  inputs.queues = recorder_.queueStats();
  inputs.recorder = recorder_.status();
  for (const auto& source : seriesSources()) inputs.series.push_back(source->status());
  {
    const std::vector<std::string> names = seriesNames();
    const std::lock_guard clocksLock(clocksMutex_);
    for (const auto& [of, clock] : clocks_) {
      const bool ofFrames = of == kMaxSeries;
      // Of a series that was removed nothing more comes.
      if (!ofFrames && (of >= names.size() || names[of].empty())) continue;
      if (const auto report = clock.report())
        inputs.clocks.push_back({ofFrames ? "frames" : names[of], *report});
    }
  }
  const std::lock_guard lock(shownMutex_);
  inputs.temperatures = lastTemperatures_;
  return inputs;
}

LinkHealth CaptureSession::health() const { return assessHealth(inputs(), options_.health); }

FolderState folderStateOf(const fs::path& folder) {
  return {folder, ::access(folder.c_str(), W_OK | X_OK) == 0, freeBytesOf(folder)};
}

PreflightCheck CaptureSession::checkPreflight(const fs::path& folder) const {
  const auto& ask = options_.recorder.freeBytes;
  FolderState state = folderStateOf(folder);
  if (ask) state.freeBytes = ask(folder);
  return checkPreflight(state);
}

PreflightCheck CaptureSession::checkPreflight(const FolderState& folder) const {
  return palpate::checkPreflight(inputs(), folder, options_.health);
}

}  // namespace palpate
