// Decodes the fixed-size records in the DSACON32-M's answers. Used by DsaController.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <palpate/device/dsa_controller.h>

namespace palpate {

constexpr std::size_t kControllerRecordBytes = 18;  // documented as 19; 18 are sent
constexpr std::size_t kSensorRecordBytes = 12;
constexpr std::size_t kMatrixRecordBytes = 52;
constexpr std::size_t kSensitivityRecordBytes = 11;
constexpr std::size_t kThresholdRecordBytes = 4;

// Each function takes a record of the exact size and stores its fields in `facts`; the caller has
// checked the error word before.
void readControllerRecord(std::span<const std::byte> record, DsaControllerInfo& facts);
// Returns the number of matrices.
std::size_t readSensorRecord(std::span<const std::byte> record, DsaControllerInfo& facts);
// Throws std::invalid_argument naming an impossible value (0 columns, a pitch that isn't positive,
// ..).
DsaMatrixInfo readMatrixRecord(std::span<const std::byte> record);

// Throws std::invalid_argument when all matrices together have more places than a frame can carry.
void checkPlaces(const std::vector<DsaMatrixInfo>& matrices);

// Bit i, least significant first, belongs to place i = y * columns + x.
std::size_t maskBytes(std::size_t places);
Mask unpackMask(std::span<const std::byte> bytes, std::size_t places);
std::vector<std::byte> packMask(const Mask& mask);

void appendF32(std::vector<std::byte>& bytes, float value);

}  // namespace palpate
