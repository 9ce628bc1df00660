#include "device/dsa_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "palpate/core/byte_order.h"
#include "palpate/core/byte_reader.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr double kLargestFullScale = 65'535.0;
// Places of a frame with the largest u16 size: 5 bytes for stamp and flags, two bytes per place.
constexpr std::size_t kMaxPlaces = (0xFFFF - 5) / 2;

double finite(float value) { return std::isfinite(value) ? static_cast<double>(value) : 0.0; }

}  // namespace

void readControllerRecord(std::span<const std::byte> record, DsaControllerInfo& facts) {
  ByteReader in(record.subspan(2));
  facts.serial = in.u32();
  facts.hardwareVersion = in.u8();
  facts.firmwareVersion = in.u16();
  facts.status = in.u8();
  facts.features = in.u8();
}

std::size_t readSensorRecord(std::span<const std::byte> record, DsaControllerInfo& facts) {
  ByteReader in(record.subspan(2));
  const std::size_t matrices = in.u16();
  facts.generatedBy = in.u16();
  facts.sensorHardwareRevision = in.u8();
  facts.sensorSerial = in.u32();
  return matrices;
}

DsaMatrixInfo readMatrixRecord(std::span<const std::byte> record) {
  ByteReader in(record.subspan(2));
  DsaMatrixInfo facts;
  const double widthMm = finite(in.f32());
  const double heightMm = finite(in.f32());
  const int columns = in.u16();
  const int rows = in.u16();
  // Checked before memory of this size is allocated.
  if (rows < 1 || rows > 256 || columns < 1 || columns > 256)
    throw std::invalid_argument("a matrix of " + std::to_string(columns) + " x " +
                                std::to_string(rows) + " taxels");
  if (!(widthMm > 0.0 && widthMm < 1000.0) || std::abs(widthMm - heightMm) > 1e-3)
    throw std::invalid_argument("a taxel of " + std::to_string(widthMm) + " x " +
                                std::to_string(heightMm) + " mm");
  // Rounded, so that 3.4 is not read as 3.4000000953, the nearest 32-bit float.
  facts.layout = MatrixLayout::full(rows, columns, std::round(widthMm * 1e5) / 1e5);
  const auto id = in.take(6);
  for (const std::byte b : id) facts.uniqueId.push_back(std::to_integer<std::uint8_t>(b));
  // A sensor without an id reads all zeros or all ones.
  const auto isBlank = [&](std::byte blank) {
    return std::all_of(id.begin(), id.end(), [&](std::byte b) { return b == blank; });
  };
  if (!isBlank(std::byte{0}) && !isBlank(std::byte{0xFF})) facts.layout.uniqueId = hexDigits(id);
  in.take(2);
  facts.hardwareRevision = in.u8();
  for (double& centre : facts.centreMm) centre = finite(in.f32());
  for (double& rotation : facts.rotationDeg) rotation = finite(in.f32());
  // The sources disagree whether this is a whole number or a float; the plausible reading is taken.
  const std::uint32_t scale = in.u32();
  facts.fullScale = scale >= 1 && scale <= kLargestFullScale ? static_cast<double>(scale)
                                                             : finite(std::bit_cast<float>(scale));
  facts.sensitivityAdjustable = (in.u8() & 2u) != 0;
  return facts;
}

void checkPlaces(const std::vector<DsaMatrixInfo>& matrices) {
  std::size_t places = 0;
  for (const DsaMatrixInfo& matrix : matrices) places += matrix.layout.numCells();
  if (places > kMaxPlaces)
    throw std::invalid_argument("the tactile controller says it has " + std::to_string(places) +
                                " taxels; a frame carries " + std::to_string(kMaxPlaces) +
                                " at most");
}

std::size_t maskBytes(std::size_t places) { return (places + 7) / 8; }

Mask unpackMask(std::span<const std::byte> bytes, std::size_t places) {
  Mask mask(places);
  for (std::size_t i = 0; i < places; ++i)
    mask[i] = static_cast<std::uint8_t>(std::to_integer<unsigned>(bytes[i / 8]) >> i % 8 & 1u);
  return mask;
}

std::vector<std::byte> packMask(const Mask& mask) {
  std::vector<std::byte> bytes(maskBytes(mask.size()));
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i] != 0) bytes[i / 8] |= static_cast<std::byte>(1u << i % 8);
  return bytes;
}

void appendF32(std::vector<std::byte>& bytes, float value) {
  appendLittleEndian(bytes, std::bit_cast<std::uint32_t>(value), 4);
}

}  // namespace palpate
