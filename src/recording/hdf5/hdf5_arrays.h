// Groups, arrays and attributes of a new HDF5 file, whose chunks other threads compress. Private to
// this module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/ordered_work.h"
#include "palpate/recording/hdf5_recording.h"

#include "recording/hdf5/hdf5_output.h"

namespace palpate {

// What writes a file is derived from it.
class Hdf5Arrays {
 protected:
  using Bytes = std::vector<unsigned char>;
  using Shape = std::vector<hsize_t>;

  // The kinds of numbers that are written.
  struct NumberType {
    hid_t stored;
    std::size_t bytes;
  };
  static NumberType u8() { return {H5T_STD_U8LE, 1}; }
  static NumberType u16() { return {H5T_STD_U16LE, 2}; }
  static NumberType i32() { return {H5T_STD_I32LE, 4}; }
  static NumberType i64() { return {H5T_STD_I64LE, 8}; }
  static NumberType f32() { return {H5T_IEEE_F32LE, 4}; }
  static NumberType f64() { return {H5T_IEEE_F64LE, 8}; }

  // An array in the file whose first axis is cut into chunks, and where wanted its second one.
  struct ChunkedArray {
    Hdf5Id id;
    NumberType type{};
    Shape shape;
    Shape chunk;
  };

  template <typename Number>
  static void put(Bytes& bytes, std::size_t index, Number value) {
    std::memcpy(bytes.data() + index * sizeof value, &value, sizeof value);
  }

  Hdf5Arrays(const std::filesystem::path& path,
             Overwrite overwrite,
             const Hdf5WriteOptions& options);

  // -- Objects of the file; the lock is held. All throw FileError. --

  Hdf5Id makeGroup(const std::string& name);
  template <typename Value>
  void attribute(hid_t object, const char* name, const Value& value) {
    out_.require(writeHdf5Attribute(object, name, value));
  }
  // A small array, stored as it is.
  Hdf5Id smallArray(const std::string& name,
                    const NumberType& type,
                    const Shape& shape,
                    const void* values);
  Hdf5Id textArray(const std::string& name, const std::vector<std::string>& texts);
  // An array of chunks that are written whole; `fill` is its value where none was written.
  ChunkedArray& chunkedArray(const std::string& name,
                             const NumberType& type,
                             Shape shape,
                             Shape chunk,
                             std::optional<std::int64_t> fill = {});
  void makeScale(hid_t set, const char* name);
  void attachScale(hid_t set, hid_t scale, unsigned axis);

  // -- Chunks; the lock is not held. --

  // Compresses a chunk on some thread and writes it in the order of these calls. Its place in the
  // array must be there then, see grow().
  void addChunk(ChunkedArray& array, Shape offset, Bytes raw);
  // The same for texts of an array of one axis, from row `first` on.
  void addTexts(ChunkedArray& array, hsize_t first, const std::vector<std::string>& texts);
  // Lengthens the first axis, in the order of these calls.
  void grow(ChunkedArray& array, hsize_t length);
  void finishChunks() { work_.finishAll(); }
  // Closes the file and gives it its name; after finishChunks().
  void commit();

  Hdf5Output out_;

 private:
  const int level_;
  std::vector<std::unique_ptr<ChunkedArray>> arrays_;
  OrderedWork work_;  // last: it ends before what it uses
};

}  // namespace palpate
