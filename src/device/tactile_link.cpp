#include "device/tactile_link.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/device/sdh2.h"

#include "device/dsa_records.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;

constexpr std::int64_t kSilentUs = 500'000;  // without a frame for this time, the stream is silent
constexpr double kSilentPeriods = 3.0;       // or for three periods if that is longer
constexpr std::int64_t kWakeUs = 1'000'000;  // then the stream is restarted
constexpr int kWakeTries = 2;                // number of restarts before the port is opened again
constexpr std::int64_t kChecksumWindowUs = 3'000'000;
constexpr double kBadShare = 0.1;
constexpr std::uint64_t kBadEnough = 10;
constexpr std::int64_t kCureEveryUs = 15'000'000;

}  // namespace

TactileLink::TactileLink(
    const std::string& port, Open open, bool runLength, const HostTime& time, const Clock& clock)
    : PortLink(port, "tactile controller", std::move(open), time, clock),
      runLength_(runLength),
      hand_(sdh2()),
      layout_(hand_.layout) {}

TactileLink::~TactileLink() = default;

HandDescription TactileLink::hand() const {
  std::lock_guard lock(mutex_);
  return hand_;
}

std::optional<DsaControllerInfo> TactileLink::info() const {
  std::lock_guard lock(mutex_);
  return known_;
}

std::optional<Event> TactileLink::openGap(std::int64_t untilUs) const {
  std::lock_guard lock(mutex_);
  if (!openGap_ || untilUs <= openGap_->fromUs) return std::nullopt;
  return gapEvent(openGap_->fromUs, untilUs, missingIn(*openGap_, untilUs, false));
}

// --- The connection

void TactileLink::forget() {
  session_ = {};
  std::lock_guard lock(mutex_);
  openGap_.reset();
}

void TactileLink::connect(ByteChannel& channel) {
  DsaControllerOptions options;
  options.runLength = runLength_;
  options.isCancelled = [this] {
    // Also called while a setting is being changed; further commands must wait for it.
    if (!delivering_) rejectCommands("the tactile controller is not connected yet");
    return stopping();
  };
  delivering_ = false;
  controller_ = std::make_unique<DsaController>(
      channel, [this](std::span<const std::byte> payload) { onPayload(payload); }, clock_, options);
  const DsaControllerInfo& facts = controller_->open();
  if (const auto known = this->info(); wasConnected() && known && known->serial != facts.serial)
    throw DeviceError(
        DeviceFault::kWrongDevice,
        port_,
        "another tactile controller answers here than before; connect again if that is intended");
  learn();
  restoreSettings();
  session_.deviceClock.reset();
  resetRateEstimate();
  session_.held.reset();
  delivering_ = true;
  controller_->startStream();
  session_.lastFrameUs = session_.windowFromUs = clock_.monotonicUs();
  session_.windowFrames = session_.windowBad = 0;
  session_.restarts = 0;
}

void TactileLink::learn() {
  HandDescription hand;
  try {
    hand = describeHand(
        controller_->info().layout(), sdh2().axes.size(), sdh2().temperatureSensors.size());
  } catch (const std::invalid_argument& wrong) {
    throw DeviceError(DeviceFault::kProtocol, port_, wrong.what());
  }
  layout_ = hand.layout;
  std::lock_guard lock(mutex_);
  hand_ = std::move(hand);
  known_ = controller_->info();
}

void TactileLink::disconnected() {
  countPackets();
  session_.before = DsaPacketStats{};
  {
    const PortStatus now = status();
    session_.before.bytes = now.bytes;
    session_.before.badChecksums = now.badChecksums;
    session_.before.skippedBytes = now.skippedBytes;
    session_.retriesBefore = now.retries;
  }
  controller_.reset();
  delivering_ = false;
  session_.held.reset();
  if (!session_.gapFromUs && session_.lastStampUs != 0) beginGap(session_.lastStampUs);
}

void TactileLink::ended() {
  if (!session_.gapFromUs) return;
  const std::int64_t nowUs = time_.nowUs();
  endGap(nowUs, missingSince(*session_.gapFromUs, nowUs, /*frameReceived=*/false));
}

void TactileLink::closing() {
  if (!controller_) return;
  delivering_ = false;
  // One try: must return within half a second, in whatever state the controller is.
  if (controller_->streaming()) controller_->stopStreamOnce(milliseconds(500));
}

void TactileLink::work() {
  if (hasQueuedCommands()) {
    executeCommands();
    session_.lastFrameUs = clock_.monotonicUs();
  }
  if (stopping()) return;
  controller_->poll(milliseconds(50));
  countPackets();
  watchSilence();
  watchChecksums();
}

void TactileLink::countPackets() {
  if (!controller_) return;
  const DsaControllerStats stats = controller_->stats();
  updateStatus([&](PortStatus& status) {
    status.bytes = session_.before.bytes + stats.packets.bytes;
    status.badChecksums = session_.before.badChecksums + stats.packets.badChecksums;
    status.skippedBytes = session_.before.skippedBytes + stats.packets.skippedBytes;
    status.retries = session_.retriesBefore + stats.retries;
  });
}

// --- Frames

void TactileLink::onPayload(std::span<const std::byte> payload) {
  if (!delivering_) return;
  TactileFrame frame(layout_);
  const std::optional<DsaFrame> packet =
      decodeDsaFrame(payload, *layout_, known_ && known_->masksKnown, frame.values);
  if (!packet) {
    ++session_.suspect;
    updateStatus([&](PortStatus& status) { status.suspect = session_.suspect; });
    return;
  }
  checkStamp(std::move(frame), *packet);
}

void TactileLink::checkStamp(TactileFrame&& frame, const DsaFrame& packet) {
  frame.hostUs = stampAfter(session_.lastStampUs);
  switch (session_.deviceClock.checkStamp(packet.stampMs, clock_.monotonicUs())) {
    case DsaClock::FrameAcceptance::kAccept:
      return deliver(std::move(frame), session_.deviceClock.deviceMs(), packet.packetBytes);
    case DsaClock::FrameAcceptance::kReplaceHeld:
      ++session_.suspect;
      [[fallthrough]];
    case DsaClock::FrameAcceptance::kHold:
      session_.held = Held{std::move(frame), packet};
      break;
    case DsaClock::FrameAcceptance::kDropHeld:
      ++session_.suspect;
      session_.held.reset();
      deliver(std::move(frame), session_.deviceClock.deviceMs(), packet.packetBytes);
      break;
    case DsaClock::FrameAcceptance::kRestarted:
      eventNow("link", "the tactile controller's clock restarted: it was switched off and on");
      resetRateEstimate();
      minOffsetUs_ = {};
      if (session_.held) {
        Held held = std::move(*session_.held);
        session_.held.reset();
        deliver(std::move(held.frame), session_.deviceClock.heldMs(), held.packet.packetBytes);
      }
      deliver(std::move(frame), session_.deviceClock.deviceMs(), packet.packetBytes);
      break;
  }
  updateStatus([&](PortStatus& status) { status.suspect = session_.suspect; });
}

void TactileLink::deliver(TactileFrame&& frame, std::int64_t deviceMs, std::size_t packetBytes) {
  frame.deviceUs = deviceMs * kUsPerMs;
  const std::int64_t hostUs = frame.hostUs;
  const bool counts = session_.loss.known();
  const std::uint64_t counted = session_.loss.next(deviceMs, packetBytes);
  Missing missing{counted, false};
  if (session_.gapFromUs) {
    if (!counts) missing = missingSince(*session_.gapFromUs, hostUs, /*frameReceived=*/true);
    endGap(hostUs, missing);
  } else {
    updateStatus([&](PortStatus& status) { status.lost += counted; });
  }
  if (session_.loss.scanPeriodMs() > 0.0) session_.periodMs = session_.loss.scanPeriodMs();
  session_.lastFrameUs = clock_.monotonicUs();
  session_.restarts = 0;
  ++session_.frames;
  ++session_.windowFrames;
  measureAge(hostUs, deviceMs * kUsPerMs);
  updateStatus([&](PortStatus& status) {
    status.items = session_.frames;
    status.lastItemUs = hostUs;
    status.state = PortState::kStreaming;
    status.message.clear();
  });
  sink_->onFrame(std::move(frame));
}

// --- Silence and noise

void TactileLink::watchSilence() {
  const std::int64_t nowUs = clock_.monotonicUs();
  const auto limitUs = std::max(
      kSilentUs, static_cast<std::int64_t>(kSilentPeriods * 1000.0 * session_.loss.scanPeriodMs()));
  if (nowUs - session_.lastFrameUs < limitUs) return;
  if (!session_.gapFromUs) {
    controller_->flush();  // a packet may be behind a corrupt size
    if (clock_.monotonicUs() - session_.lastFrameUs < limitUs) return;
    beginGap(session_.lastStampUs != 0 ? session_.lastStampUs : time_.nowUs());
    setState(
        PortState::kSilent,
        port_ + ": no frames for " +
            numberText(std::round(static_cast<double>(nowUs - session_.lastFrameUs) / 1e5) / 10.0) +
            " s; check power and cable of the tactile controller");
    eventNow("alarm", "no frames from the tactile controller");
  }
  if (nowUs - session_.lastFrameUs < kWakeUs * (session_.restarts + 1)) return;
  if (session_.restarts >= kWakeTries)
    throw DeviceError(
        DeviceFault::kSilent, port_, "the tactile controller is silent; check its power and cable");
  ++session_.restarts;
  // The controller may have been switched off and on, and waits for a start.
  if (controller_->stopStreamOnce(milliseconds(400))) {
    session_.deviceClock.reset();
    // Its clock has then restarted and may show any time, so missing frames are estimated by our
    // clock.
    resetRateEstimate();
    controller_->startStream();
  }
}

// Restarts the estimates of the controller's rate and clock; frames not sent meanwhile are no loss.
void TactileLink::resetRateEstimate() { session_.loss.reset(); }

// Estimated from the usual rate, because the controller's clock is not known over the whole gap.
TactileLink::Missing TactileLink::missingIn(const OpenGap& gap,
                                            std::int64_t nowUs,
                                            bool frameReceived) {
  if (!(gap.periodMs > 0.0)) return {};
  const double periods = static_cast<double>(nowUs - gap.fromUs) / 1000.0 / gap.periodMs;
  const double frames = std::round(periods) - (frameReceived ? 1.0 : 0.0);
  return {static_cast<std::uint64_t>(std::max(frames, 0.0)), true};
}

Event TactileLink::gapEvent(std::int64_t fromUs, std::int64_t toUs, const Missing& missing) {
  const double seconds = static_cast<double>(toUs - fromUs) / 1e6;
  Json json = Json::object().set("seconds", seconds);
  std::string text = "no frames for " + numberText(std::round(seconds * 1000.0) / 1000.0) + " s";
  if (missing.frames) {
    json.set("lost", static_cast<std::int64_t>(*missing.frames))
        .set("estimated", missing.estimated);
    text += std::string(missing.estimated ? ", about " : ", ") + std::to_string(*missing.frames) +
            " frames are missing";
  }
  return {fromUs, toUs, "gap", {}, std::move(text), json.text(-1)};
}

void TactileLink::beginGap(std::int64_t fromUs) {
  session_.gapFromUs = fromUs;
  std::lock_guard lock(mutex_);
  openGap_ = {fromUs, session_.periodMs};
}

void TactileLink::endGap(std::int64_t nowUs, const Missing& missing) {
  const std::int64_t fromUs = *std::exchange(session_.gapFromUs, std::nullopt);
  updateStatus([&](PortStatus& status) {
    openGap_.reset();
    status.lost += missing.frames.value_or(0);
    if (missing.estimated) status.estimatedLost += missing.frames.value_or(0);
  });
  const Event gap = gapEvent(fromUs, nowUs, missing);
  event(gap.kind, gap.text, gap.tUs, gap.t1Us, {}, gap.json);
}

// A wrong checksum now and then is normal. One packet in ten means that sender and receiver are out
// of step, or that another program writes to the port.
void TactileLink::watchChecksums() {
  const std::int64_t nowUs = clock_.monotonicUs();
  if (nowUs - session_.windowFromUs < kChecksumWindowUs) return;
  const std::uint64_t bad = controller_->stats().packets.badChecksums;
  const std::uint64_t newBad = bad - std::min(bad, session_.windowBad);
  const std::uint64_t frames = std::exchange(session_.windowFrames, 0);
  session_.windowBad = bad;
  session_.windowFromUs = nowUs;
  if (newBad < kBadEnough ||
      static_cast<double>(newBad) < kBadShare * static_cast<double>(newBad + frames))
    return;
  if (session_.lastStreamRestartUs != 0 && nowUs - session_.lastStreamRestartUs < kCureEveryUs)
    return;
  session_.lastStreamRestartUs = nowUs;
  eventNow(
      "alarm",
      std::to_string(newBad) + " bad checksums in 3 s: cable, or a second program on the port");
  if (std::exchange(session_.restartedForChecksums, !session_.restartedForChecksums))
    throw DeviceError(DeviceFault::kProtocol, port_, "too many bad checksums: reopening it");
  controller_->whilePaused([] {});
}

void TactileLink::applySetting(std::size_t matrix, const Wanted& wanted) {
  if (wanted.sensitivity) controller_->setSensitivity(matrix, *wanted.sensitivity);
  if (wanted.thresholdCounts) controller_->setThreshold(matrix, *wanted.thresholdCounts);
  if (wanted.dynamicMask) controller_->setDynamicMask(matrix, *wanted.dynamicMask);
}

void TactileLink::restoreSettings() {
  bool restored = false;
  for (const auto& [matrix, wanted] : wanted_) {
    if (matrix >= controller_->info().matrices.size()) continue;
    const DsaMatrixInfo& is = controller_->info().matrices[matrix];
    const bool same = (!wanted.sensitivity || static_cast<float>(*wanted.sensitivity) ==
                                                  static_cast<float>(is.sensitivity)) &&
                      (!wanted.thresholdCounts || wanted.thresholdCounts == is.thresholdCounts) &&
                      (!wanted.dynamicMask || wanted.dynamicMask == is.layout.dynamicMask);
    if (same) continue;
    applySetting(matrix, wanted);
    restored = true;
  }
  if (!restored) return;
  learn();
  const std::int64_t nowUs = time_.nowUs();
  event("settings",
        "the previous settings were restored",
        nowUs,
        nowUs,
        std::nullopt,
        settingsJson());
}

// All settings that hold from now on, so that a recording can be read without earlier events.
std::string TactileLink::settingsJson() const {
  Json matrices = Json::array();
  for (const DsaMatrixInfo& matrix : controller_->info().matrices)
    matrices.push(Json::object()
                      .set("sensitivity", matrix.sensitivity)
                      .set("threshold_counts", matrix.thresholdCounts.value_or(0))
                      .set("dynamic_mask", hexDigits(packMask(matrix.layout.dynamicMask))));
  return Json::object().set("matrices", std::move(matrices)).text(-1);
}

void TactileLink::change(const Wanted& wanted, std::optional<int> matrix, const std::string& text) {
  const std::size_t matrices = controller_->info().matrices.size();
  if (matrix && (*matrix < 0 || static_cast<std::size_t>(*matrix) >= matrices))
    throw std::invalid_argument("there is no matrix " + std::to_string(*matrix));
  const std::int64_t fromUs = time_.nowUs();
  controller_->whilePaused([&] {
    for (std::size_t m = 0; m < matrices; ++m) {
      if (matrix && static_cast<std::size_t>(*matrix) != m) continue;
      applySetting(m, wanted);
      Wanted& kept = wanted_[m];
      if (wanted.sensitivity) kept.sensitivity = wanted.sensitivity;
      if (wanted.thresholdCounts) kept.thresholdCounts = wanted.thresholdCounts;
      if (wanted.dynamicMask) kept.dynamicMask = wanted.dynamicMask;
    }
  });
  learn();
  resetRateEstimate();
  event("settings",
        text + (matrix ? " (" + hand_.matrixName(static_cast<std::size_t>(*matrix)) + ")"
                       : " (all matrices)"),
        fromUs,
        time_.nowUs(),
        matrix,
        settingsJson());
}

CommandAnswer TactileLink::execute(const DeviceCommand& command) {
  if (const auto* threshold = std::get_if<SetThreshold>(&command)) {
    Wanted wanted;
    wanted.thresholdCounts = threshold->counts;
    change(wanted, threshold->matrix, "threshold " + std::to_string(threshold->counts) + " counts");
  } else if (const auto* sensitivity = std::get_if<SetSensitivity>(&command)) {
    Wanted wanted;
    wanted.sensitivity = sensitivity->sensitivity;
    change(wanted, sensitivity->matrix, "sensitivity " + numberText(sensitivity->sensitivity));
  } else if (const auto* mask = std::get_if<SetDynamicMask>(&command)) {
    Wanted wanted;
    wanted.dynamicMask = mask->mask;
    const auto on = std::count_if(
        mask->mask.begin(), mask->mask.end(), [](std::uint8_t flag) { return flag != 0; });
    change(wanted, mask->matrix, "dynamic mask: " + std::to_string(on) + " taxels scanned");
  }
  return {};
}

}  // namespace palpate
