// The data sets of an HDF5 file, by their paths. Another process reads them (hdf5_process.h).
#pragma once

#include <memory>
#include <vector>

#include "recording/hdf5_process.h"
#include "recording/import/array_source.h"

namespace palpate {

class Hdf5Source final : public ArraySource {
 public:
  explicit Hdf5Source(const std::filesystem::path& path);
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
  std::unique_ptr<Hdf5Process> file_;
  std::vector<Hdf5Facts> facts_;  // of the columns
};

}  // namespace palpate
