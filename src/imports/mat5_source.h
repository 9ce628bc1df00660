// The arrays of a MAT file of version 5 (MATLAB's save without -v7.3, SciPy's savemat), by the form
// that MathWorks has published (MAT-File Format). Arrays of numbers in structures are columns
// "name.field", in structure arrays "name(2).field", in cells "name{2}". Their axes are reversed as
// in MATLAB's HDF5 files. Every length is checked before it is used.
//
// libmatio is not used: of a file that is cut off it returns zeros for what is missing, and of an
// array whose data is shorter than its dimensions the bytes behind it, both without an error
// (1.5.23).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "imports/stored_array_source.h"

namespace palpate {

// How such a file begins.
constexpr std::string_view kMat5Start = "MATLAB 5.0 MAT-file";

class Mat5Source final : public StoredArraySource {
 public:
  explicit Mat5Source(const std::filesystem::path& path);
  std::string form() const override;
  // Palpate's own exports have the rows before the columns.
  bool isColumnMajor() const noexcept override { return !isOwn_; }

 protected:
  std::unique_ptr<SequentialReader> unpacked(std::size_t column) override;

 private:
  class Scan;
  void recogniseOwn();
  // An element of the file: an array, or a compressed one.
  struct Element {
    std::uint64_t offset = 0;  // of its bytes
    std::uint64_t bytes = 0;   // that it has in the file
    bool isCompressed = false;
  };

  bool isOwn_ = false;
  bool isBigEndian_ = false;
  std::size_t nameBytes_ = 0;             // of all columns
  std::vector<Element> elements_;         // one per column
  std::vector<std::uint64_t> endOffset_;  // of the unpacked element of a column
};

}  // namespace palpate
