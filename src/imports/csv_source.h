// A table in a text: see CsvShape for the forms.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "imports/csv_shape.h"
#include "imports/line_reader.h"

namespace palpate {

class CsvSource final : public TableSource {
 public:
  CsvSource(const std::filesystem::path& path, const TableOptions& options);

  const std::filesystem::path& path() const noexcept override { return path_; }
  const std::vector<TableColumn>& columns() const noexcept override { return shape_.columns; }
  std::string form() const override;
  const char* rowWord() const noexcept override { return "line"; }
  void start(std::span<const std::size_t> columns, std::optional<std::size_t> time) override;
  bool next(TableRow& row) override;
  double fraction() const noexcept override { return reader_.fraction(); }
  std::string textOf(std::size_t index) const override;
  std::string placeOf(std::size_t index) const override;
  std::string endNote() const override;
  std::string joinLines(std::size_t count) override;
  std::optional<double> rateHz() const override { return rateHz_; }
  std::string rowNote() const override;
  std::string advice() const override;
  std::optional<std::size_t> joinTimes(std::size_t first,
                                       std::size_t second,
                                       std::int64_t factor) override;
  NulBytes nulBytes() const override { return reader_.nulBytes(); }

  char decimal() const noexcept { return shape_.decimal; }

 private:
  struct JoinedTime {
    std::size_t first = 0;
    std::size_t second = 0;
    std::int64_t factor = 0;
    std::string text;  // of the last line
  };
  // Frames of several lines; lines of another form may stand between them.
  struct FrameLines {
    std::size_t lines = 0;       // of a frame; 0: each line is a row
    std::size_t numbers = 0;     // of a line
    bool areMarked = false;      // by other lines between them
    bool hasNumber = false;      // a number stands alone, or behind "Frame", before each
    bool isBegun = false;        // the first one was read
    std::uint64_t brokenAt = 0;  // the first line that is none of a frame, if frames aren't marked
    std::string before = {};     // the last line before the frame
    std::string text = {};       // its cells
  };
  bool readLine(TableRow& row);
  bool readFrame(TableRow& row);
  bool readPads(TableRow& row);
  bool isFrameLine(std::string_view line, std::size_t numbers);
  bool readCells(std::string_view line, TableRow& row);
  bool splitNamed(std::string_view line, TableRow& row);
  void readJoinedTimes();
  // Lines of names between the rows, as of logs that were put together.
  struct LaterNames {
    std::vector<std::string> first;    // the cells of the first line of names
    std::vector<std::size_t> columns;  // of the cells below the newest line; empty: as they come
    std::uint64_t otherLine = 0;       // the newest line, if its names are others
  };
  bool placeByNames(TableRow& row);

  std::filesystem::path path_;
  LineReader reader_;
  CsvShape shape_;
  std::vector<JoinedTime> joined_;  // the last columns
  FrameLines frames_;
  LaterNames laterNames_;
  // Of a movie of Tekscan: what its head says.
  bool isMovie_ = false;
  bool hasBlocked_ = false;
  std::string movieRows_, movieColumns_;
  std::optional<double> rateHz_;
  std::map<std::string, std::size_t, std::less<>> labelled_;  // column of each name of a line
  std::vector<std::size_t> selected_;
  std::optional<std::size_t> time_;
  std::uint64_t lastRowLine_ = 0;
  std::vector<std::string_view> cells_;  // of the last line, by column
  std::vector<std::string_view> names_;  // of a line of names and values
  std::vector<std::string_view> values_;
  NestedLine nested_;
  std::string heldLine_;          // of lines per matrix: the first one of the next frame
  std::uint64_t heldNumber_ = 0;  // 0: none
  std::vector<std::string> padTexts_;
};

}  // namespace palpate
