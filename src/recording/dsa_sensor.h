// The <sensor> part of a .dsa recording: from its elements (docs/notes/dsa_format.md) to a sensor
// layout. Private to this module.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/model/matrix_layout.h"

namespace palpate {

// The elements of <sensor> and <matrix> that mean something here.
enum class SensorField {
  kFirmware,     // generated_by
  kSerial,       // serial_nr
  kNumMatrices,  // num_matrices
  kColumns,      // cells_x
  kRows,         // cells_y
  kPitchX,       // texel_width
  kPitchY,       // texel_height
  kStaticMask,
  kDynamicMask,
  kUniqueId,  // one_wire_uid
};

// Whether this can be a sensor's unique id: 1 to 32 capital hexadecimal digits.
bool isSensorId(std::string_view text) noexcept;

// Collects the fields in the order of the document; every function throws an Error that names what
// is wrong.
class DsaSensor {
 public:
  DsaSensor(std::size_t maxMatrices, std::size_t maxPlaces)
      : maxMatrices_(maxMatrices), maxPlaces_(maxPlaces) {}

  void beginMatrix();
  void set(SensorField field, std::string_view text);
  void endMatrix();
  // The layout, after a check of the number of matrices.
  SensorLayout finish();

  const std::string& serial() const noexcept { return serial_; }
  const std::string& firmware() const noexcept { return firmware_; }
  std::size_t numMatrices() const noexcept { return matrices_.size(); }
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  struct OpenMatrix {
    std::optional<int> rows;
    std::optional<int> columns;
    std::optional<double> pitchX;
    std::optional<double> pitchY;
    std::optional<std::string> staticMask;
    std::optional<std::string> dynamicMask;
    std::string uniqueId;
  };
  TaxelPitch pitchMm(const OpenMatrix& matrix);
  Mask mask(const std::optional<std::string>& text, const char* name, std::size_t places);
  std::string here() const { return "matrix " + std::to_string(matrices_.size()); }

  std::size_t maxMatrices_;
  std::size_t maxPlaces_;
  std::size_t numPlaces_ = 0;
  std::string serial_;
  std::string firmware_;
  std::optional<std::int64_t> numMatrices_;
  OpenMatrix open_;
  std::vector<MatrixLayout> matrices_;
  std::vector<std::string> warnings_;
};

}  // namespace palpate
