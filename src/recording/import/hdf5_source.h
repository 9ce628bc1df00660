// The data sets of an HDF5 file, by their paths. The C library is used in this source only; it
// allows one thread at a time, so that its calls are guarded by a mutex of the process.
#pragma once

#include <memory>
#include <vector>

#include "recording/import/array_source.h"

namespace palpate {

class Hdf5Source final : public ArraySource {
 public:
  explicit Hdf5Source(const std::filesystem::path& path);
  ~Hdf5Source() override;
  std::string form() const override;

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
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
