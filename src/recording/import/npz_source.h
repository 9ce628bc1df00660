// NumPy's arrays: one in a .npy file, or several by name in a .npz (a zip file of .npy).
#pragma once

#include <memory>
#include <vector>

#include "palpate/core/file_descriptor.h"

#include "recording/import/array_source.h"
#include "recording/import/npy_header.h"
#include "recording/import/random_reader.h"
#include "recording/import/zip_archive.h"

namespace palpate {

class NpzSource final : public ArraySource {
 public:
  explicit NpzSource(const std::filesystem::path& path);
  std::string form() const override;
  std::string rowNote() const override;
  void reverseAxes(std::size_t column) override;

 protected:
  void open(std::size_t column) override;
  void load(std::size_t column,
            std::uint64_t first,
            std::size_t count,
            std::vector<double>& values) override;
  void loadTimes(std::size_t column,
                 std::uint64_t first,
                 std::size_t count,
                 std::vector<TimeCell>& times) override;

 private:
  struct Array {
    NpyHeader header;
    std::unique_ptr<ZipEntry> entry;         // null: the file is the array
    std::unique_ptr<ZipEntryReader> reader;  // of an entry, read in order
    FileDescriptor spooled;  // an entry in Fortran order, unpacked: a file without a name
  };
  void addColumn(const std::string& name, Array array, std::uint64_t available);
  void spool(Array& array);
  // The bytes of numbers first .. first + count - 1 of the array in the order of the file.
  void readNumbers(Array& array, std::uint64_t first, std::span<std::byte> bytes);
  // The bytes of some rows in C order.
  void readRows(std::size_t column, std::uint64_t first, std::size_t count);

  RandomReader file_;
  bool isArchive_ = false;
  std::vector<Array> arrays_;
  std::vector<std::byte> bytes_;
  std::vector<std::byte> strip_;
};

}  // namespace palpate
