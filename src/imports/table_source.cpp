#include "palpate/imports/table_source.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/text_file.h"
#include "palpate/recording/foreign_file.h"
#include "palpate/recording/hdf5_recording.h"

#include "imports/csv_source.h"
#include "imports/folder_source.h"
#include "imports/hdf5_source.h"
#include "imports/mat5_source.h"
#include "imports/npz_source.h"
#include "imports/pad_folder_source.h"
#include "imports/xsensor_source.h"

namespace palpate {
namespace {

constexpr std::array<std::pair<char, std::string_view>, 5> kDelimiterNames = {
    {{'\0', "detect"}, {',', "comma"}, {';', "semicolon"}, {'\t', "tab"}, {' ', "blank"}}};

// MATLAB leaves so many bytes in front of HDF5's own.
constexpr std::size_t kUserBlockBytes = 512;

}  // namespace

std::size_t TableColumn::width() const noexcept {
  std::size_t numbers = 1;
  for (const std::size_t size : shape) numbers *= size;
  return numbers;
}

bool TableColumn::setArrayShape(std::span<const std::uint64_t> sizes) {
  if (sizes.empty()) return true;
  numRows = sizes[0];
  shape.assign(sizes.begin() + 1, sizes.end());
  std::uint64_t numbers = 1;
  for (const std::uint64_t size : sizes.subspan(1))
    if (__builtin_mul_overflow(numbers, size, &numbers)) return false;
  if (shape == std::vector<std::size_t>{1}) shape.clear();
  return true;
}

std::string_view delimiterName(char delimiter) {
  for (const auto& [letter, name] : kDelimiterNames)
    if (letter == delimiter) return name;
  return "comma";
}

std::optional<char> delimiterNamed(std::string_view name) {
  for (const auto& [letter, known] : kDelimiterNames)
    if (known == name) return letter;
  return std::nullopt;
}

bool isHdf5Table(const std::filesystem::path& path) noexcept {
  try {
    const std::string first = beginningOfFile(path, kUserBlockBytes + kHdf5Signature.size());
    return std::string_view(first).starts_with(kHdf5Signature) ||
           std::string_view(first).substr(std::min(first.size(), kUserBlockBytes)) ==
               kHdf5Signature;
  } catch (const std::exception&) {
    return false;
  }
}

std::unique_ptr<TableSource> openTable(const std::filesystem::path& path,
                                       const TableOptions& options) {
  // MATLAB's user block may say what HDF5 behind it is.
  if (isHdf5Table(path) && !std::string_view(beginningOfFile(path, kHdf5RecordingStart.size()))
                                .starts_with(kHdf5RecordingStart))
    return std::make_unique<Hdf5Source>(path);
  std::error_code failure;
  const bool isFolder = std::filesystem::is_directory(path, failure);
  if (!isFolder && beginningOfFile(path, kMat5Start.size()) == kMat5Start)
    return std::make_unique<Mat5Source>(path);
  if (const std::string foreign = foreignFileText(path); !foreign.empty()) {
    if (isFolder) throw FileError(path, foreign);
    throw FormatError(path, foreign);
  }
  if (isFolder) {
    const std::vector<std::filesystem::path> files = filesPerMatrix(path);
    if (!files.empty()) return std::make_unique<PadFolderSource>(path, files, options);
    return std::make_unique<FolderSource>(path, options);
  }
  constexpr std::string_view kNumpy = "\x93NUMPY";
  const std::string first = beginningOfFile(path, kNumpy.size());
  if (first.starts_with("PK\x03\x04") || first.starts_with("PK\x05\x06") ||
      first.starts_with(kNumpy))
    return std::make_unique<NpzSource>(path);
  if (XsensorSource::isExport(path)) return std::make_unique<XsensorSource>(path, options);
  return std::make_unique<CsvSource>(path, options);
}

}  // namespace palpate
