// A folder with a file per frame: texts or NumPy arrays, in the order of the numbers in their
// names. A row is all numbers of a file, an array with the rows and columns of the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "palpate/imports/table_source.h"

namespace palpate {

class FolderSource final : public TableSource {
 public:
  // Throws FileError, FormatError: fewer than two files of one name but for numbers (.csv, .txt,
  // .npy), as many of two names, or two with the same numbers.
  FolderSource(const std::filesystem::path& path, const TableOptions& options);

  const std::filesystem::path& path() const noexcept override { return path_; }
  const std::vector<TableColumn>& columns() const noexcept override { return columns_; }
  std::string form() const override;
  std::string rowNote() const override { return note_; }
  std::string endNote() const override;
  std::vector<std::string> doubts(double mostCounted) const override;
  const char* rowWord() const noexcept override { return "file"; }
  void start(std::span<const std::size_t> columns, std::optional<std::size_t> time) override;
  bool next(TableRow& row) override;
  double fraction() const noexcept override;
  std::string textOf(std::size_t index) const override;
  std::string placeOf(std::size_t index) const override;

 private:
  // A number in a name: its whole part, and what is above that (below 1).
  using NameNumber = std::pair<std::int64_t, double>;
  struct FrameFile {
    std::filesystem::path path;
    std::vector<NameNumber> numbers;
    bool operator<(const FrameFile& other) const { return numbers < other.numbers; }
  };
  struct FileNumbers {
    std::vector<std::size_t> shape;
    std::vector<double> values;  // NaN where there is none
    std::vector<CellState> states;
    std::map<std::size_t, std::string> texts;  // of values that are texts
    bool isOpenEnded = false;                  // the last line has no end
  };
  static std::string patternOf(const std::string& stem, std::vector<NameNumber>& numbers);
  void findFiles();
  void findVarying();
  std::vector<std::size_t> usualShape() const;
  FileNumbers numbersOf(const std::filesystem::path& file) const;

  std::filesystem::path path_;
  TableOptions options_;
  std::vector<FrameFile> files_;
  std::optional<std::size_t> varying_;  // which number differs, if only one does
  std::string note_;
  std::string leftOut_;               // other files with a number in their names
  std::vector<TableColumn> columns_;  // the number in the name, then those of the file
  std::vector<std::size_t> selected_;
  std::optional<std::size_t> time_;
  std::size_t next_ = 0;
  std::vector<double> lastValues_;
  std::map<std::size_t, std::string> lastTexts_;  // by their places in lastValues_
  std::uint64_t numOpenEnded_ = 0;
  std::string firstOpenEnded_;
};

// The files of a folder with a file per matrix, whose names don't end in a number as those of
// frames; empty: it holds frames, or nothing.
std::vector<std::filesystem::path> filesPerMatrix(const std::filesystem::path& folder);

}  // namespace palpate
