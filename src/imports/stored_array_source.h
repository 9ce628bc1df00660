// Arrays whose numbers lie in a file one after the other, in either order of their axes, as they
// are or compressed: NumPy's and those of MAT files of version 5. Private to this module.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/core/file_descriptor.h"

#include "imports/array_source.h"
#include "imports/inflated_bytes.h"
#include "imports/npy_header.h"
#include "imports/random_reader.h"

namespace palpate {

class StoredArraySource : public ArraySource {
 public:
  explicit StoredArraySource(const std::filesystem::path& path) : ArraySource(path), file_(path) {}
  void reverseAxes(std::size_t column) override;

 protected:
  // Adds a column of numbers, or of something else, that is not read. Throws FormatError.
  void addArray(const std::string& name, NpyHeader header, std::string type);
  // Of numbers that don't lie in the file as they are (from header.dataOffset on): a reader that
  // stands before the first one. Null: they do.
  virtual std::unique_ptr<SequentialReader> unpacked(std::size_t column) = 0;

  void open(std::size_t column) override;
  void load(std::size_t column,
            std::uint64_t first,
            std::size_t count,
            std::vector<double>& values) override;
  void loadTimes(std::size_t column,
                 std::uint64_t first,
                 std::size_t count,
                 std::vector<TimeCell>& times) override;

  struct Array {
    NpyHeader header;
    std::unique_ptr<SequentialReader> reader;  // of packed numbers, read in order
    FileDescriptor spooled;  // packed ones in Fortran order, unpacked: a file without a name
  };
  RandomReader file_;
  std::vector<Array> arrays_;  // of the columns

 private:
  void spool(Array& array);
  // The bytes of numbers first .. first + count - 1 of the array in the order of the file.
  void readNumbers(Array& array, std::uint64_t first, std::span<std::byte> bytes);
  // The bytes of some rows in C order.
  void readRows(std::size_t column, std::uint64_t first, std::size_t count);

  std::vector<std::byte> bytes_;
  std::vector<std::byte> strip_;
};

}  // namespace palpate
