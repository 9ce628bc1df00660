// The commands of the tactile controller, one function each.
#include <algorithm>
#include <string>

#include "palpate/core/byte_reader.h"
#include "palpate/emulator/dsa_server.h"

#include "emulator/dsa_wire.h"
#include "emulator/wire_writer.h"

namespace palpate {
namespace {

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
      return describeInWords(payload);
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
  out.u8(0);               // CAN id: one byte, whatever the documentation says
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
  out.u16(0).f32(matrix.pitchMm).f32(matrix.pitchMm);
  out.u16(static_cast<unsigned>(matrix.columns)).u16(static_cast<unsigned>(matrix.rows));
  constexpr unsigned kUniqueId[] = {0x10, 0x22, 0x33, 0x44, 0x55, 0x66};  // any distinct bytes
  for (std::size_t i = 0; i < 6; ++i)
    out.u8(kUniqueId[i] + (i == 0 ? static_cast<unsigned>(index) : 0));
  out.u16(0).u8(1);
  // A flat layout for display: fingers 50 mm apart, fingertips above.
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
  // The static mask is what the hardware is.
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

void DsaServer::describeInWords(Payload payload) {
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
  const bool silent = (flags & kPersistent) != 0;  // the firmware forgets to answer
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
