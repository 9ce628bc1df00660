// Where taxels are: the layout of one sensor matrix, and of all matrices of a sensor.
//
// A matrix is rows x columns places, row 0 at the fingertip, stored row by row. Not every place
// holds a taxel: the static mask (hardware) says which exist, the dynamic mask (a setting) which
// are scanned. A frame stores a value for every place; places without a taxel hold 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace palpate {

// One flag per place, row by row: 1 = on, 0 = off.
using Mask = std::vector<std::uint8_t>;

struct MatrixLayout {
  int rows = 0;          // y, 1..256
  int columns = 0;       // x, 1..256
  double pitchMm = 0.0;  // distance between neighbouring taxels [mm], along rows and columns
  Mask staticMask;       // size rows*columns: 1 where the sensor has a taxel
  Mask dynamicMask;      // size rows*columns: 1 where the taxel is scanned
  // Which sensor it is: the unique id that is burnt into it, as the controller tells it, in capital
  // hexadecimal digits ("28FF00AB0C11"); empty: not known.
  std::string uniqueId = {};

  // A full matrix without masked places.
  static MatrixLayout full(int rows, int columns, double pitchMm);

  std::size_t numCells() const noexcept;      // rows * columns
  std::size_t numTaxels() const noexcept;     // existing ones (static mask)
  std::size_t numEnabled() const noexcept;    // existing and scanned ones
  bool exists(int y, int x) const noexcept;   // in range and on in the static mask
  bool enabled(int y, int x) const noexcept;  // exists and on in the dynamic mask
  double taxelAreaMm2() const noexcept { return pitchMm * pitchMm; }
  // Throws std::invalid_argument naming the field that is out of range.
  void validate() const;
  // Where taxels are, and which are scanned: the same for two sensors of a kind, whatever their
  // ids.
  bool operator==(const MatrixLayout& other) const {
    return rows == other.rows && columns == other.columns && pitchMm == other.pitchMm &&
           staticMask == other.staticMask && dynamicMask == other.dynamicMask;
  }
};

// The matrices in wire order; places of all matrices form one sequence.
class SensorLayout {
 public:
  SensorLayout() = default;
  // Throws std::invalid_argument as MatrixLayout::validate does, or when there is no matrix.
  explicit SensorLayout(std::vector<MatrixLayout> matrices);

  std::size_t numMatrices() const noexcept { return matrices_.size(); }
  const MatrixLayout& matrix(std::size_t index) const { return matrices_.at(index); }
  const std::vector<MatrixLayout>& matrices() const noexcept { return matrices_; }
  std::size_t numCells() const noexcept { return numPlaces_; }  // of all matrices (SDH-2: 486)
  std::size_t numTaxels() const noexcept;                       // that exist (SDH-2: 456)
  // First place of a matrix in the sequence.
  std::size_t offset(std::size_t matrix) const { return offsets_.at(matrix); }
  bool operator==(const SensorLayout& other) const { return matrices_ == other.matrices_; }

 private:
  std::vector<MatrixLayout> matrices_;
  std::vector<std::size_t> offsets_;
  std::size_t numPlaces_ = 0;
};

}  // namespace palpate
