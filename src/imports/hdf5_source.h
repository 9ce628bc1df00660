// The data sets of an HDF5 file, by their paths. Another process reads them (hdf5_process.h).
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "palpate/recording/hdf5_process.h"

#include "imports/array_source.h"

namespace palpate {

class Hdf5Source final : public ArraySource {
 public:
  explicit Hdf5Source(const std::filesystem::path& path);
  std::string form() const override;
  bool isColumnMajor() const noexcept override { return isMatlab_; }
  void reverseAxes(std::size_t column) override;
  std::optional<double> rateHz() const override;

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
  template <typename Value>
  void readRows(std::size_t column, std::uint64_t first, Hdf5Number type, std::span<Value> values);

  void describe(TableColumn& column);
  // Texts first .. first + count - 1 of a column of them.
  std::vector<std::string> texts(std::size_t column, std::uint64_t first, std::size_t count);
  // Of a column of texts: whether they are dates.
  void describeTexts(std::size_t column);

  bool isMatlab_ = false;
  std::vector<std::string> timeTexts_;  // of the loaded rows
  std::set<std::size_t> reversed_;      // columns
  std::unique_ptr<Hdf5Process> file_;
  std::vector<Hdf5Facts> facts_;  // of the columns, whose axes may be reversed
};

}  // namespace palpate
