// Packets, streaming, booting and commands of the emulated tactile controller.
#include "palpate/emulator/dsa_server.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/core/byte_order.h"
#include "palpate/core/byte_reader.h"
#include "palpate/core/number_text.h"
#include "palpate/device/weiss_checksum.h"

#include "emulator/dsa_wire.h"
#include "emulator/wire_writer.h"

namespace palpate {
namespace {

// Delay after which a stream counts as interrupted and continues from the present time, as the scan
// of a real controller does.
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

// Payload size of the largest request, which writes a mask [bytes].
std::size_t largestRequest(const SensorLayout& layout) {
  std::size_t largest = 16;
  for (const MatrixLayout& matrix : layout.matrices())
    largest = std::max(largest, 2 + (matrix.numCells() + 7) / 8);
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

// Flags of the settings.
constexpr unsigned kPersistent = 0x80, kAllMatrices = 0x02, kReset = 0x01;
constexpr int kDsaCommandsMaxCounts = 4095;

std::vector<std::byte> maskBytes(const Mask& mask) {
  std::vector<std::byte> bytes((mask.size() + 7) / 8);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i] != 0) bytes[i / 8] |= static_cast<std::byte>(1u << i % 8);
  return bytes;
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
  counts_.resize(model_.hand().layout->numCells());
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

void DsaServer::onReceiveTimeout() {
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
    // In a longer run of AA the packet begins with the last three, because no id is AA.
    if (at + 3 < input.size() && isPreamble(at + 3)) {
      ++at;
      continue;
    }
    const auto rest = input.subspan(at);
    if (rest.size() < kDsaHeaderBytes) break;
    const unsigned id = u8At(rest, 3);
    const std::size_t length = littleEndian(rest.subspan(4, 2));
    if (length > largest) {
      answerError(id, kDsaFormatError);
      at += 3;
      continue;
    }
    const std::size_t total = kDsaHeaderBytes + length + (length > 0 ? 2 : 0);
    if (rest.size() < total) break;
    if (length > 0 &&
        weissChecksum(rest.subspan(3, 3 + length)) != littleEndian(rest.subspan(total - 2, 2))) {
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
  // An error with id 0 would look like a frame.
  if (id != kDsaFrame) answer(id, std::move(WireWriter().u16(code).data()));
}

void DsaServer::acquire(Payload payload) {
  if (payload.size() != 3)
    return answerError(kDsaAcquire, payload.size() < 3 ? kDsaTooFewParameters : kDsaFormatError);
  constexpr unsigned kAcquire = 0x80, kSingleShot = 0x40, kRunLength = 0x01;
  const unsigned flags = u8At(payload, 0);
  const std::uint64_t rate = littleEndian(payload.subspan(1, 2));
  const bool wasIdle = !wantsFrame();
  const bool oldFirmware = options_.firmware <= 288 && options_.firmware != 269;
  if ((flags & kAcquire) == 0) {
    push_ = false;
    singles_ = 0;
  } else if (rate == 0 && !oldFirmware) {
    singles_ = std::min(push_ ? 1 : singles_ + 1, kMaxSingles);
    push_ = false;
  } else {
    // The requested rate is ignored: it streams at its own rate.
    push_ = (flags & kSingleShot) == 0;
    singles_ = push_ ? 0 : 1;
  }
  runLength_ = (flags & kRunLength) != 0;
  if (wasIdle) {
    const double now = static_cast<double>(nowUs_);
    // With a fixed rate the scans continue at their times; otherwise the command starts one.
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
    // The query is sent three times within 0.82 s, about one second before the controller is ready;
    // at shorter intervals if it boots faster.
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
  // Clients detect new frames by a changed stamp.
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

void DsaServer::execute(unsigned id, Payload payload) {
  const auto bare = [&] { return payload.empty() || (answerError(id, kDsaFormatError), false); };
  switch (id) {
    case kDsaController:
      return bare() ? describeController() : void();
    case kDsaSensor:
      return bare() ? describeSensor() : void();
    case kDsaAcquire:
      return acquire(payload);
    case kDsaReadMask:
      return readMask(payload);
    case kDsaDescriptor:
      return sendDescriptorText(payload);
    case kDsaLoop:
      return answer(id, std::move(WireWriter().u16(0).bytes(payload).data()));
    case kDsaState:
      return bare() ? answerError(id, kDsaSuccess) : void();
    case kDsaMatrix:
      return describeMatrix(payload);
    case kDsaSetSensitivity:
      return setSensitivity(payload);
    case kDsaGetSensitivity:
      return getSensitivity(payload);
    case kDsaSetThreshold:
      return setThreshold(payload);
    case kDsaGetThreshold:
      return getThreshold(payload);
    case kDsaWriteMask:
      return writeMask(payload);
    case kDsaPropertiesRate:
    case kDsaSetProperties:
    case kDsaGetProperties:
    case kDsaFeatures:
      return answerError(id, kDsaUnsupported);
    default:
      return answerError(id, kDsaUnknownCommand);
  }
}

void DsaServer::describeController() {
  constexpr unsigned kOperable = 0x80, kRunning = 0x40, kHardware = 0x10, kInterfaces = 0x70;
  WireWriter out;
  out.u16(0).u32(options_.serial).u8(kHardware).u16(options_.firmware);
  out.u8(kOperable | (wantsFrame() ? kRunning : 0)).u8(kInterfaces);
  out.u8(0).u8(0).u32(0);  // type, active interface, CAN bit rate
  out.u8(0);               // CAN id: one byte, unlike in the documentation
  answer(kDsaController, std::move(out.data()));
}

void DsaServer::describeSensor() {
  WireWriter out;
  out.u16(0).u16(static_cast<unsigned>(model_.hand().layout->numMatrices()));
  out.u16(options_.generatedBy).u8(1).u32(options_.serial).u8(0);
  answer(kDsaSensor, std::move(out.data()));
}

void DsaServer::describeMatrix(Payload payload) {
  const HandDescription& hand = model_.hand();
  if (payload.size() != 1)
    return answerError(kDsaMatrix, payload.empty() ? kDsaTooFewParameters : kDsaFormatError);
  const auto index = std::to_integer<std::size_t>(payload[0]);
  if (index >= hand.layout->numMatrices()) return answerError(kDsaMatrix, kDsaIndexOutOfBounds);
  const MatrixLayout& matrix = hand.layout->matrix(index);
  WireWriter out;
  out.u16(0).f32(matrix.pitchMm.x).f32(matrix.pitchMm.y);
  out.u16(static_cast<unsigned>(matrix.columns)).u16(static_cast<unsigned>(matrix.rows));
  constexpr unsigned kUniqueId[] = {0x10, 0x22, 0x33, 0x44, 0x55, 0x66};  // any distinct bytes
  for (std::size_t i = 0; i < 6; ++i)
    out.u8(kUniqueId[i] + (i == 0 ? static_cast<unsigned>(index) : 0));
  out.u16(0).u8(1);
  // A flat layout for display: fingers 50 mm apart, distal matrices above.
  constexpr double kFingerMm = 50.0, kPartMm = 32.0;
  const MatrixDescription& where = hand.matrices.at(index);
  out.f32(kFingerMm * (where.finger - 1)).f32(where.segment == "distal" ? kPartMm : -kPartMm);
  out.f32(0.0).f32(0.0).f32(0.0).f32(0.0);  // z; rotations
  out.u32(static_cast<std::uint32_t>(hand.maximumCounts)).u8(0);
  answer(kDsaMatrix, std::move(out.data()));
}

void DsaServer::readMask(Payload payload) {
  if (payload.size() != 2)
    return answerError(kDsaReadMask, payload.size() < 2 ? kDsaTooFewParameters : kDsaFormatError);
  const auto type = std::to_integer<unsigned>(payload[0]);
  const auto index = std::to_integer<std::size_t>(payload[1]);
  if (type > 1) return answerError(kDsaReadMask, kDsaInvalidParameter);
  if (index >= model_.settings().size()) return answerError(kDsaReadMask, kDsaIndexOutOfBounds);
  const Mask& mask = type == 0 ? model_.hand().layout->matrix(index).staticMask
                               : model_.settings()[index].dynamicMask;
  answer(kDsaReadMask, std::move(WireWriter().u16(0).bytes(maskBytes(mask)).data()));
}

void DsaServer::writeMask(Payload payload) {
  if (payload.size() < 2) return answerError(kDsaWriteMask, kDsaTooFewParameters);
  const auto index = std::to_integer<std::size_t>(payload[1]);
  // The static mask describes the hardware and can't be written.
  if (payload[0] == std::byte{0}) return answerError(kDsaWriteMask, kDsaAccessDenied);
  if (payload[0] != std::byte{1}) return answerError(kDsaWriteMask, kDsaInvalidParameter);
  if (index >= model_.settings().size()) return answerError(kDsaWriteMask, kDsaIndexOutOfBounds);
  Mask& mask = model_.settings()[index].dynamicMask;
  const Payload bits = payload.subspan(2);
  const std::size_t wanted = (mask.size() + 7) / 8;
  if (bits.size() != wanted)
    return answerError(kDsaWriteMask,
                       bits.size() < wanted ? kDsaTooFewParameters : kDsaFormatError);
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = static_cast<std::uint8_t>(std::to_integer<unsigned>(bits[i / 8]) >> i % 8 & 1u);
  answerError(kDsaWriteMask, kDsaSuccess);
}

void DsaServer::sendDescriptorText(Payload payload) {
  const HandDescription& hand = model_.hand();
  if (payload.empty()) return answerError(kDsaDescriptor, kDsaTooFewParameters);
  if (payload.size() > 2) return answerError(kDsaDescriptor, kDsaFormatError);
  std::string text;
  if (payload[0] == std::byte{0}) {
    text = hand.name;
  } else if (payload[0] != std::byte{1}) {
    return answerError(kDsaDescriptor, kDsaInvalidParameter);
  } else if (payload.size() < 2) {
    return answerError(kDsaDescriptor, kDsaTooFewParameters);
  } else {
    const auto index = std::to_integer<std::size_t>(payload[1]);
    if (index >= hand.layout->numMatrices())
      return answerError(kDsaDescriptor, kDsaIndexOutOfBounds);
    text = hand.matrixName(index);
  }
  answer(kDsaDescriptor, std::move(WireWriter().u16(0).text(text).data()));
}

void DsaServer::setSensitivity(Payload payload) {
  ByteReader in(payload);
  const unsigned flags = in.u8();
  const std::size_t index = in.u8();
  const double value = static_cast<double>(in.f32());
  auto& settings = model_.settings();
  const bool silent = (flags & kPersistent) != 0;  // as the firmware, which sends no answer here
  const auto fail = [&](unsigned code) {
    return silent ? void() : answerError(kDsaSetSensitivity, code);
  };
  if (!in.ok()) return fail(kDsaTooFewParameters);
  if (in.remaining() > 0) return fail(kDsaFormatError);
  const bool all = (flags & kAllMatrices) != 0, reset = (flags & kReset) != 0;
  if (!all && index >= settings.size()) return fail(kDsaIndexOutOfBounds);
  if (!reset && !(value >= 0.0 && value <= 1.0)) return fail(kDsaRangeError);
  for (std::size_t m = 0; m < settings.size(); ++m) {
    if (!all && m != index) continue;
    settings[m].sensitivity = reset ? settings[m].factorySensitivity : value;
    if (silent) stored_[m].sensitivity = settings[m].sensitivity;
  }
  fail(kDsaSuccess);
}

void DsaServer::getSensitivity(Payload payload) {
  if (payload.size() != 1)
    return answerError(kDsaGetSensitivity,
                       payload.empty() ? kDsaTooFewParameters : kDsaFormatError);
  const auto index = std::to_integer<std::size_t>(payload[0]);
  if (index >= model_.settings().size())
    return answerError(kDsaGetSensitivity, kDsaIndexOutOfBounds);
  constexpr unsigned kAdjustable = 0x02;
  constexpr unsigned kLastWithoutReading = 218;
  const MatrixSetting& setting = model_.settings()[index];
  const bool reads = options_.firmware > kLastWithoutReading;
  WireWriter out;
  out.u16(0).u8(kAdjustable).f32(reads ? setting.sensitivity : 0.5);
  answer(kDsaGetSensitivity, std::move(out.f32(setting.factorySensitivity).data()));
}

void DsaServer::setThreshold(Payload payload) {
  constexpr unsigned kFirstWithThresholds = 268;
  if (options_.firmware < kFirstWithThresholds)
    return answerError(kDsaSetThreshold, kDsaUnknownCommand);
  ByteReader in(payload);
  const unsigned flags = in.u8();
  const std::size_t index = in.u8();
  const int value = in.u16();
  auto& settings = model_.settings();
  const bool silent = (flags & kPersistent) != 0;
  const auto fail = [&](unsigned code) {
    return silent ? void() : answerError(kDsaSetThreshold, code);
  };
  if (!in.ok()) return fail(kDsaTooFewParameters);
  if (in.remaining() > 0) return fail(kDsaFormatError);
  const bool all = (flags & kAllMatrices) != 0, reset = (flags & kReset) != 0;
  if (!all && index >= settings.size()) return fail(kDsaIndexOutOfBounds);
  if (!reset && value > kDsaCommandsMaxCounts) return fail(kDsaRangeError);
  for (std::size_t m = 0; m < settings.size(); ++m) {
    if (!all && m != index) continue;
    settings[m].thresholdCounts = reset ? settings[m].factoryThresholdCounts : value;
    if (silent) stored_[m].thresholdCounts = settings[m].thresholdCounts;
  }
  fail(kDsaSuccess);
}

void DsaServer::getThreshold(Payload payload) {
  constexpr unsigned kFirstWithThresholds = 268;
  if (options_.firmware < kFirstWithThresholds)
    return answerError(kDsaGetThreshold, kDsaUnknownCommand);
  if (payload.size() != 1)
    return answerError(kDsaGetThreshold, payload.empty() ? kDsaTooFewParameters : kDsaFormatError);
  const auto index = std::to_integer<std::size_t>(payload[0]);
  if (index >= model_.settings().size()) return answerError(kDsaGetThreshold, kDsaIndexOutOfBounds);
  const auto threshold = static_cast<unsigned>(model_.settings()[index].thresholdCounts);
  answer(kDsaGetThreshold, std::move(WireWriter().u16(0).u16(threshold).data()));
}

}  // namespace palpate
