#include "palpate/recording/table_export.h"

#include <algorithm>
#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"

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

// One row per sample: time [ms], a column per value, named with its unit, and the time [us].
template <typename TimeOf, typename ValuesOf>
void tableExportWriteSamples(OutputFile& out,
                             const std::string& header,
                             std::size_t count,
                             TimeOf timeOf,
                             ValuesOf valuesOf) {
  std::string text = header;
  for (std::size_t i = 0; i < count; ++i) {
    appendNumber(text, static_cast<std::int64_t>(i));
    text += ',';
    appendNumber(text, floorMs(timeOf(i)));
    for (double value : valuesOf(i)) {
      text += ',';
      appendNumber(text, value);
    }
    text += ',';
    appendNumber(text, timeOf(i));
    text += '\n';
    writePiece(out, text);
  }
  writePiece(out, text, true);
}

// "sample,time_ms,axis0_deg,..,time_us", and the row of units below it.
std::string sampleHeader(const std::vector<std::string>& columns,
                         const std::vector<std::string>& units,
                         bool unitsRow) {
  std::vector<std::string> names{"sample", "time_ms"};
  names.insert(names.end(), columns.begin(), columns.end());
  names.emplace_back("time_us");
  if (!unitsRow) return csvLine(names);
  std::vector<std::string> below{"", "ms"};
  below.insert(below.end(), units.begin(), units.end());
  below.emplace_back("us");
  return csvLine(names) + csvLine(below);
}

std::string numberedName(const char* name, std::size_t index, const std::string& unit) {
  return name + std::to_string(index) + "_" + unit;
}

// "deg", or "mm" of a sliding axis.
std::vector<std::string> angleUnits(const Profile& profile) {
  std::vector<std::string> units(profile.angles(0).deg.size(), "deg");
  const std::vector<AxisDescription>& axes = profile.hand().axes;
  for (std::size_t i = 0; i < std::min(units.size(), axes.size()); ++i) units[i] = axes[i].unit();
  return units;
}

std::string angleHeader(const Profile& profile, bool unitsRow) {
  const std::vector<std::string> units = angleUnits(profile);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < units.size(); ++i) names.push_back(numberedName("axis", i, units[i]));
  return sampleHeader(names, units, unitsRow);
}

std::string temperatureHeader(const Profile& profile, bool unitsRow) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < profile.temperatures(0).degC.size(); ++i)
    names.push_back(numberedName("sensor", i, "degc"));
  return sampleHeader(names, std::vector<std::string>(names.size(), "degC"), unitsRow);
}

fs::path tableExportWithEnding(const fs::path& path, const char* ending) {
  fs::path other = path;
  other += ending;
  return other;
}

}  // namespace

void writeCsv(const Profile& profile,
              const fs::path& path,
              Overwrite overwrite,
              const Progress& progress,
              bool unitsRow) {
  constexpr std::size_t kFramesPerReport = 256;
  OutputFile taxels(path, overwrite);
  std::optional<OutputFile> angles;
  std::optional<OutputFile> temperatures;
  if (profile.numAngles() > 0)
    angles.emplace(tableExportWithEnding(path, ".angles.csv"), overwrite);
  if (profile.numTemperatures() > 0)
    temperatures.emplace(tableExportWithEnding(path, ".temperatures.csv"), overwrite);

  std::string text = "frame,time_ms,matrix,y,x,value,time_us\n";
  if (unitsRow) text += csvLine({"", "ms", "", "", "", profile.hand().unit, "us"});
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    profile.readFrame(i, frame);
    for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m) {
      const auto values = frame.matrix(m);
      for (Eigen::Index y = 0; y < values.rows(); ++y) {
        for (Eigen::Index x = 0; x < values.cols(); ++x) {
          if (!(values(y, x) > 0.0F)) continue;
          appendInteger(text, static_cast<std::int64_t>(i));
          appendInteger(text, floorMs(frame.hostUs));
          appendInteger(text, static_cast<std::int64_t>(m));
          appendInteger(text, y);
          appendInteger(text, x);
          appendNumber(text, values(y, x));
          text += ',';
          appendNumber(text, frame.hostUs);
          text += '\n';
        }
      }
    }
    writePiece(taxels, text);
  }
  writePiece(taxels, text, true);
  if (angles)
    tableExportWriteSamples(
        *angles,
        angleHeader(profile, unitsRow),
        profile.numAngles(),
        [&](std::size_t i) { return profile.angleTimeUs(i); },
        [&](std::size_t i) { return profile.angles(i).deg; });
  if (temperatures)
    tableExportWriteSamples(
        *temperatures,
        temperatureHeader(profile, unitsRow),
        profile.numTemperatures(),
        [&](std::size_t i) { return profile.temperatureTimeUs(i); },
        [&](std::size_t i) { return profile.temperatures(i).degC; });
  std::vector<OutputFile*> files{&taxels};
  if (angles) files.push_back(&*angles);
  if (temperatures) files.push_back(&*temperatures);
  commitTogether(files);
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
