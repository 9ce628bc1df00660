// Packets, streaming and booting; the single commands stand in dsa_commands.cpp.
#include "palpate/emulator/dsa_server.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/device/weiss_checksum.h"

#include "emulator/dsa_wire.h"
#include "emulator/wire_writer.h"

namespace palpate {
namespace {

// A stream that is later than this has been held up: it goes on from now, as a real scan would.
constexpr double kLateUs = 250'000.0;
constexpr unsigned kMaxSingles = 255;
constexpr unsigned kBootQueries = 3;

std::vector<std::byte> packet(unsigned id, std::span<const std::byte> payload) {
  WireWriter out;
  out.u8(kDsaPreamble).u8(kDsaPreamble).u8(kDsaPreamble).u8(id);
  out.u16(static_cast<unsigned>(payload.size())).bytes(payload);
  return std::move(out.u16(weissChecksum(std::span(out.data()).subspan(3))).data());
}

unsigned u8At(std::span<const std::byte> bytes, std::size_t at) {
  return std::to_integer<unsigned>(bytes[at]);
}

// The largest request is the write of a mask.
std::size_t largestRequest(const SensorLayout& layout) {
  std::size_t largest = 16;
  for (const MatrixLayout& matrix : layout.matrices())
    largest = std::max(largest, 2 + (matrix.numPlaces() + 7) / 8);
  return largest;
}

void appendRunLength(std::span<const std::uint16_t> counts, WireWriter& out) {
  constexpr std::size_t kMaxRun = 15;
  for (std::size_t i = 0; i < counts.size();) {
    std::size_t run = 1;
    while (run < kMaxRun && i + run < counts.size() && counts[i + run] == counts[i]) ++run;
    out.u16(static_cast<unsigned>(run << 12) | counts[i]);
    i += run;
  }
}

}  // namespace

double dsaScanUs(std::size_t enabledTaxels) {
  constexpr double kTaxels[] = {2.0, 78.0, 456.0};
  constexpr double kScanUs[] = {13'200.0, 17'700.0, 31'500.0};
  const auto n = static_cast<double>(enabledTaxels);
  if (n <= kTaxels[0]) return kScanUs[0];
  for (int i = 1; i < 3; ++i)
    if (n <= kTaxels[i])
      return kScanUs[i - 1] +
             (kScanUs[i] - kScanUs[i - 1]) * (n - kTaxels[i - 1]) / (kTaxels[i] - kTaxels[i - 1]);
  return kScanUs[2];
}

DsaServer::DsaServer(HandModel& model, const DsaServerOptions& options)
    : model_(model), options_(options), stored_(model.settings()) {
  if (options_.frameHz && !(*options_.frameHz >= 0.01 && *options_.frameHz <= 1000.0))
    throw std::invalid_argument("frame rate " + numberText(*options_.frameHz) +
                                " is outside of 0.01..1000 Hz");
  counts_.resize(model_.hand().layout->numPlaces());
  powerCycle(0, options_.bootS);
}

void DsaServer::powerCycle(std::int64_t nowUs, double bootS) {
  model_.settings() = stored_;
  input_.clear();
  push_ = false;
  singles_ = 0;
  lastMs_.reset();
  nowUs_ = switchedOnUs_ = nowUs;
  bootEndUs_ = nowUs + static_cast<std::int64_t>(std::max(bootS, 0.0) * 1e6);
  bootQueries_ = bootEndUs_ > nowUs ? 0 : kBootQueries;
}

void DsaServer::receive(std::span<const std::byte> bytes, std::int64_t nowUs) {
  nowUs_ = std::max(nowUs_, nowUs);
  if (booting(nowUs_)) return;
  input_.insert(input_.end(), bytes.begin(), bytes.end());
  parse();
}

void DsaServer::quiet() {
  while (!input_.empty()) {
    input_.erase(input_.begin());
    parse();
  }
}

void DsaServer::parse() {
  const std::size_t largest = largestRequest(*model_.hand().layout);
  std::size_t at = 0;
  const std::span<const std::byte> input(input_);
  const auto isPreamble = [&](std::size_t i) {
    return i >= input.size() || u8At(input, i) == kDsaPreamble;
  };
  while (at < input.size()) {
    if (!isPreamble(at) || !isPreamble(at + 1) || !isPreamble(at + 2)) {
      ++at;
      continue;
    }
    // A longer run of AA: the packet begins with its last three, for no id is AA.
    if (at + 3 < input.size() && isPreamble(at + 3)) {
      ++at;
      continue;
    }
    const auto rest = input.subspan(at);
    if (rest.size() < kDsaHeaderBytes) break;
    const unsigned id = u8At(rest, 3);
    const std::size_t length = u8At(rest, 4) | u8At(rest, 5) << 8;
    if (length > largest) {
      answerError(id, kDsaFormatError);
      at += 3;
      continue;
    }
    const std::size_t total = kDsaHeaderBytes + length + (length > 0 ? 2 : 0);
    if (rest.size() < total) break;
    if (length > 0 && weissChecksum(rest.subspan(3, 3 + length)) !=
                          (u8At(rest, total - 2) | u8At(rest, total - 1) << 8)) {
      answerError(id, kDsaChecksumError);
      at += 3;
      continue;
    }
    execute(id, rest.subspan(kDsaHeaderBytes, length));
    at += total;
  }
  input_.erase(input_.begin(), input_.begin() + static_cast<std::ptrdiff_t>(at));
}

void DsaServer::answer(unsigned id, std::vector<std::byte> payload) {
  output_.push_back({.bytes = packet(id, payload), .checksummed = true});
}

void DsaServer::answerError(unsigned id, unsigned code) {
  // Under id 0 it would look like a frame.
  if (id != kDsaFrame) answer(id, std::move(WireWriter().u16(code).data()));
}

void DsaServer::acquire(Payload payload) {
  if (payload.size() != 3)
    return answerError(kDsaAcquire, payload.size() < 3 ? kDsaTooFewParameters : kDsaFormatError);
  constexpr unsigned kAcquire = 0x80, kSingleShot = 0x40, kRunLength = 0x01;
  const unsigned flags = u8At(payload, 0);
  const unsigned rate = u8At(payload, 1) | u8At(payload, 2) << 8;
  const bool wasIdle = !wantsFrame();
  const bool oldFirmware = options_.firmware <= 288 && options_.firmware != 269;
  if ((flags & kAcquire) == 0) {
    push_ = false;
    singles_ = 0;
  } else if (rate == 0 && !oldFirmware) {
    singles_ = std::min(push_ ? 1 : singles_ + 1, kMaxSingles);
    push_ = false;
  } else {
    // Whatever the rate is, it streams as fast as it can.
    push_ = (flags & kSingleShot) == 0;
    singles_ = push_ ? 0 : 1;
  }
  runLength_ = (flags & kRunLength) != 0;
  if (wasIdle) {
    const double now = static_cast<double>(nowUs_);
    // At a given rate the scans go on by themselves; otherwise the command starts one.
    nextFrameUs_ = options_.frameHz ? std::max(now, nextFrameUs_) : now + periodUs();
  }
  answerError(kDsaAcquire, kDsaSuccess);
}

double DsaServer::periodUs() const {
  if (options_.frameHz) return 1e6 / *options_.frameHz;
  if (const auto intervalS = model_.nextIntervalS()) return *intervalS * 1e6;
  std::size_t enabled = 0;
  for (const MatrixSetting& setting : model_.settings())
    enabled += static_cast<std::size_t>(std::count_if(setting.dynamicMask.begin(),
                                                      setting.dynamicMask.end(),
                                                      [](std::uint8_t on) { return on != 0; }));
  return dsaScanUs(enabled);
}

std::optional<std::int64_t> DsaServer::nextFrameUs(std::int64_t lineFreeUs) const {
  if (!wantsFrame() || booting(nowUs_)) return std::nullopt;
  return std::max(static_cast<std::int64_t>(std::ceil(nextFrameUs_)), lineFreeUs);
}

std::optional<std::int64_t> DsaServer::nextUs(std::int64_t lineFreeUs) const {
  if (bootQueries_ < kBootQueries) {
    // About a second before it is ready, three times within 0.82 s; closer together when it boots
    // faster.
    const double readyUs = static_cast<double>(bootEndUs_ - switchedOnUs_);
    const double leadUs = std::min(1e6, readyUs);
    return bootEndUs_ - static_cast<std::int64_t>(leadUs * (1.0 - 0.41 * bootQueries_));
  }
  return nextFrameUs(lineFreeUs);
}

void DsaServer::advance(std::int64_t nowUs, std::int64_t lineFreeUs) {
  scanned_.reset();
  nowUs_ = std::max(nowUs_, nowUs);
  while (bootQueries_ < kBootQueries && *nextUs(lineFreeUs) <= nowUs_) {
    output_.push_back({.bytes = std::move(WireWriter().text("\x1B[5n").data())});
    ++bootQueries_;
  }
  const auto due = nextFrameUs(lineFreeUs);
  if (!due || *due > nowUs_) return;
  double at = std::max(nextFrameUs_, static_cast<double>(lineFreeUs));
  if (at + kLateUs < static_cast<double>(nowUs_)) at = static_cast<double>(nowUs_);
  nextFrameUs_ = at;
  sendFrame(static_cast<std::int64_t>(at));
}

void DsaServer::sendFrame(std::int64_t atUs) {
  model_.advanceTo(static_cast<double>(atUs) * 1e-6);
  model_.scan(counts_);
  for (std::uint16_t& count : counts_) count &= 0x0FFFu;
  auto ms = options_.startMs + static_cast<std::uint32_t>((atUs - switchedOnUs_) / 1000);
  // Clients detect new data by a changed stamp.
  if (lastMs_ && static_cast<std::int32_t>(ms - *lastMs_) <= 0) ms = *lastMs_ + 1;
  lastMs_ = ms;
  WireWriter payload;
  payload.u32(ms).u8(runLength_ ? 1 : 0);
  if (runLength_) {
    appendRunLength(counts_, payload);
  } else {
    for (const std::uint16_t count : counts_) payload.u16(count);
  }
  LineMessage message{
      .bytes = packet(kDsaFrame, payload.data()), .checksummed = true, .frame = numFrames_};
  scanned_ = ScannedFrame{numFrames_, ms, atUs, message.bytes.size()};
  ++numFrames_;
  output_.push_back(std::move(message));
  if (!push_) --singles_;
  const bool recorded = model_.nextIntervalS().has_value();
  const double onLineUs =
      recorded ? 0.0 : options_.lineByteUs * static_cast<double>(scanned_->bytes);
  nextFrameUs_ += std::max(periodUs(), onLineUs);
}

std::vector<LineMessage> DsaServer::take() { return std::exchange(output_, {}); }

}  // namespace palpate
