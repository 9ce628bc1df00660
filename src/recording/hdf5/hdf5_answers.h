// Answers requests (hdf5_request.h) about one HDF5 file by means of libhdf5: the work of the
// program palpate_hdf5, which has limits and may end at any of them. Only what lies in the file
// itself is read: external links, external storage and virtual data sets are refused, and so are
// data sets whose values were never written. Private to this module.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "palpate/core/byte_reader.h"
#include "palpate/recording/hdf5_process.h"

#include "recording/hdf5_library.h"
#include "recording/hdf5_request.h"

namespace palpate {

class Hdf5Answers {
 public:
  // `descriptor`: of the file, open for reading; it stays the caller's.
  explicit Hdf5Answers(int descriptor);
  // Returns an answer without its size. Throws std::bad_alloc.
  std::string answer(std::span<const std::byte> request);

 private:
  struct Array {
    Hdf5Id id;
    Hdf5Facts facts;
    bool isReading = false;  // its chunks are kept as far as there is room
  };

  std::string arrayNames();
  bool has(const std::string& name) const;
  // Throws Hdf5Fault, as all below.
  void requireInside(const std::string& name) const;
  Array& array(const std::string& name);
  // The same of an array whose values are read: the chunks of a band of rows are kept, so that
  // each is unpacked once when rows are read in order.
  const Array& arrayToRead(const std::string& name);
  std::string numbers(const std::string& name, ByteReader& in);
  std::string texts(const std::string& name, ByteReader& in);
  std::string axisNames(const std::string& name);
  // Opens the object and calls `read` with it and the name of the attribute, which comes next.
  template <typename Read>
  void attribute(const std::string& name, ByteReader& in, Read read);

  Hdf5Id file_;
  std::map<std::string, Array> arrays_;  // that were asked for, by name
  std::size_t chunkBytesLeft_;           // that chunks of further arrays may take
};

// Sets the limits of this process and answers what comes over `socket` until nobody asks any more.
// A request that takes more than `requestCpu` of processor time ends the process (SIGPROF).
// Returns the exit code of the process.
int serveHdf5(int socket, int file, std::chrono::milliseconds requestCpu);

}  // namespace palpate
