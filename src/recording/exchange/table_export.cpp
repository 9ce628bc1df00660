#include "palpate/recording/table_export.h"

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

// "sample,time_ms,axis0_deg,..,time_us", and the row of units below it.
std::string sampleHeader(const WrittenSamples& samples, const std::string& name, bool unitsRow) {
  std::vector<std::string> names{"sample", "time_ms"};
  std::vector<std::string> units{"", "ms"};
  for (std::size_t i = 0; i < samples.columns.size(); ++i) {
    const std::string& known = samples.columns[i].unit;
    units.push_back(known.empty() ? "deg" : known);
    names.push_back(name + std::to_string(i) + (known == "degC" ? "_degc" : "_" + units.back()));
  }
  names.emplace_back("time_us");
  units.emplace_back("us");
  return unitsRow ? csvLine(names) + csvLine(units) : csvLine(names);
}

// One row per sample: time [ms], a column per value, named with its unit, and the time [us].
void tableExportWriteSamples(OutputFile& out,
                             const WrittenSamples& samples,
                             const std::string& name,
                             bool unitsRow) {
  std::string text = sampleHeader(samples, name, unitsRow);
  for (std::size_t i = 0; i < samples.count; ++i) {
    appendInteger(text, static_cast<std::int64_t>(i));
    appendNumber(text, floorMs(samples.timeUs(i)));
    for (double value : samples.values(i)) {
      text += ',';
      appendNumber(text, value);
    }
    text += ',';
    appendNumber(text, samples.timeUs(i));
    text += '\n';
    writePiece(out, text);
  }
  writePiece(out, text, true);
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
  if (angles) tableExportWriteSamples(*angles, writtenSamples(profile, kAngleSeries), "axis", unitsRow);
  if (temperatures)
    tableExportWriteSamples(*temperatures, writtenSamples(profile, kTemperatureSeries), "sensor", unitsRow);
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
