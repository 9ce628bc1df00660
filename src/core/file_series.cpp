#include "palpate/core/file_series.h"

#include <algorithm>
#include <system_error>

#include "palpate/core/number_text.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kFewestDigits = 5;

bool isTaken(const fs::path& path) {
  std::error_code ignored;
  // A symbolic link without a target also occupies the name.
  return fs::exists(fs::symlink_status(path, ignored));
}

}  // namespace

std::string FileSeries::name(std::size_t number) const {
  const std::size_t digits = std::max(kFewestDigits, std::to_string(last).size());
  std::string text = std::to_string(number);
  if (text.size() < digits) text.insert(0, digits - text.size(), '0');
  return stem.empty() ? text + ending : stem + "_" + text + ending;
}

std::size_t numExisting(const FileSeries& series) {
  std::error_code failure;
  std::size_t found = 0;
  const std::string before = series.stem.empty() ? std::string() : series.stem + "_";
  // Read the folder once instead of testing each of up to a hundred thousand names.
  for (fs::directory_iterator at(series.folder, failure), end; !failure && at != end;
       at.increment(failure)) {
    const std::string name = at->path().filename().string();
    if (name.size() <= before.size() + series.ending.size() || !name.starts_with(before) ||
        !name.ends_with(series.ending))
      continue;
    const auto number = parseInteger(
        name.substr(before.size(), name.size() - before.size() - series.ending.size()));
    if (!number || *number < 0) continue;
    const auto index = static_cast<std::size_t>(*number);
    if (index >= series.first && index <= series.last && series.name(index) == name) ++found;
  }
  return found;
}

fs::path freePath(const fs::path& wanted) {
  fs::path path = wanted;
  for (int number = 2; isTaken(path); ++number) {
    path = wanted;
    path.replace_filename(wanted.stem().string() + "_" + std::to_string(number) +
                          wanted.extension().string());
  }
  return path;
}

}  // namespace palpate
