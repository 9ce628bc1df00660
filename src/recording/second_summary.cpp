#include "palpate/recording/second_summary.h"

#include <algorithm>

#include "palpate/core/progress.h"

#include "recording/format_reader.h"
#include "recording/native/palpate_connection.h"
#include "recording/native/palpate_rows.h"

namespace palpate {

void SecondSummarizer::add(const TactileFrame& frame) {
  constexpr std::int64_t kSecondUs = 1'000'000;
  std::int64_t second = frame.hostUs / kSecondUs;
  if (frame.hostUs < second * kSecondUs) --second;  // before 1970
  if (!rows_.empty() && rows_.front().tS != second) flush();
  const std::size_t numMatrices = frame.layout->numMatrices();
  if (rows_.empty()) {
    rows_.resize(numMatrices);
    for (std::size_t m = 0; m < numMatrices; ++m) {
      rows_[m].tS = second;
      rows_[m].matrix = static_cast<int>(m);
    }
  }
  for (std::size_t m = 0; m < numMatrices; ++m) {
    SecondSummary& row = rows_[m];
    const auto values = frame.matrix(m);
    int active = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const double value = static_cast<double>(values.data()[i]);
      if (!isTouched(value)) continue;
      const bool first = row.activeMax == 0 && active == 0;
      row.minimum = first ? value : std::min(row.minimum, value);
      row.maximum = std::max(row.maximum, value);
      row.sum += value;
      ++active;
    }
    row.activeMax = std::max(row.activeMax, active);
    ++row.frames;
  }
}

void SecondSummarizer::flush() {
  for (const SecondSummary& row : rows_) sink_(row);
  rows_.clear();
}

std::vector<SecondSummary> secondsOf(const Profile& profile, const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 1024;
  std::vector<SecondSummary> seconds;
  SecondSummarizer summarizer([&](const SecondSummary& row) { seconds.push_back(row); });
  TactileFrame frame;
  const std::size_t numFrames = profile.numFrames();
  for (std::size_t i = 0; i < numFrames; ++i) {
    reportProgress(progress, i, numFrames, kFramesPerReport);
    profile.readFrame(i, frame);
    summarizer.add(frame);
  }
  summarizer.flush();
  return seconds;
}

std::vector<SecondSummary> readSeconds(const std::filesystem::path& path) {
  const auto seconds = readerOf(path).seconds;
  return seconds ? seconds(path) : secondsOf(openRecording(path));
}

std::vector<SecondSummary> readPalpateSeconds(const std::filesystem::path& path) {
  PalpateConnection access(path);
  const std::size_t numMatrices = readLayout(access.database(), access.meta()).numMatrices();
  auto seconds =
      readOverview(access.database(), numMatrices, access.meta().integer("seconds").value_or(0));
  if (seconds) return std::move(*seconds);
  std::size_t damaged = 0;
  return readSecondRows(access.database(), damaged);
}

}  // namespace palpate
