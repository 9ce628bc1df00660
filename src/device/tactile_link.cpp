#include "device/tactile_link.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <variant>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;

constexpr std::int64_t kSilentUs = 500'000;  // no frame for so long: silent
constexpr double kSilentPeriods = 3.0;       // or for three periods, if that is longer
constexpr std::int64_t kWakeUs = 1'000'000;  // then the stream is started anew
constexpr int kWakeTries = 2;                // then the port is opened anew
constexpr std::int64_t kChecksumWindowUs = 3'000'000;
constexpr double kBadShare = 0.1;
constexpr std::uint64_t kBadEnough = 10;
constexpr std::int64_t kCureEveryUs = 15'000'000;
constexpr std::int64_t kOffsetWindowUs = 30'000'000;
constexpr double kByteUs = 86.8;  // 10 bits at 115200 Bd

}  // namespace

TactileLink::TactileLink(
    const std::string& port, Open open, bool runLength, const HostTime& time, const Clock& clock)
    : PortLink(port, "tactile controller", std::move(open), time, clock),
      runLength_(runLength),
      byteUs_(kByteUs),
      hand_(sdh2()),
      layout_(hand_.layout),
      loss_(byteUs_) {}

TactileLink::~TactileLink() = default;

HandDescription TactileLink::hand() const {
  std::lock_guard lock(mutex_);
  return hand_;
}

std::optional<DsaFacts> TactileLink::facts() const {
  std::lock_guard lock(mutex_);
  return known_;
}

// --- the connection -------------------------------------------------------------------------------

void TactileLink::connect(ByteChannel& channel) {
  DsaControllerOptions options;
  options.runLength = runLength_;
  options.giveUp = [this] {
    // Also asked while a setting is changed: the next ones wait for it.
    if (!delivering_) rejectOrders("the tactile controller is not connected yet");
    return stopping();
  };
  delivering_ = false;
  controller_ = std::make_unique<DsaController>(
      channel, [this](std::span<const std::byte> payload) { onPayload(payload); }, clock_, options);
  const DsaFacts& facts = controller_->open();
  if (const auto known = this->facts(); wasConnected() && known && known->serial != facts.serial)
    throw DeviceError(
        DeviceFault::kWrongDevice,
        port_,
        "another tactile controller answers here than before; connect anew if that is "
        "meant");
  learn();
  restoreSettings();
  deviceClock_.reset();
  loss_.reset();
  held_.reset();
  delivering_ = true;
  controller_->startStream();
  lastFrameUs_ = windowFromUs_ = clock_.monotonicUs();
  windowFrames_ = windowBad_ = 0;
  restarts_ = 0;
}

void TactileLink::learn() {
  HandDescription hand;
  try {
    hand = describeHand(
        controller_->facts().layout(), sdh2().axes.size(), sdh2().temperatureSensors.size());
  } catch (const std::invalid_argument& wrong) {
    throw DeviceError(DeviceFault::kProtocol, port_, wrong.what());
  }
  layout_ = hand.layout;
  std::lock_guard lock(mutex_);
  hand_ = std::move(hand);
  known_ = controller_->facts();
}

void TactileLink::disconnected() {
  countPackets();
  before_ = DsaPacketStats{};
  {
    const PortStatus now = status();
    before_.bytes = now.bytes;
    before_.badChecksums = now.badChecksums;
    before_.skippedBytes = now.skippedBytes;
    retriesBefore_ = now.retries;
  }
  controller_.reset();
  delivering_ = false;
  held_.reset();
  if (!gapFromUs_ && lastStampUs_ != 0) gapFromUs_ = lastStampUs_;
}

void TactileLink::closing() {
  if (gapFromUs_) endGap(time_.nowUs());
  if (!controller_) return;
  delivering_ = false;
  // Within half a second, however the controller is: one try.
  if (controller_->streaming()) controller_->stopStreamOnce(milliseconds(500));
}

void TactileLink::work() {
  if (ordersWait()) {
    executeOrders();
    lastFrameUs_ = clock_.monotonicUs();
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
    status.bytes = before_.bytes + stats.packets.bytes;
    status.badChecksums = before_.badChecksums + stats.packets.badChecksums;
    status.skippedBytes = before_.skippedBytes + stats.packets.skippedBytes;
    status.retries = retriesBefore_ + stats.retries;
  });
}

// --- frames ---------------------------------------------------------------------------------------

void TactileLink::onPayload(std::span<const std::byte> payload) {
  if (!delivering_) return;
  TactileFrame frame(layout_);
  const std::optional<DsaFrame> packet =
      decodeDsaFrame(payload, *layout_, known_ && known_->masksKnown, frame.values);
  if (!packet) {
    ++suspect_;
    updateStatus([&](PortStatus& status) { status.suspect = suspect_; });
    return;
  }
  judge(std::move(frame), *packet);
}

void TactileLink::judge(TactileFrame&& frame, const DsaFrame& packet) {
  frame.hostUs = stampAfter(lastStampUs_);
  switch (deviceClock_.judge(packet.stampMs, clock_.monotonicUs())) {
    case DsaClock::Verdict::kAccept:
      return deliver(std::move(frame), deviceClock_.deviceMs(), packet.packetBytes);
    case DsaClock::Verdict::kReplaceHeld:
      ++suspect_;
      [[fallthrough]];
    case DsaClock::Verdict::kHold:
      held_ = Held{std::move(frame), packet};
      break;
    case DsaClock::Verdict::kDropHeld:
      ++suspect_;
      held_.reset();
      deliver(std::move(frame), deviceClock_.deviceMs(), packet.packetBytes);
      break;
    case DsaClock::Verdict::kRestarted:
      eventNow("link", "the tactile controller's clock started anew: it was switched off and on");
      loss_.reset();
      leastOffsetUs_ = {};
      if (held_) {
        Held held = std::move(*held_);
        held_.reset();
        deliver(std::move(held.frame), deviceClock_.heldMs(), held.packet.packetBytes);
      }
      deliver(std::move(frame), deviceClock_.deviceMs(), packet.packetBytes);
      break;
  }
  updateStatus([&](PortStatus& status) { status.suspect = suspect_; });
}

void TactileLink::deliver(TactileFrame&& frame, std::int64_t deviceMs, std::size_t packetBytes) {
  frame.deviceMs = deviceMs;
  const std::int64_t hostUs = frame.hostUs;
  const std::uint64_t missing = loss_.next(deviceMs, packetBytes);
  if (gapFromUs_) {
    lostInGap_ += missing;
    endGap(hostUs);
  }
  lastFrameUs_ = clock_.monotonicUs();
  restarts_ = 0;
  ++frames_;
  ++windowFrames_;
  measureAge(hostUs, deviceMs);
  updateStatus([&](PortStatus& status) {
    status.items = frames_;
    status.lost += missing;
    status.lastItemUs = hostUs;
    status.state = PortState::kStreaming;
    status.message.clear();
  });
  sink_->onFrame(std::move(frame));
}

void TactileLink::measureAge(std::int64_t hostUs, std::int64_t deviceMs) {
  const std::int64_t offsetUs = hostUs - deviceMs * 1000;
  if (hostUs - offsetWindowUs_ > kOffsetWindowUs) {
    offsetWindowUs_ = hostUs;
    leastOffsetUs_[1] = std::exchange(leastOffsetUs_[0], std::nullopt);
  }
  leastOffsetUs_[0] = std::min(leastOffsetUs_[0].value_or(offsetUs), offsetUs);
  const std::int64_t least =
      std::min(*leastOffsetUs_[0], leastOffsetUs_[1].value_or(*leastOffsetUs_[0]));
  updateStatus(
      [&](PortStatus& status) { status.ageMs = static_cast<double>(offsetUs - least) / 1000.0; });
}

// --- silence and noise ------------------------------------------------------------------------------

void TactileLink::watchSilence() {
  const std::int64_t nowUs = clock_.monotonicUs();
  const auto limitUs = std::max(
      kSilentUs, static_cast<std::int64_t>(kSilentPeriods * 1000.0 * loss_.scanPeriodMs()));
  if (nowUs - lastFrameUs_ < limitUs) return;
  if (!gapFromUs_) {
    controller_->flush();  // a packet behind a corrupt size
    if (clock_.monotonicUs() - lastFrameUs_ < limitUs) return;
    gapFromUs_ = lastStampUs_ != 0 ? lastStampUs_ : time_.nowUs();
    setState(PortState::kSilent,
             port_ + ": no frames for " +
                 numberText(std::round(static_cast<double>(nowUs - lastFrameUs_) / 1e5) / 10.0) +
                 " s; check power and cable of the tactile controller");
    eventNow("alarm", "no frames from the tactile controller");
  }
  if (nowUs - lastFrameUs_ < kWakeUs * (restarts_ + 1)) return;
  if (restarts_ >= kWakeTries)
    throw DeviceError(
        DeviceFault::kSilent, port_, "the tactile controller is silent; check its power and cable");
  ++restarts_;
  // Perhaps it was switched off and on, and waits for a start.
  if (controller_->stopStreamOnce(milliseconds(400))) {
    deviceClock_.reset();
    controller_->startStream();
  }
}

void TactileLink::endGap(std::int64_t nowUs) {
  const std::int64_t fromUs = *std::exchange(gapFromUs_, std::nullopt);
  const double seconds = static_cast<double>(nowUs - fromUs) / 1e6;
  event("gap",
        "no frames for " + numberText(std::round(seconds * 1000.0) / 1000.0) + " s",
        fromUs,
        nowUs,
        {},
        "{\"seconds\":" + numberText(seconds) + ",\"lost\":" + std::to_string(lostInGap_) + "}");
  lostInGap_ = 0;
}

// Now and then a wrong checksum is normal. Every tenth means that both ends are out of step, or that
// another program writes to the port.
void TactileLink::watchChecksums() {
  const std::int64_t nowUs = clock_.monotonicUs();
  if (nowUs - windowFromUs_ < kChecksumWindowUs) return;
  const std::uint64_t bad = controller_->stats().packets.badChecksums;
  const std::uint64_t newBad = bad - std::min(bad, windowBad_);
  const std::uint64_t frames = std::exchange(windowFrames_, 0);
  windowBad_ = bad;
  windowFromUs_ = nowUs;
  if (newBad < kBadEnough ||
      static_cast<double>(newBad) < kBadShare * static_cast<double>(newBad + frames))
    return;
  if (lastCureUs_ != 0 && nowUs - lastCureUs_ < kCureEveryUs) return;
  lastCureUs_ = nowUs;
  eventNow(
      "alarm",
      std::to_string(newBad) + " bad checksums in 3 s: cable, or a second program on the port");
  if (std::exchange(restartedForChecksums_, !restartedForChecksums_))
    throw DeviceError(DeviceFault::kProtocol, port_, "too many bad checksums: opening it anew");
  controller_->whilePaused([] {});
}

// --- settings ---------------------------------------------------------------------------------------

void TactileLink::applySetting(std::size_t matrix, const Wanted& wanted) {
  if (wanted.sensitivity) controller_->setSensitivity(matrix, *wanted.sensitivity);
  if (wanted.thresholdCounts) controller_->setThreshold(matrix, *wanted.thresholdCounts);
  if (wanted.dynamicMask) controller_->setDynamicMask(matrix, *wanted.dynamicMask);
}

void TactileLink::restoreSettings() {
  bool restored = false;
  for (const auto& [matrix, wanted] : wanted_) {
    if (matrix >= controller_->facts().matrices.size()) continue;
    const DsaMatrixFacts& is = controller_->facts().matrices[matrix];
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
        "the settings of before were restored",
        nowUs,
        nowUs,
        std::nullopt,
        settingsJson());
}

// What holds from now on: a recording can be read without knowing what went before.
std::string TactileLink::settingsJson() const {
  Json matrices = Json::array();
  for (const DsaMatrixFacts& matrix : controller_->facts().matrices)
    matrices.push(Json::object()
                      .set("sensitivity", matrix.sensitivity)
                      .set("threshold_counts", matrix.thresholdCounts.value_or(0)));
  return Json::object().set("matrices", matrices).text(-1);
}

void TactileLink::change(const Wanted& wanted, std::optional<int> matrix, const std::string& text) {
  const std::size_t matrices = controller_->facts().matrices.size();
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
  loss_.reset();  // the rate may be another one now, and the pause is no loss
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
