// The layout of taxels: of one sensor matrix, and of all matrices of a sensor. Frames, profiles and
// devices refer to it.
//
// A matrix has rows x columns places, stored row by row; row 0 is at the fingertip. Not every place
// holds a taxel: the static mask (hardware) says which taxels exist, the dynamic mask (a setting)
// which are scanned. A frame stores a value for every place; places without a taxel hold 0.
//
// A sensor may send readings with a sign, three components per taxel, or noise at rest. Then
// whether a taxel is touched is decided from its readings, see model/touch.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpate {

class Json;

// Distance between the centres of neighbouring taxels [mm]: along a row (x) and along a column (y).
struct TaxelPitch {
  double x = 0.0;
  double y = 0.0;

  constexpr TaxelPitch() = default;
  constexpr TaxelPitch(double both) : x(both), y(both) {}
  constexpr TaxelPitch(double alongRow, double alongColumn) : x(alongRow), y(alongColumn) {}
  constexpr bool isSquare() const noexcept { return x == y; }
  constexpr double areaMm2() const noexcept { return x * y; }
  // How far a motion in taxels is [mm].
  double lengthMm(double dx, double dy) const noexcept;
  constexpr bool operator==(const TaxelPitch&) const = default;
};
// As `hand.json` has it: one number, or [x, y] where the two differ.
Json pitchJson(const TaxelPitch& pitch);
// "3.4 mm", or "5.28 x 10.28 mm" (x, y); with a fixed number of digits if `digits` isn't below 0.
std::string pitchText(const TaxelPitch& pitch, int digits = -1);

// One flag per place, row by row: 1 = on, 0 = off.
using Mask = std::vector<std::uint8_t>;

// How readings of a matrix say that a taxel is touched.
struct TouchRule {
  int components = 1;  // per taxel: 1, or 3: x (along columns), y (along rows), z into the surface
  bool isSigned = false;  // readings may be below 0
  // A taxel is touched when its reading differs from its baseline by more than `threshold`, and by
  // more than `sigmas` standard deviations of its noise at rest [unit of the hand].
  float threshold = 0.0F;
  float sigmas = 0.0F;
  // Whether readings have to be looked at. If not, a taxel is touched when its reading is above 0.
  bool decides() const noexcept {
    return components != 1 || isSigned || threshold > 0.0F || sigmas > 0.0F;
  }
  bool operator==(const TouchRule&) const = default;
};

// The layout of one sensor matrix.
struct MatrixLayout {
  int rows = 0;     // y, 1..256
  int columns = 0;  // x, 1..256
  TaxelPitch pitchMm;
  Mask staticMask;   // size rows*columns: 1 where the sensor has a taxel
  Mask dynamicMask;  // size rows*columns: 1 where the taxel is scanned
  // The unique id that is burnt into the sensor, as the controller reports it, in capital
  // hexadecimal digits ("28FF00AB0C11"); empty when it is not known.
  std::string uniqueId = {};
  TouchRule touch = {};

  // Returns a matrix without masked places. Throws as validate() does.
  static MatrixLayout full(int rows, int columns, const TaxelPitch& pitchMm);

  // Number of all places: rows * columns.
  std::size_t numCells() const noexcept;
  // Number of readings: components of all places.
  std::size_t numReadings() const noexcept {
    return numCells() * static_cast<std::size_t>(touch.components);
  }
  // Number of taxels that exist (static mask).
  std::size_t numTaxels() const noexcept;
  // Number of taxels that exist and are scanned.
  std::size_t numEnabled() const noexcept;
  // Returns whether the place is in the matrix and on in the static mask.
  bool exists(int y, int x) const noexcept;
  // Returns whether the taxel exists and is on in the dynamic mask.
  bool enabled(int y, int x) const noexcept;
  double taxelAreaMm2() const noexcept { return pitchMm.areaMm2(); }
  // Throws std::invalid_argument that names the field that is out of range.
  void validate() const;
  // Compares where taxels are and which are scanned, but not the unique id: two sensors of the same
  // kind are equal.
  bool operator==(const MatrixLayout& other) const {
    return rows == other.rows && columns == other.columns && pitchMm == other.pitchMm &&
           staticMask == other.staticMask && dynamicMask == other.dynamicMask &&
           touch == other.touch;
  }
};

// The matrices of a sensor in wire order. The places of all matrices form one sequence.
class SensorLayout {
 public:
  SensorLayout() = default;
  // Throws std::invalid_argument as MatrixLayout::validate does, or when there is no matrix.
  explicit SensorLayout(std::vector<MatrixLayout> matrices);

  std::size_t numMatrices() const noexcept { return matrices_.size(); }
  const MatrixLayout& matrix(std::size_t index) const { return matrices_.at(index); }
  const std::vector<MatrixLayout>& matrices() const noexcept { return matrices_; }
  // Number of places of all matrices (SDH-2: 486).
  std::size_t numCells() const noexcept { return numPlaces_; }
  // Number of readings of all matrices; those of one taxel stand together.
  std::size_t numReadings() const noexcept { return numReadings_; }
  // Whether the pitch of every matrix is one number.
  bool hasSquareTaxels() const noexcept;
  // Whether one of the matrices has a rule that decides (TouchRule::decides).
  bool decidesTouch() const noexcept { return decidesTouch_; }
  // Number of taxels of all matrices that exist (SDH-2: 456).
  std::size_t numTaxels() const noexcept;
  // Index of the first place of a matrix in the sequence.
  std::size_t offset(std::size_t matrix) const { return offsets_.at(matrix); }
  // Index of its first reading.
  std::size_t readingOffset(std::size_t matrix) const { return readingOffsets_.at(matrix); }
  bool operator==(const SensorLayout& other) const { return matrices_ == other.matrices_; }

 private:
  std::vector<MatrixLayout> matrices_;
  std::vector<std::size_t> offsets_;
  std::vector<std::size_t> readingOffsets_;
  std::size_t numPlaces_ = 0;
  std::size_t numReadings_ = 0;
  bool decidesTouch_ = false;
};
// Throws Error, which names the file, when its sensor hasn't the matrix; nothing: all matrices.
void requireMatrix(const std::filesystem::path& file,
                   const SensorLayout& layout,
                   std::optional<std::int64_t> matrix);

// Place of a taxel in a sensor: matrix, row (y) and column (x), each counted from 0.
struct TaxelPlace {
  std::size_t matrix = 0;
  int y = 0;
  int x = 0;
  bool operator==(const TaxelPlace&) const = default;
};

}  // namespace palpate
