// The MAT file format of version 5 (MathWorks, "MAT-File Format", R2023a; chapter 1), little-endian
// and compressed: arrays of numbers, texts, cells and structures, whose numbers are written as they
// are computed. Private to this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/core/output_file.h"

namespace palpate {

constexpr std::size_t kMaxMatName = 31;  // of a field

// Numbers that an array holds.
enum class MatNumber { kU8, kU16, kI32, kI64, kF32, kF64 };

// Takes the bytes of an element, one after the other.
using MatSink = std::function<void(std::string_view bytes)>;

// One array with all that it holds.
class MatValue {
 public:
  // Writes exactly the numbers of the array, little-endian, the first dimension fastest.
  using Fill = std::function<void(const MatSink& sink)>;

  static MatValue numbers(MatNumber type, std::vector<std::uint64_t> dimensions, Fill fill);
  // The same of numbers in memory; `dimensions` [1 x n] or as given.
  static MatValue column(const std::vector<double>& values);
  static MatValue column(const std::vector<std::int64_t>& values);
  static MatValue text(const std::string& utf8);
  // n x 1 cells.
  static MatValue texts(const std::vector<std::string>& utf8);
  // 1 x 1; names of at most kMaxMatName letters.
  static MatValue structure(std::vector<std::pair<std::string, MatValue>> fields);

  // Bytes of the element with its tag; `name`: of the variable, empty inside of others.
  std::uint64_t numBytes(const std::string& name) const;
  void write(const std::string& name, const MatSink& sink) const;

 private:
  enum class Class : std::uint8_t;
  std::uint64_t dataBytes() const;

  Class class_{};
  MatNumber type_ = MatNumber::kU8;
  std::vector<std::uint64_t> dimensions_;
  Fill fill_;
  std::vector<std::string> names_;
  std::vector<MatValue> values_;
};

// A file of variables.
class MatFile {
 public:
  // Throws FileError.
  MatFile(const std::filesystem::path& path, Overwrite overwrite, std::string_view program);
  // Throws FileError when the variable is larger than the format allows, or can't be written.
  void add(const std::string& name, const MatValue& value);
  void commit();

 private:
  OutputFile out_;
  std::uint64_t position_ = 0;
};

}  // namespace palpate
