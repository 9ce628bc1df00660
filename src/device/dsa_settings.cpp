#include <bit>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/device/dsa_controller.h"

#include "device/dsa_records.h"
#include "device/other_controller.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;

constexpr unsigned kDsaSettingsRunLength = 0x01;
constexpr unsigned kPersistent = 0x80;
constexpr unsigned kResetToFactory = 0x01;
constexpr int kDsaSettingsMaxCounts = 4095;

}  // namespace

// --- opening --------------------------------------------------------------------------------------

// The blank line ends what a motion controller may have half received.
bool DsaController::looksLikeMotionController() {
  static constexpr std::string_view kQuestion = " \r\nver\r\n";
  channel_.write(std::as_bytes(std::span(kQuestion)));
  std::string heard;
  const std::int64_t endUs = clock_.monotonicUs() + usOf(milliseconds(300));
  while (clock_.monotonicUs() < endUs && heard.size() < 4096) {
    const std::size_t n = channel_.read(buffer_, milliseconds(50));
    for (std::size_t i = 0; i < n; ++i) heard += static_cast<char>(buffer_[i]);
    if (heard.find("VER=") != std::string::npos) return true;
  }
  return false;
}

const DsaFacts& DsaController::open() {
  streaming_ = false;
  // Stop what an earlier client left running. A controller that boots is deaf: ask again.
  Bytes stop;
  stop.push_back(static_cast<std::byte>(options_.runLength ? kDsaSettingsRunLength : 0u));
  appendU16(stop, 0);
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
        throw OtherController(PortAnswer::kMotion,
                              channel_.name(),
                              "the motion controller answers here: the two ports are swapped");
    }
    if (clock_.monotonicUs() - startUs > usOf(options_.openTimeout))
      failSilent(
          "no tactile controller answers; check cable and power (`palpate ports` shows "
          "what answers where)");
  }
  awaitSilence(framesTaken_ > 0 ? options_.settle : options_.settle / 2, options_.openTimeout);
  framesTaken_ = 0;
  answers_.clear();

  DsaFacts facts;
  readControllerRecord(request(DsaId::kControllerConfiguration, {}, kControllerRecordBytes), facts);
  const std::size_t matrices =
      readSensorRecord(request(DsaId::kSensorConfiguration, {}, kSensorRecordBytes), facts);
  constexpr std::size_t kMostMatrices = 64;
  if (matrices == 0 || matrices > kMostMatrices)
    throw DeviceError(
        DeviceFault::kProtocol,
        channel_.name(),
        "the tactile controller says it has " + std::to_string(matrices) + " matrices");
  facts_ = std::move(facts);
  facts_.matrices.resize(matrices);
  for (std::size_t m = 0; m < matrices; ++m) readMatrix(m);
  try {
    checkPlaces(facts_.matrices);
  } catch (const std::invalid_argument& wrong) {
    throw DeviceError(DeviceFault::kProtocol, channel_.name(), wrong.what());
  }
  for (std::size_t m = 0; m < matrices; ++m) readSettings(m);
  if (options_.readMasks) readMasks();
  parser_.setNumPlaces(facts_.layout().numPlaces());
  return facts_;
}

void DsaController::readMatrix(std::size_t matrix) {
  try {
    facts_.matrices[matrix] = readMatrixRecord(
        request(DsaId::kMatrixConfiguration, {static_cast<std::byte>(matrix)}, kMatrixRecordBytes));
  } catch (const std::invalid_argument& wrong) {
    throw DeviceError(DeviceFault::kProtocol,
                      channel_.name(),
                      "matrix " + std::to_string(matrix) + ": " + wrong.what());
  }
}

void DsaController::readSettings(std::size_t matrix) {
  DsaMatrixFacts& facts = facts_.matrices[matrix];
  const auto number = static_cast<std::byte>(matrix);
  const Bytes record = request(DsaId::kGetSensitivity, {number}, kSensitivityRecordBytes);
  facts.sensitivityAdjustable = (std::to_integer<unsigned>(record[2]) & 2u) != 0;
  const auto f32 = [&](std::size_t at) {
    std::uint32_t bits = 0;
    for (std::size_t i = 4; i > 0; --i)
      bits = bits << 8 | std::to_integer<std::uint32_t>(record[at + i - 1]);
    return static_cast<double>(std::bit_cast<float>(bits));
  };
  for (const double value : {f32(3), f32(7)})
    if (!(value >= 0.0 && value <= 1.0))
      throw DeviceError(
          DeviceFault::kProtocol,
          channel_.name(),
          "matrix " + std::to_string(matrix) + " says its sensitivity is " + std::to_string(value));
  facts.sensitivity = f32(3);
  facts.factorySensitivity = f32(7);
  if (!facts_.hasThresholds()) return;
  const Bytes threshold = request(DsaId::kGetThreshold, {number}, kThresholdRecordBytes);
  facts.thresholdCounts = static_cast<int>(std::to_integer<unsigned>(threshold[2]) |
                                           std::to_integer<unsigned>(threshold[3]) << 8);
}

Mask DsaController::readMask(int type, std::size_t matrix) {
  const std::size_t places = facts_.matrices[matrix].layout.numPlaces();
  const Bytes answer = request(DsaId::kReadMask,
                               {static_cast<std::byte>(type), static_cast<std::byte>(matrix)},
                               2 + maskBytes(places));
  return unpackMask(std::span(answer).subspan(2), places);
}

// Older firmware doesn't know the question: then the masks stay unknown (all on).
void DsaController::readMasks() {
  const int tries = std::exchange(options_.tries, 1);
  try {
    for (std::size_t m = 0; m < facts_.matrices.size(); ++m) {
      facts_.matrices[m].layout.staticMask = readMask(0, m);
      facts_.matrices[m].layout.dynamicMask = readMask(1, m);
    }
    facts_.masksKnown = true;
  } catch (const DeviceError& error) {
    if (error.fault() != DeviceFault::kRefused && error.fault() != DeviceFault::kSilent) {
      options_.tries = tries;
      throw;
    }
    for (DsaMatrixFacts& matrix : facts_.matrices) {
      matrix.layout.staticMask.assign(matrix.layout.numPlaces(), 1);
      matrix.layout.dynamicMask.assign(matrix.layout.numPlaces(), 1);
    }
  }
  options_.tries = tries;
}

// --- settings -------------------------------------------------------------------------------------

void DsaController::checkMatrix(std::size_t matrix) const {
  if (matrix >= facts_.matrices.size())
    throw std::invalid_argument("there is no matrix " + std::to_string(matrix) + " (0.." +
                                std::to_string(facts_.matrices.size()) + ")");
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
    appendF32(payload, static_cast<float>(facts_.matrices[matrix].factorySensitivity));
    request(DsaId::kSetSensitivity, payload, 2);
    readSettings(matrix);
  });
}

void DsaController::setThreshold(std::size_t matrix, int counts, bool persistent) {
  checkMatrix(matrix);
  if (counts < 0 || counts > kDsaSettingsMaxCounts)
    throw std::invalid_argument("threshold " + std::to_string(counts) +
                                " is not in 0..4095 counts");
  if (!facts_.hasThresholds())
    throw DeviceError(DeviceFault::kUnsupported,
                      channel_.name(),
                      "firmware " + facts_.firmwareText() +
                          " of the tactile controller knows no thresholds (268 or newer does)");
  whilePaused([&] {
    Bytes payload = {static_cast<std::byte>(persistent ? kPersistent : 0u),
                     static_cast<std::byte>(matrix)};
    appendU16(payload, static_cast<unsigned>(counts));
    if (persistent)
      send(DsaId::kSetThreshold, payload);
    else
      request(DsaId::kSetThreshold, payload, 2);
    readSettings(matrix);
  });
}

void DsaController::setDynamicMask(std::size_t matrix, const Mask& mask) {
  checkMatrix(matrix);
  MatrixLayout& layout = facts_.matrices[matrix].layout;
  if (mask.size() != layout.numPlaces())
    throw std::invalid_argument("a mask of " + std::to_string(mask.size()) + " places for " +
                                std::to_string(layout.numPlaces()));
  if (!facts_.masksKnown)
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
