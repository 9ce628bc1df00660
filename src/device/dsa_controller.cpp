#include "palpate/device/dsa_controller.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "palpate/core/byte_order.h"
#include "palpate/core/error.h"
#include "palpate/core/time.h"

#include "device/dsa_records.h"
#include "device/wrong_controller_error.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;

constexpr unsigned kAcquire = 0x80;
constexpr unsigned kDsaControllerRunLength = 0x01;
// Code of a first answer; a second answer with the final code follows.
constexpr int kPending = 25;
constexpr std::size_t kDsaControllerReadBytes = 4096;

unsigned errorWord(const std::vector<std::byte>& payload) {
  return static_cast<unsigned>(littleEndian(std::span(payload).first(2)));
}

using std::chrono::milliseconds;

constexpr unsigned kDsaSettingsRunLength = 0x01;
constexpr unsigned kPersistent = 0x80;
constexpr unsigned kResetToFactory = 0x01;
constexpr int kDsaSettingsMaxCounts = 4095;

}  // namespace

std::string dsaErrorText(int code) {
  static constexpr std::array<const char*, 28> kTexts = {"success",
                                                         "function or data not available",
                                                         "no sensor connected",
                                                         "not initialised",
                                                         "acquisition already running",
                                                         "feature not supported",
                                                         "inconsistent parameters",
                                                         "timeout",
                                                         "read error",
                                                         "write error",
                                                         "insufficient resources",
                                                         "checksum error",
                                                         "not enough parameters",
                                                         "unknown command",
                                                         "command format error",
                                                         "access denied",
                                                         "interface already open",
                                                         "command failed",
                                                         "command aborted",
                                                         "invalid handle",
                                                         "device not found",
                                                         "device not opened",
                                                         "input/output error",
                                                         "invalid parameter",
                                                         "index out of bounds",
                                                         "pending",
                                                         "overrun",
                                                         "range error"};
  if (code >= 0 && static_cast<std::size_t>(code) < kTexts.size())
    return kTexts[static_cast<std::size_t>(code)];
  return "unknown error " + std::to_string(code);
}

std::string DsaControllerInfo::firmwareText() const {
  if (firmwareVersion < 0x1000) return std::to_string(firmwareVersion);
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4)
    text += (text.empty() ? "" : ".") + std::to_string(firmwareVersion >> shift & 0xF);
  return text;
}

SensorLayout DsaControllerInfo::layout() const {
  std::vector<MatrixLayout> layouts;
  for (const DsaMatrixInfo& matrix : matrices) layouts.push_back(matrix.layout);
  return SensorLayout(std::move(layouts));
}

DsaController::DsaController(ByteChannel& channel,
                             FrameSink frames,
                             const Clock& clock,
                             DsaControllerOptions options)
    : channel_(channel),
      frames_(std::move(frames)),
      clock_(clock),
      options_(std::move(options)),
      buffer_(kDsaControllerReadBytes) {}

// --- Reading

bool DsaController::take(const DsaPacket& packet) {
  if (packet.id == DsaId::kFrame) {
    ++framesTaken_;
    frames_(packet.payload);
    return false;
  }
  constexpr std::size_t kMaxAnswers = 16;
  if (answers_.size() == kMaxAnswers) {
    answers_.pop_front();
    ++strayAnswers_;
  }
  answers_.push_back({packet.id, Bytes(packet.payload.begin(), packet.payload.end())});
  return true;
}

std::size_t DsaController::poll(milliseconds timeout) {
  const std::size_t n = channel_.read(buffer_, timeout);
  parser_.push(std::span<const std::byte>(buffer_).first(n),
               [this](const DsaPacket& packet) { take(packet); });
  return n;
}

void DsaController::flush() {
  parser_.flush([this](const DsaPacket& packet) { take(packet); });
}

std::optional<DsaController::Answer> DsaController::awaitAnswer(DsaId id, milliseconds limit) {
  const std::int64_t endUs = clock_.monotonicUs() + usOf(limit);
  while (true) {
    while (!answers_.empty()) {
      Answer answer = std::move(answers_.front());
      answers_.pop_front();
      if (answer.id == id && answer.payload.size() >= 2) return answer;
      ++strayAnswers_;  // late, or the answer to a request that was given up
    }
    if (options_.isCancelled && options_.isCancelled())
      throw DeviceError(DeviceFault::kSilent, channel_.name(), "given up");
    const std::int64_t leftUs = endUs - clock_.monotonicUs();
    if (leftUs <= 0) return std::nullopt;
    poll(std::min(milliseconds(leftUs / 1000 + 1), milliseconds(100)));
  }
}

void DsaController::awaitSilence(milliseconds silence, milliseconds limit) {
  const std::int64_t endUs = clock_.monotonicUs() + usOf(limit);
  std::int64_t quietSinceUs = clock_.monotonicUs();
  while (clock_.monotonicUs() - quietSinceUs < usOf(silence)) {
    if (clock_.monotonicUs() > endUs)
      throw DeviceError(DeviceFault::kProtocol,
                        channel_.name(),
                        "the tactile controller doesn't stop sending; switch it off and on");
    if (options_.isCancelled && options_.isCancelled())
      throw DeviceError(DeviceFault::kSilent, channel_.name(), "given up");
    const std::int64_t leftUs = usOf(silence) - (clock_.monotonicUs() - quietSinceUs);
    if (poll(milliseconds(leftUs / 1000 + 1)) > 0) quietSinceUs = clock_.monotonicUs();
  }
  flush();
}

// --- Asking

void DsaController::send(DsaId id, const Bytes& payload) {
  channel_.write(dsaRequest(id, payload));
}

void DsaController::dropLateAnswers() {
  // Limit of the number of reads, because a stream never ends.
  constexpr int kMaxReads = 4;
  for (int i = 0; i < kMaxReads && poll(milliseconds(0)) > 0; ++i) {
  }
  strayAnswers_ += answers_.size();
  answers_.clear();
}

void DsaController::failSilent(const std::string& what) {
  throw DeviceError(DeviceFault::kSilent, channel_.name(), what);
}

DsaController::Bytes DsaController::request(DsaId id,
                                            const Bytes& payload,
                                            std::size_t answerBytes) {
  for (int attempt = 0; attempt < options_.tries; ++attempt) {
    if (attempt > 0) {
      // A late answer to the previous try must not be taken for the answer to another request.
      awaitSilence(milliseconds(50), options_.answerTimeout);
      ++retries_;
    }
    dropLateAnswers();
    send(id, payload);
    std::optional<Answer> answer = awaitAnswer(id, options_.answerTimeout);
    if (answer && errorWord(answer->payload) == kPending)
      answer = awaitAnswer(id, options_.answerTimeout);
    if (!answer) continue;
    if (const unsigned code = errorWord(answer->payload); code != 0)
      throw DeviceError(DeviceFault::kRefused,
                        channel_.name(),
                        "the tactile controller refused command " +
                            std::to_string(static_cast<int>(id)) + ": " +
                            dsaErrorText(static_cast<int>(code)));
    if (answerBytes != 0 && answer->payload.size() != answerBytes)
      throw DeviceError(DeviceFault::kProtocol,
                        channel_.name(),
                        "an answer to command " + std::to_string(static_cast<int>(id)) + " has " +
                            std::to_string(answer->payload.size()) + " bytes instead of " +
                            std::to_string(answerBytes));
    return std::move(answer->payload);
  }
  failSilent("the tactile controller gave no answer to command " +
             std::to_string(static_cast<int>(id)) + "; check cable and power");
}

void DsaController::acquisition(bool on, int rate) {
  Bytes payload;
  const unsigned flags = (on ? kAcquire : 0u) | (options_.runLength ? kDsaControllerRunLength : 0u);
  payload.push_back(static_cast<std::byte>(flags));
  appendLittleEndian(payload, static_cast<unsigned>(rate), 2);
  request(DsaId::kAcquisition, payload, 2);
}

// --- Streaming

void DsaController::startStream() {
  acquisition(true, 1);
  streaming_ = true;
}

void DsaController::stopStream() {
  streaming_ = false;
  acquisition(false, 0);
}

bool DsaController::stopStreamOnce(milliseconds limit) {
  streaming_ = false;
  answers_.clear();
  Bytes payload = {static_cast<std::byte>(options_.runLength ? kDsaControllerRunLength : 0u)};
  appendLittleEndian(payload, 0, 2);
  send(DsaId::kAcquisition, payload);
  // This stop is sent while leaving, when isCancelled() returns true already.
  const auto isCancelled = std::exchange(options_.isCancelled, nullptr);
  std::optional<Answer> answer;
  try {
    answer = awaitAnswer(DsaId::kAcquisition, limit);
  } catch (...) {
    options_.isCancelled = isCancelled;
    throw;
  }
  options_.isCancelled = isCancelled;
  return answer.has_value();
}

void DsaController::pullFrame() {
  if (!info_.hasSingleFrames())
    throw DeviceError(DeviceFault::kUnsupported,
                      channel_.name(),
                      "firmware " + info_.firmwareText() +
                          " of the tactile controller can't send single frames; stream instead");
  const std::uint64_t before = framesTaken_;
  acquisition(true, 0);
  const std::int64_t endUs = clock_.monotonicUs() + usOf(options_.answerTimeout);
  while (framesTaken_ == before) {
    if (clock_.monotonicUs() > endUs) failSilent("no frame arrived within a second of the request");
    poll(milliseconds(20));
  }
}

DsaControllerStats DsaController::stats() const {
  return {parser_.stats(), retries_, strayAnswers_};
}

// --- Opening

// Sends `ver`, which only a motion controller answers. The blank line before it ends a command that
// such a controller has received in part.
bool DsaController::looksLikeMotionController() {
  static constexpr std::string_view kQuestion = " \r\nver\r\n";
  channel_.write(std::as_bytes(std::span(kQuestion)));
  std::string received;
  const std::int64_t endUs = clock_.monotonicUs() + usOf(milliseconds(300));
  while (clock_.monotonicUs() < endUs && received.size() < 4096) {
    const std::size_t n = channel_.read(buffer_, milliseconds(50));
    for (std::size_t i = 0; i < n; ++i) received += static_cast<char>(buffer_[i]);
    if (received.find("VER=") != std::string::npos) return true;
  }
  return false;
}

const DsaControllerInfo& DsaController::open() {
  streaming_ = false;
  // Stops a stream that an earlier client left running. A booting controller does not answer, so
  // the stop is repeated.
  Bytes stop;
  stop.push_back(static_cast<std::byte>(options_.runLength ? kDsaSettingsRunLength : 0u));
  appendLittleEndian(stop, 0, 2);
  const std::int64_t startUs = clock_.monotonicUs();
  bool probed = false;
  while (true) {
    answers_.clear();
    send(DsaId::kAcquisition, stop);
    if (awaitAnswer(DsaId::kAcquisition, options_.stopAnswer)) break;
    ++retries_;
    if (!probed && clock_.monotonicUs() - startUs > usOf(2 * options_.stopAnswer)) {
      probed = true;
      if (looksLikeMotionController())
        throw WrongControllerError(PortAnswer::kMotion,
                                   channel_.name(),
                                   "the motion controller answers here: the two ports are swapped");
    }
    if (clock_.monotonicUs() - startUs > usOf(options_.openTimeout))
      failSilent(
          "no tactile controller answers; check cable and power, and that this isn't the motion "
          "port");
  }
  awaitSilence(framesTaken_ > 0 ? options_.settle : options_.settle / 2, options_.openTimeout);
  framesTaken_ = 0;
  answers_.clear();

  DsaControllerInfo facts;
  readControllerRecord(request(DsaId::kControllerConfiguration, {}, kControllerRecordBytes), facts);
  const std::size_t matrices =
      readSensorRecord(request(DsaId::kSensorConfiguration, {}, kSensorRecordBytes), facts);
  constexpr std::size_t kMaxMatrices = 64;
  if (matrices == 0 || matrices > kMaxMatrices)
    throw DeviceError(
        DeviceFault::kProtocol,
        channel_.name(),
        "the tactile controller says it has " + std::to_string(matrices) + " matrices");
  info_ = std::move(facts);
  info_.matrices.resize(matrices);
  for (std::size_t m = 0; m < matrices; ++m) readMatrix(m);
  try {
    checkPlaces(info_.matrices);
  } catch (const std::invalid_argument& wrong) {
    throw DeviceError(DeviceFault::kProtocol, channel_.name(), wrong.what());
  }
  for (std::size_t m = 0; m < matrices; ++m) readSettings(m);
  if (options_.readMasks) readMasks();
  parser_.setNumPlaces(info_.layout().numCells());
  return info_;
}

void DsaController::readMatrix(std::size_t matrix) {
  try {
    info_.matrices[matrix] = readMatrixRecord(
        request(DsaId::kMatrixConfiguration, {static_cast<std::byte>(matrix)}, kMatrixRecordBytes));
  } catch (const std::invalid_argument& wrong) {
    throw DeviceError(DeviceFault::kProtocol,
                      channel_.name(),
                      "matrix " + std::to_string(matrix) + ": " + wrong.what());
  }
}

void DsaController::readSettings(std::size_t matrix) {
  DsaMatrixInfo& facts = info_.matrices[matrix];
  const auto number = static_cast<std::byte>(matrix);
  const Bytes record = request(DsaId::kGetSensitivity, {number}, kSensitivityRecordBytes);
  facts.sensitivityAdjustable = (std::to_integer<unsigned>(record[2]) & 2u) != 0;
  const auto f32 = [&](std::size_t at) {
    const std::uint64_t bits = littleEndian(std::span(record).subspan(at, 4));
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  };
  for (const double value : {f32(3), f32(7)})
    if (!(value >= 0.0 && value <= 1.0))
      throw DeviceError(
          DeviceFault::kProtocol,
          channel_.name(),
          "matrix " + std::to_string(matrix) + " says its sensitivity is " + std::to_string(value));
  facts.sensitivity = f32(3);
  facts.factorySensitivity = f32(7);
  if (!info_.hasThresholds()) return;
  const Bytes threshold = request(DsaId::kGetThreshold, {number}, kThresholdRecordBytes);
  facts.thresholdCounts = static_cast<int>(littleEndian(std::span(threshold).subspan(2, 2)));
}

Mask DsaController::readMask(int type, std::size_t matrix) {
  const std::size_t places = info_.matrices[matrix].layout.numCells();
  const Bytes answer = request(DsaId::kReadMask,
                               {static_cast<std::byte>(type), static_cast<std::byte>(matrix)},
                               2 + maskBytes(places));
  return unpackMask(std::span(answer).subspan(2), places);
}

// Older firmware doesn't know this request; the masks stay unknown then (all on). A damaged answer
// on a working connection is asked for again like any other, because a recording keeps the layout.
void DsaController::readMasks() {
  try {
    for (std::size_t m = 0; m < info_.matrices.size(); ++m) {
      info_.matrices[m].layout.staticMask = readMask(0, m);
      info_.matrices[m].layout.dynamicMask = readMask(1, m);
    }
    info_.masksKnown = true;
  } catch (const DeviceError& error) {
    if (error.fault() != DeviceFault::kRefused && error.fault() != DeviceFault::kSilent) throw;
    for (DsaMatrixInfo& matrix : info_.matrices) {
      matrix.layout.staticMask.assign(matrix.layout.numCells(), 1);
      matrix.layout.dynamicMask.assign(matrix.layout.numCells(), 1);
    }
  }
}

// --- Settings

void DsaController::checkMatrix(std::size_t matrix) const {
  if (matrix >= info_.matrices.size())
    throw std::invalid_argument("there is no matrix " + std::to_string(matrix) + " (0.." +
                                std::to_string(info_.matrices.size()) + ")");
}

void DsaController::whilePaused(const std::function<void()>& set) {
  if (paused_) return set();
  const bool wasStreaming = streaming_;
  if (wasStreaming) {
    stopStream();
    awaitSilence(options_.settle, options_.answerTimeout * options_.tries);
  }
  paused_ = true;
  try {
    set();
  } catch (...) {
    paused_ = false;
    if (wasStreaming) startStream();
    throw;
  }
  paused_ = false;
  if (wasStreaming) startStream();
}

void DsaController::setSensitivity(std::size_t matrix, double sensitivity, bool persistent) {
  checkMatrix(matrix);
  if (!(sensitivity >= 0.0 && sensitivity <= 1.0))
    throw std::invalid_argument("sensitivity " + std::to_string(sensitivity) + " is not in 0..1");
  whilePaused([&] {
    Bytes payload = {static_cast<std::byte>(persistent ? kPersistent : 0u),
                     static_cast<std::byte>(matrix)};
    appendF32(payload, static_cast<float>(sensitivity));
    if (persistent)
      send(DsaId::kSetSensitivity, payload);  // the controller then gives no answer
    else
      request(DsaId::kSetSensitivity, payload, 2);
    readSettings(matrix);
  });
}

void DsaController::resetSensitivity(std::size_t matrix) {
  checkMatrix(matrix);
  whilePaused([&] {
    Bytes payload = {static_cast<std::byte>(kResetToFactory), static_cast<std::byte>(matrix)};
    appendF32(payload, static_cast<float>(info_.matrices[matrix].factorySensitivity));
    request(DsaId::kSetSensitivity, payload, 2);
    readSettings(matrix);
  });
}

void DsaController::setThreshold(std::size_t matrix, int counts, bool persistent) {
  checkMatrix(matrix);
  if (counts < 0 || counts > kDsaSettingsMaxCounts)
    throw std::invalid_argument("threshold " + std::to_string(counts) +
                                " is not in 0..4095 counts");
  if (!info_.hasThresholds())
    throw DeviceError(
        DeviceFault::kUnsupported,
        channel_.name(),
        "firmware " + info_.firmwareText() +
            " of the tactile controller has no thresholds (firmware 268 or newer has)");
  whilePaused([&] {
    Bytes payload = {static_cast<std::byte>(persistent ? kPersistent : 0u),
                     static_cast<std::byte>(matrix)};
    appendLittleEndian(payload, static_cast<unsigned>(counts), 2);
    if (persistent)
      send(DsaId::kSetThreshold, payload);
    else
      request(DsaId::kSetThreshold, payload, 2);
    readSettings(matrix);
  });
}

void DsaController::setDynamicMask(std::size_t matrix, const Mask& mask) {
  checkMatrix(matrix);
  MatrixLayout& layout = info_.matrices[matrix].layout;
  if (mask.size() != layout.numCells())
    throw std::invalid_argument("a mask of " + std::to_string(mask.size()) + " places for " +
                                std::to_string(layout.numCells()));
  if (!info_.masksKnown)
    throw DeviceError(DeviceFault::kUnsupported,
                      channel_.name(),
                      "this tactile controller's firmware takes no masks");
  whilePaused([&] {
    Bytes payload = {std::byte{1}, static_cast<std::byte>(matrix)};
    const Bytes packed = packMask(mask);
    payload.insert(payload.end(), packed.begin(), packed.end());
    request(DsaId::kSetDynamicMask, payload, 2);
    layout.dynamicMask = readMask(1, matrix);
  });
}

std::string DsaController::descriptor(bool ofMatrix, std::size_t matrix) {
  if (ofMatrix) checkMatrix(matrix);
  std::string text;
  whilePaused([&] {
    const Bytes answer = request(
        DsaId::kDescriptor,
        {static_cast<std::byte>(ofMatrix ? 1 : 0), static_cast<std::byte>(ofMatrix ? matrix : 0)},
        0);
    for (std::size_t i = 2; i < answer.size(); ++i) text += static_cast<char>(answer[i]);
  });
  return text;
}

}  // namespace palpate
