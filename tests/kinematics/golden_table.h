// Reads tables of independently computed numbers (comma-separated, with a header) for the tests of
// kinematics.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "palpate/core/number_text.h"

namespace palpate::testing {

class GoldenTable {
 public:
  explicit GoldenTable(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("can't read " + path.string());
    const std::vector<std::string> names = fieldsOf(line);
    for (std::size_t i = 0; i < names.size(); ++i) columns_[names[i]] = i;
    while (std::getline(file, line)) {
      rows_.push_back(fieldsOf(line));
      if (rows_.back().size() != names.size()) throw std::runtime_error("odd row: " + line);
    }
  }
  std::size_t numRows() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& column) const {
    return rows_.at(row).at(columns_.at(column));
  }
  double number(std::size_t row, const std::string& column) const {
    return parseDouble(text(row, column)).value();
  }

 private:
  static std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',')
        fields.emplace_back();
      else if (c != '\r')
        fields.back() += c;
    }
    return fields;
  }

  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace palpate::testing
