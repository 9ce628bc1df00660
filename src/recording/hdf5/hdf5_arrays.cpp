#include "recording/hdf5/hdf5_arrays.h"

#include <algorithm>
#include <new>
#include <utility>

#include <hdf5_hl.h>
#include <zlib.h>

namespace palpate {
namespace {

constexpr std::size_t kMaxWaitingChunks = 48;

// The bytes that HDF5's filters `shuffle` and `deflate` make of a chunk: the first bytes of all
// elements, then the second ones, and so on, compressed as a zlib stream.
std::vector<unsigned char> shuffledAndDeflated(const std::vector<unsigned char>& raw,
                                               std::size_t elementBytes,
                                               int level) {
  std::vector<unsigned char> shuffled(raw.size());
  const std::size_t count = raw.size() / elementBytes;
  for (std::size_t byte = 0; byte < elementBytes; ++byte)
    for (std::size_t i = 0; i < count; ++i)
      shuffled[byte * count + i] = raw[i * elementBytes + byte];
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::vector<unsigned char> packed(size);
  if (compress2(packed.data(), &size, shuffled.data(), static_cast<uLong>(raw.size()), level) !=
      Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

// Properties of a data set that depend on no time.
Hdf5Id plainProperties() {
  Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.get(), 0);
  return properties;
}

}  // namespace

Hdf5Arrays::Hdf5Arrays(const std::filesystem::path& path,
                       Overwrite overwrite,
                       const Hdf5WriteOptions& options)
    : out_(path, overwrite),
      level_(options.level),
      work_(otherThreads(options.threads), kMaxWaitingChunks) {}

Hdf5Id Hdf5Arrays::makeGroup(const std::string& name) {
  Hdf5Id group(H5Gcreate2(out_.file(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Gclose);
  out_.require(group.ok());
  return group;
}

Hdf5Id Hdf5Arrays::smallArray(const std::string& name,
                              const NumberType& type,
                              const Shape& shape,
                              const void* values) {
  const Hdf5Id space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  Hdf5Id set(H5Dcreate2(out_.file(),
                        name.c_str(),
                        type.stored,
                        space.get(),
                        H5P_DEFAULT,
                        plainProperties().get(),
                        H5P_DEFAULT),
             H5Dclose);
  out_.require(set.ok());
  const bool any = std::find(shape.begin(), shape.end(), 0) == shape.end();
  out_.require(!any ||
               H5Dwrite(set.get(), type.stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  return set;
}

Hdf5Id Hdf5Arrays::textArray(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<std::string> stored;
  for (const std::string& text : texts) stored.push_back(hdf5StoredText(text));
  std::vector<const char*> pointers;
  for (const std::string& text : stored) pointers.push_back(text.c_str());
  const Hdf5Id type = hdf5TextType();
  return smallArray(name, {type.get(), 0}, {texts.size()}, pointers.data());
}

Hdf5Arrays::ChunkedArray& Hdf5Arrays::chunkedArray(const std::string& name,
                                                   const NumberType& type,
                                                   Shape shape,
                                                   Shape chunk,
                                                   std::optional<std::int64_t> fill) {
  Shape most = shape;
  most[0] = H5S_UNLIMITED;
  const auto rank = static_cast<int>(shape.size());
  const Hdf5Id space(H5Screate_simple(rank, shape.data(), most.data()), H5Sclose);
  const Hdf5Id properties = plainProperties();
  H5Pset_chunk(properties.get(), rank, chunk.data());
  H5Pset_shuffle(properties.get());
  H5Pset_deflate(properties.get(), static_cast<unsigned>(level_));
  if (fill) H5Pset_fill_value(properties.get(), H5T_NATIVE_INT64, &*fill);
  Hdf5Id set(H5Dcreate2(out_.file(),
                        name.c_str(),
                        type.stored,
                        space.get(),
                        H5P_DEFAULT,
                        properties.get(),
                        H5P_DEFAULT),
             H5Dclose);
  out_.require(set.ok());
  return *arrays_.emplace_back(std::make_unique<ChunkedArray>(
      ChunkedArray{std::move(set), type, std::move(shape), std::move(chunk)}));
}

void Hdf5Arrays::makeScale(hid_t set, const char* name) {
  out_.require(H5DSset_scale(set, name) >= 0);
}
void Hdf5Arrays::attachScale(hid_t set, hid_t scale, unsigned axis) {
  out_.require(H5DSattach_scale(set, scale, axis) >= 0);
}

void Hdf5Arrays::addChunk(ChunkedArray& array, Shape offset, Bytes raw) {
  struct Chunk {
    Shape offset;
    Bytes raw;
    Bytes packed;
  };
  auto chunk = std::make_shared<Chunk>(Chunk{std::move(offset), std::move(raw), {}});
  const std::size_t bytes = array.type.bytes;
  work_.add(
      [chunk, bytes, level = level_] {
        chunk->packed = shuffledAndDeflated(chunk->raw, bytes, level);
        chunk->raw = {};
      },
      [this, chunk, set = array.id.get()] {
        const auto lock = hdf5Lock();
        out_.require(H5Dwrite_chunk(set,
                                    H5P_DEFAULT,
                                    0,
                                    chunk->offset.data(),
                                    chunk->packed.size(),
                                    chunk->packed.data()) >= 0);
      });
}

void Hdf5Arrays::addTexts(ChunkedArray& array,
                          hsize_t first,
                          const std::vector<std::string>& texts) {
  std::vector<std::string> stored;
  for (const std::string& text : texts) stored.push_back(hdf5StoredText(text));
  work_.add(
      [] {},
      [this, set = array.id.get(), first, stored = std::move(stored)] {
        const auto lock = hdf5Lock();
        std::vector<const char*> pointers;
        for (const std::string& text : stored) pointers.push_back(text.c_str());
        const hsize_t count = pointers.size();
        const Hdf5Id type = hdf5TextType();
        const Hdf5Id memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
        const Hdf5Id place(H5Dget_space(set), H5Sclose);
        out_.require(
            H5Sselect_hyperslab(place.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr) >=
                0 &&
            H5Dwrite(set, type.get(), memory.get(), place.get(), H5P_DEFAULT, pointers.data()) >=
                0);
      });
}

void Hdf5Arrays::grow(ChunkedArray& array, hsize_t length) {
  array.shape[0] = length;
  work_.add([] {},
            [this, set = array.id.get(), shape = array.shape] {
              const auto lock = hdf5Lock();
              out_.require(H5Dset_extent(set, shape.data()) >= 0);
            });
}

void Hdf5Arrays::commit() {
  arrays_.clear();
  out_.commit();
}

}  // namespace palpate
