#include "palpate/recording/table_export.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"

#include "recording/sample_columns.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kTableExportPieceBytes = 1u << 16;

void writePiece(OutputFile& out, std::string& text, bool last = false) {
  if (!last && text.size() < kTableExportPieceBytes) return;
  out.write(text);
  text.clear();
}

void appendInteger(std::string& text, std::int64_t value) {
  appendNumber(text, value);
  text += ',';
}

// "sample,time_ms,axis0_deg,..,time_us", and the row of units below it. Columns of further series
// have their own names.
std::string sampleHeader(const WrittenSamples& samples, std::size_t series, bool unitsRow) {
  std::vector<std::string> names{"sample", "time_ms"};
  std::vector<std::string> units{"", "ms"};
  for (std::size_t i = 0; i < samples.columns.size(); ++i) {
    const auto& [name, known] = samples.columns[i];
    if (series >= kHandSeries) {
      units.push_back(known);
      names.push_back(known.empty() ? name : name + "_" + known);
      continue;
    }
    units.push_back(known.empty() ? "deg" : known);
    names.push_back((series == kAngleSeries ? "axis" : "sensor") + std::to_string(i) +
                    (known == "degC" ? "_degc" : "_" + units.back()));
  }
  names.emplace_back("time_us");
  units.emplace_back("us");
  if (samples.deviceUs) {
    names.emplace_back("device_time_us");
    units.emplace_back("us");
  }
  return unitsRow ? csvLine(names) + csvLine(units) : csvLine(names);
}

// One row per sample: time [ms], a column per value (empty: not known), named with its unit, the
// time [us], and where it is known that of the sender.
void tableExportWriteSamples(OutputFile& out,
                             const WrittenSamples& samples,
                             std::size_t series,
                             bool unitsRow) {
  std::string text = sampleHeader(samples, series, unitsRow);
  for (std::size_t i = 0; i < samples.count; ++i) {
    appendInteger(text, static_cast<std::int64_t>(i));
    appendNumber(text, floorMs(samples.timeUs(i)));
    for (double value : samples.values(i)) {
      text += ',';
      if (!std::isnan(value)) appendNumber(text, value);
    }
    text += ',';
    appendNumber(text, samples.timeUs(i));
    if (samples.deviceUs) {
      text += ',';
      const std::int64_t deviceUs = samples.deviceUs(i);
      if (deviceUs != kNoSampleDeviceTime) appendNumber(text, deviceUs);
    }
    text += '\n';
    writePiece(out, text);
  }
  writePiece(out, text, true);
}

}  // namespace

std::vector<fs::path> writeCsv(const Profile& profile,
                               const fs::path& path,
                               Overwrite overwrite,
                               const Progress& progress,
                               bool unitsRow) {
  constexpr std::size_t kFramesPerReport = 256;
  OutputFile taxels(path, overwrite);
  std::vector<std::pair<std::size_t, std::unique_ptr<OutputFile>>> series;
  std::vector<fs::path> further;
  for (std::size_t i = 0; i < profile.series().size(); ++i) {
    if (profile.numSamples(i) == 0) continue;
    fs::path beside = path;
    beside += "." + profile.series()[i].name + ".csv";
    series.emplace_back(i, std::make_unique<OutputFile>(beside, overwrite));
    if (i >= kHandSeries) further.push_back(std::move(beside));
  }

  std::vector<std::string> names{"frame", "time_ms", "matrix", "y", "x", "value", "time_us"};
  std::vector<std::string> units{"", "ms", "", "", "", profile.hand().unit, "us"};
  if (profile.givesReadings())
    for (const char* name : {"dx", "dy", "dz"}) {
      names.emplace_back(name);
      units.push_back(profile.hand().unit);
    }
  std::string text = csvLine(names);
  if (unitsRow) text += csvLine(units);
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    profile.readFrame(i, frame);
    for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m) {
      const auto values = frame.matrix(m);
      for (Eigen::Index y = 0; y < values.rows(); ++y) {
        for (Eigen::Index x = 0; x < values.cols(); ++x) {
          if (!isTouched(values(y, x))) continue;
          appendInteger(text, static_cast<std::int64_t>(i));
          appendInteger(text, floorMs(frame.hostUs));
          appendInteger(text, static_cast<std::int64_t>(m));
          appendInteger(text, y);
          appendInteger(text, x);
          appendNumber(text, values(y, x));
          text += ',';
          appendNumber(text, frame.hostUs);
          if (profile.givesReadings()) {
            const bool isOne = profile.layout().matrix(m).touch.components == 1;
            const auto force = forceAt(frame, {m, static_cast<int>(y), static_cast<int>(x)});
            for (std::size_t k = 0; k < force.size(); ++k) {
              text += ',';
              if (!isOne || k == 2) appendNumber(text, force[k]);
            }
          }
          text += '\n';
        }
      }
    }
    writePiece(taxels, text);
  }
  writePiece(taxels, text, true);
  std::vector<OutputFile*> files{&taxels};
  for (const auto& [index, out] : series) {
    tableExportWriteSamples(*out, writtenSamples(profile, index), index, unitsRow);
    files.push_back(out.get());
  }
  commitTogether(files);
  return further;
}

TextTable taxelTable(const TactileFrame& frame, const std::string& index) {
  struct Place {
    std::size_t matrix;
    int y;
    int x;
    float value;
  };
  std::vector<Place> places;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const MatrixLayout& layout = frame.layout->matrix(m);
    const auto values = frame.allValues(m);
    for (int y = 0; y < layout.rows; ++y)
      for (int x = 0; x < layout.columns; ++x)
        if (layout.enabled(y, x)) places.push_back({m, y, x, values(y, x)});
  }
  const std::size_t numCells = places.size();
  return {.header = {"frame", "time_ms", "matrix", "y", "x", "value"},
          .numRows = numCells,
          .row = [places = std::move(places),
                  index,
                  timeMs = std::to_string(frame.hostUs / kUsPerMs)](std::size_t row) {
            const Place& place = places[row];
            return std::vector<std::string>{index,
                                            timeMs,
                                            std::to_string(place.matrix),
                                            std::to_string(place.y),
                                            std::to_string(place.x),
                                            numberText(place.value)};
          }};
}

}  // namespace palpate
