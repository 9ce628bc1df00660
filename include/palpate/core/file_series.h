// Numbered series of files, such as "grasp_00042.png", and unused file names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace palpate {

// One file for each number from first to last, both inclusive.
struct FileSeries {
  std::filesystem::path folder;
  // "grasp"; when empty, the name is the number alone.
  std::string stem;
  std::string ending;  // ".png", with its dot
  std::size_t first = 0;
  std::size_t last = 0;

  std::size_t count() const noexcept { return last < first ? 0 : last - first + 1; }
  // Name of one file. The number has at least five digits, and as many as the last one, so that
  // names sort like numbers.
  std::string name(std::size_t number) const;
  std::filesystem::path path(std::size_t number) const { return folder / name(number); }
};

// Returns how many files of the series exist; 0 when the folder does not exist.
std::size_t numExisting(const FileSeries& series);

// Returns `wanted` if no file has that name, otherwise the name with the first unused number from 2
// on: "a.png", "a_2.png", "a_3.png", ..
std::filesystem::path freePath(const std::filesystem::path& wanted);

}  // namespace palpate
