// A text that XSENSOR's software exports: per frame a line FRAME with its number, its date and
// time, then for each sensor its figures, a line SENSELS, and a line of numbers for each row of the
// sensor. Empty lines stand anywhere; lines are filled up with empty cells. Groups of sensels
// (heel, toe), which repeat parts of the sensors, are left out.
//
// Columns: "frame", "time", and an array of rows x columns for each sensor, with "left" or "right"
// before its name where it is that of a left or right insole (-LF, -RF).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/imports/table_source.h"

#include "imports/line_reader.h"

namespace palpate {

class XsensorSource final : public TableSource {
 public:
  // Whether a text is such an export, as its beginning tells. Throws FileError.
  static bool isExport(const std::filesystem::path& path);
  // Reads the first frame, which says what the sensors are. Throws FileError, FormatError.
  XsensorSource(const std::filesystem::path& path, const TableOptions& options);

  const std::filesystem::path& path() const noexcept override { return path_; }
  const std::vector<TableColumn>& columns() const noexcept override { return columns_; }
  std::string form() const override;
  std::string rowNote() const override;
  const char* rowWord() const noexcept override { return "line"; }
  void start(std::span<const std::size_t> columns, std::optional<std::size_t> time) override;
  bool next(TableRow& row) override;
  double fraction() const noexcept override { return reader_.fraction(); }
  std::string textOf(std::size_t index) const override;
  std::string placeOf(std::size_t index) const override;
  std::string endNote() const override;
  NulBytes nulBytes() const override { return reader_.nulBytes(); }

 private:
  struct Sensor {
    std::string name;
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<std::string> cells;  // row by row
    std::string label() const;
  };
  struct Frame {
    std::uint64_t line = 0;
    std::string number;
    std::string time;  // ISO 8601 where the date has the form of the export
    std::vector<Sensor> sensors;
    std::string fault = {};  // why it is not complete
  };
  bool nextLine();
  bool readFrame(Frame& frame);
  void readSensels(Frame& frame, Sensor& sensor);
  const std::string* cellAt(std::size_t index) const;

  std::filesystem::path path_;
  TableOptions options_;
  LineReader reader_;
  std::vector<std::string_view> cells_;  // of the last line that is not empty, without empty ones
  bool isHeld_ = false;                  // the last line is the next one again
  std::string unit_;
  Frame frame_;  // the last one
  std::uint64_t lastRowLine_ = 0;
  std::vector<TableColumn> columns_;
  std::vector<std::size_t> selected_;
  std::optional<std::size_t> time_;
};

}  // namespace palpate
