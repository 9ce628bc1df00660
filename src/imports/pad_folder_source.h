// A folder with a file per matrix: texts or NumPy arrays with a row per frame, called as the
// matrices are. Row by row they make one table. Private to this module.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/imports/table_source.h"

namespace palpate {

class PadFolderSource final : public TableSource {
 public:
  // `files`: of one ending, at least two. Throws FileError, FormatError.
  PadFolderSource(const std::filesystem::path& path,
                  const std::vector<std::filesystem::path>& files,
                  const TableOptions& options);

  const std::filesystem::path& path() const noexcept override { return path_; }
  const std::vector<TableColumn>& columns() const noexcept override { return columns_; }
  std::string form() const override;
  const char* rowWord() const noexcept override { return "row"; }
  void start(std::span<const std::size_t> columns, std::optional<std::size_t> time) override;
  bool next(TableRow& row) override;
  double fraction() const noexcept override;
  std::string textOf(std::size_t index) const override;
  std::string placeOf(std::size_t index) const override;
  std::string endNote() const override;
  bool hasNamedParts() const noexcept override { return true; }

 private:
  struct PadFile {
    std::string name;
    std::unique_ptr<TableSource> table;
    std::optional<std::size_t> time;    // its column of times
    std::vector<std::size_t> selected;  // its columns that are read
    bool isRead = false;
    TableRow row;
  };
  struct Place {
    std::size_t file = 0;
    std::size_t column = 0;  // of the file
  };
  // Where value `index` of the last row comes from: the file, and the value there.
  std::pair<const PadFile*, std::size_t> originOf(std::size_t index) const;

  std::filesystem::path path_;
  std::vector<PadFile> files_;
  std::vector<TableColumn> columns_;
  std::vector<Place> places_;  // of the columns
  std::vector<std::size_t> selected_;
  std::optional<std::size_t> time_;
  std::uint64_t row_ = 0;
};

}  // namespace palpate
