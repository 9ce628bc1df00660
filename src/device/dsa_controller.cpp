#include "palpate/device/dsa_controller.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/time.h"

#include "device/dsa_records.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;

constexpr unsigned kAcquire = 0x80;
constexpr unsigned kDsaControllerRunLength = 0x01;
constexpr int kPending = 25;  // a second answer with the final code follows
constexpr std::size_t kDsaControllerReadBytes = 4096;

unsigned errorWord(const std::vector<std::byte>& payload) {
  return std::to_integer<unsigned>(payload[0]) | std::to_integer<unsigned>(payload[1]) << 8;
}

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

std::string DsaFacts::firmwareText() const {
  if (firmwareVersion < 0x1000) return std::to_string(firmwareVersion);
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4)
    text += (text.empty() ? "" : ".") + std::to_string(firmwareVersion >> shift & 0xF);
  return text;
}

SensorLayout DsaFacts::layout() const {
  std::vector<MatrixLayout> layouts;
  for (const DsaMatrixFacts& matrix : matrices) layouts.push_back(matrix.layout);
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

// --- reading --------------------------------------------------------------------------------------

bool DsaController::take(const DsaPacket& packet) {
  if (packet.id == DsaId::kFrame) {
    ++framesTaken_;
    frames_(packet.payload);
    return false;
  }
  constexpr std::size_t kMostAnswers = 16;
  if (answers_.size() == kMostAnswers) {
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
      ++strayAnswers_;  // a late acknowledgement, or one of a request given up
    }
    if (options_.giveUp && options_.giveUp())
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
    if (options_.giveUp && options_.giveUp())
      throw DeviceError(DeviceFault::kSilent, channel_.name(), "given up");
    const std::int64_t leftUs = usOf(silence) - (clock_.monotonicUs() - quietSinceUs);
    if (poll(milliseconds(leftUs / 1000 + 1)) > 0) quietSinceUs = clock_.monotonicUs();
  }
  flush();
}

// --- asking ---------------------------------------------------------------------------------------

void DsaController::send(DsaId id, const Bytes& payload) {
  channel_.write(dsaRequest(id, payload));
}

void DsaController::dropLateAnswers() {
  constexpr int kMostReads = 4;  // a stream never ends
  for (int i = 0; i < kMostReads && poll(milliseconds(0)) > 0; ++i) {
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
      // A late answer to the try before must not pass for the answer to another question.
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
  appendU16(payload, static_cast<unsigned>(rate));
  request(DsaId::kAcquisition, payload, 2);
}

// --- streaming ------------------------------------------------------------------------------------

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
  appendU16(payload, 0);
  send(DsaId::kAcquisition, payload);
  const auto giveUp = std::exchange(options_.giveUp, nullptr);  // leaving: asked to give up already
  std::optional<Answer> answer;
  try {
    answer = awaitAnswer(DsaId::kAcquisition, limit);
  } catch (...) {
    options_.giveUp = giveUp;
    throw;
  }
  options_.giveUp = giveUp;
  return answer.has_value();
}

void DsaController::pullFrame() {
  if (!facts_.hasSingleFrames())
    throw DeviceError(DeviceFault::kUnsupported,
                      channel_.name(),
                      "firmware " + facts_.firmwareText() +
                          " of the tactile controller can't send single frames; stream instead");
  const std::uint64_t before = framesTaken_;
  acquisition(true, 0);
  const std::int64_t endUs = clock_.monotonicUs() + usOf(options_.answerTimeout);
  while (framesTaken_ == before) {
    if (clock_.monotonicUs() > endUs) failSilent("no frame came within a second of asking");
    poll(milliseconds(20));
  }
}

DsaControllerStats DsaController::stats() const {
  return {parser_.stats(), retries_, strayAnswers_};
}

}  // namespace palpate
