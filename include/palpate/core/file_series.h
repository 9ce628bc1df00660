// Files that belong together by number, "grasp_00042.png", and names that nothing has yet.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace palpate {

// One file for each number from first to last, both inclusive.
struct FileSeries {
  std::filesystem::path folder;
  std::string stem;    // "grasp"; empty: the number alone
  std::string ending;  // ".png", with its dot
  std::size_t first = 0;
  std::size_t last = 0;

  std::size_t count() const noexcept { return last < first ? 0 : last - first + 1; }
  // At least five digits, and as many as the last one has: the names sort like the numbers.
  std::string name(std::size_t number) const;
  std::filesystem::path path(std::size_t number) const { return folder / name(number); }
};

// How many files of the series are there already; none where there is no folder.
std::size_t numExisting(const FileSeries& series);

// `wanted` itself where nothing has that name, else with the first number from 2 on that is free:
// "a.png", "a_2.png", "a_3.png", ..
std::filesystem::path freePath(const std::filesystem::path& wanted);

}  // namespace palpate
