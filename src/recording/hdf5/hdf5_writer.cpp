#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/model/active_taxels.h"
#include "palpate/recording/hdf5_recording.h"

#include "recording/hdf5/hdf5_arrays.h"
#include "recording/hdf5/hdf5_layout.h"
#include "recording/profile_meta.h"
#include "recording/running_series.h"
#include "recording/sample_columns.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxChunkBytes = 256u << 10;
constexpr std::size_t kMaxChunkFrames = 1024;
constexpr std::size_t kMaxChunkRows = 4096;

class Hdf5Writer : Hdf5Arrays {
 public:
  Hdf5Writer(const RecordingContent& content,
             const std::filesystem::path& path,
             Overwrite overwrite,
             const Progress& progress,
             const Hdf5WriteOptions& options)
      : Hdf5Arrays(path, overwrite, options),
        content_(content),
        profile_(content.profile),
        progress_(progress) {}

  void write() {
    {
      const auto lock = hdf5Lock();
      writeRoot();
      writeMeta();
      writeEvents();
      const Hdf5Id tactile = makeGroup("tactile");
      if (profile_.givesReadings())
        attribute(tactile.get(), kTouchRulesKey, touchRulesText(profile_.layout()));
      makeGroup("joints");
      makeGroup("temperatures");
      describeSeries();
    }
    for (std::size_t i = 0; i < profile_.series().size(); ++i)
      writeSamples(hdf5_layout::seriesGroup(i, profile_.series()[i].name),
                   hdf5_layout::seriesValues(i),
                   writtenSamples(profile_, i));
    writeFrames();
    finishChunks();
    writeVersion();
    series_.clear();
    commit();
  }

 private:
  // A series, and where its rows go.
  struct WrittenSeries {
    ChunkedArray* times = nullptr;
    ChunkedArray* values = nullptr;
    std::unique_ptr<RunningSeries> rows;
  };

  // -- Objects of the file; the lock is held. --

  // The stamps of a series, as the scale of its first axis.
  ChunkedArray& timeArray(const std::string& group, std::size_t count, std::size_t perChunk) {
    ChunkedArray& times = chunkedArray(group + "/time_us", i64(), {count}, {perChunk});
    attribute(times.id.get(), "units", std::string("us"));
    attribute(times.id.get(), "epoch", std::string("1970-01-01T00:00:00Z"));
    makeScale(times.id.get(), "time");
    return times;
  }

  // -- Parts of the recording --

  void writeRoot() {
    const hid_t root = out_.file();
    const Provenance& from = content_.extras.provenance;
    attribute(root, "format", std::string(hdf5_layout::kFormat));
    attribute(root, "program", from.program);
    attribute(root, "source_file", from.sourceFile);
    attribute(root, "source_sha256", from.sourceSha256);
    attribute(root, "filters", from.filters);
    attribute(root, "calibration", from.calibration);
    attribute(root, "hand", from.hand.empty() ? profile_.hand().name : from.hand);
  }

  // Earlier programs would read the values below 0 of filtered frames as 0, leave out series
  // without a word, and take taxels for squares.
  void writeVersion() {
    const auto lock = hdf5Lock();
    attribute(out_.file(),
              "format_version",
              profile_.givesReadings() ? kHdf5LayoutVersion
              : profile_.series().size() > kHandSeries || !profile_.layout().hasSquareTaxels()
                  ? hdf5_layout::kSeriesLayoutVersion
              : anyFiltered_ ? hdf5_layout::kFilteredLayoutVersion
                             : hdf5_layout::kUnfilteredLayoutVersion);
  }

  void writeMeta() {
    std::vector<std::string> keys;
    std::vector<std::string> values;
    for (const auto& [key, value] : writtenMeta(profile_.info(), profile_.hand(), content_.meta)) {
      keys.push_back(key);
      values.push_back(value);
    }
    makeGroup("meta");
    const Hdf5Id key = textArray("meta/key", keys);
    const Hdf5Id value = textArray("meta/value", values);
    if (keys.empty()) return;
    makeScale(key.get(), "key");
    attachScale(value.get(), key.get(), 0);
  }

  void writeEvents() {
    const EventColumns<std::int32_t> events(content_.events, hdf5_layout::kNoMatrix);
    makeGroup("events");
    const Shape count{events.timesUs.size()};
    const Hdf5Id time = smallArray("events/time_us", i64(), count, events.timesUs.data());
    attribute(time.get(), "units", std::string("us"));
    attribute(time.get(), "epoch", std::string("1970-01-01T00:00:00Z"));
    std::vector<Hdf5Id> columns;
    columns.push_back(smallArray("events/end_us", i64(), count, events.endsUs.data()));
    attribute(columns.back().get(), "units", std::string("us"));
    columns.push_back(textArray("events/kind", events.kinds));
    columns.push_back(smallArray("events/matrix", i32(), count, events.matrices.data()));
    columns.push_back(textArray("events/text", events.texts));
    columns.push_back(textArray("events/json", events.jsons));
    if (events.timesUs.empty()) return;
    makeScale(time.get(), "time");
    for (const Hdf5Id& column : columns) attachScale(column.get(), time.get(), 0);
  }

  // What further series are.
  void describeSeries() {
    if (profile_.series().size() == kHandSeries) return;
    std::string names;
    const Hdf5Id all = makeGroup("series");
    for (std::size_t i = kHandSeries; i < profile_.series().size(); ++i) {
      const SeriesDescription& series = profile_.series()[i];
      names += (names.empty() ? "" : ",") + series.name;
      const std::string path = hdf5_layout::seriesGroup(i, series.name);
      const Hdf5Id group = makeGroup(path);
      attribute(group.get(), "role", series.role);
      attribute(group.get(), "source", series.source);
      textArray(path + "/unit", columnUnits(series.columns));
      if (profile_.numSamples(i) == 0) textArray(path + "/column", columnNames(series.columns));
    }
    attribute(all.get(), hdf5_layout::kSeriesNames, names);
  }

  // The samples of a series: times, and a column per value.
  void writeSamples(const std::string& group,
                    const std::string& name,
                    const WrittenSamples& samples) {
    const std::size_t count = samples.count;
    if (count == 0) return;
    const std::size_t width = samples.columns.size();
    const std::vector<std::string> units = columnUnits(samples.columns);
    const std::size_t perChunk = std::min(count, kMaxChunkRows);
    ChunkedArray* times = nullptr;
    ChunkedArray* values = nullptr;
    ChunkedArray* deviceTimes = nullptr;
    {
      const auto lock = hdf5Lock();
      times = &timeArray(group, count, perChunk);
      if (samples.deviceUs) {
        deviceTimes = &chunkedArray(
            group + "/device_time_us", i64(), {count}, {perChunk}, hdf5_layout::kNoDeviceTime);
        attribute(deviceTimes->id.get(), "units", std::string("us"));
        attribute(deviceTimes->id.get(), "missing_value", hdf5_layout::kNoDeviceTime);
        attachScale(deviceTimes->id.get(), times->id.get(), 0);
      }
      values = &chunkedArray(group + "/" + name, f64(), {count, width}, {perChunk, width});
      const bool sameUnit = std::equal(units.begin() + 1, units.end(), units.begin());
      attribute(
          values->id.get(), "units", sameUnit ? units.front() : std::string("see column_units"));
      attribute(values->id.get(), "column_units", units);
      const Hdf5Id column = textArray(group + "/column", columnNames(samples.columns));
      makeScale(column.get(), "column");
      attachScale(values->id.get(), times->id.get(), 0);
      attachScale(values->id.get(), column.get(), 1);
    }
    for (std::size_t first = 0; first < count; first += perChunk) {
      Bytes timeBytes(perChunk * 8);
      Bytes valueBytes(perChunk * width * 8);
      Bytes deviceBytes(deviceTimes ? perChunk * 8 : 0);
      const std::size_t end = std::min(count, first + perChunk);
      for (std::size_t i = first; i < end; ++i) {
        put(timeBytes, i - first, samples.timeUs(i));
        if (deviceTimes) put(deviceBytes, i - first, samples.deviceUs(i));
        const std::vector<double> row = samples.values(i);
        if (row.size() != width)
          throw std::invalid_argument("writeHdf5: samples of several widths");
        std::memcpy(valueBytes.data() + (i - first) * width * 8, row.data(), width * 8);
      }
      addChunk(*times, {first}, std::move(timeBytes));
      addChunk(*values, {first, 0}, std::move(valueBytes));
      if (deviceTimes) addChunk(*deviceTimes, {first}, std::move(deviceBytes));
    }
  }

  // The arrays of the frames.
  struct FrameArrays {
    ChunkedArray* times = nullptr;
    ChunkedArray* deviceTimes = nullptr;  // made with the first frame that has one
    ChunkedArray* isFiltered = nullptr;   // of a recording of floats
    std::vector<ChunkedArray*> matrices;
    std::vector<ChunkedArray*> active;    // of a recording of floats
    std::vector<ChunkedArray*> kept;      // of a recording of floats
    std::vector<ChunkedArray*> readings;  // of a recording with readings
    std::size_t perChunk = 1;
  };

  std::size_t framesPerChunk() const {
    std::size_t largest = 1;
    for (const MatrixLayout& matrix : profile_.layout().matrices())
      largest = std::max(largest, matrix.numReadings());
    const std::size_t fitting = kMaxChunkBytes / (largest * sizeof(float));
    return std::clamp<std::size_t>(std::min(fitting, profile_.numFrames()), 1, kMaxChunkFrames);
  }

  // Positions of rows or columns [mm], as a scale.
  void attachPositions(ChunkedArray& array,
                       const std::string& name,
                       const char* axis,
                       int count,
                       double pitchMm,
                       unsigned dimension) {
    std::vector<double> positions;
    for (int i = 0; i < count; ++i) positions.push_back(i * pitchMm);
    const Hdf5Id scale = smallArray(name, f64(), {positions.size()}, positions.data());
    attribute(scale.get(), "units", std::string("mm"));
    makeScale(scale.get(), axis);
    attachScale(array.id.get(), scale.get(), dimension);
  }

  void makeMatrix(FrameArrays& frames, std::size_t m, bool counts) {
    const MatrixLayout& layout = profile_.layout().matrix(m);
    const HandDescription& hand = profile_.hand();
    const std::string path = hdf5_layout::matrixPath(m);
    const auto rows = static_cast<hsize_t>(layout.rows);
    const auto columns = static_cast<hsize_t>(layout.columns);
    const Shape shape{profile_.numFrames(), rows, columns};
    const Shape chunk{frames.perChunk, rows, columns};
    ChunkedArray& array = chunkedArray(path, counts ? u16() : f32(), shape, chunk);
    const hid_t id = array.id.get();
    attribute(id, "units", hand.unit);
    attribute(id, "axes", std::string("time, row (0 is the fingertip), column"));
    attribute(id, "name", hand.matrixName(m));
    attribute(id, "pitch_mm", layout.pitchMm.x);
    if (!layout.pitchMm.isSquare()) attribute(id, "pitch_y_mm", layout.pitchMm.y);
    attribute(id, "unique_id", layout.uniqueId);
    attachScale(id, frames.times->id.get(), 0);
    attachPositions(array, path + "_y", "y", layout.rows, layout.pitchMm.y, 1);
    attachPositions(array, path + "_x", "x", layout.columns, layout.pitchMm.x, 2);
    const Hdf5Id staticMask =
        smallArray(path + "_static_mask", u8(), {rows, columns}, layout.staticMask.data());
    const Hdf5Id dynamicMask =
        smallArray(path + "_dynamic_mask", u8(), {rows, columns}, layout.dynamicMask.data());
    frames.matrices.push_back(&array);
    if (profile_.givesReadings()) frames.readings.push_back(&makeReadings(m, frames, shape, chunk));
    if (counts) return;
    const auto mask = [&](const char* ending) {
      ChunkedArray& made = chunkedArray(path + ending, u8(), shape, chunk);
      attachScale(made.id.get(), frames.times->id.get(), 0);
      return &made;
    };
    frames.active.push_back(mask("_active"));
    frames.kept.push_back(mask("_kept"));
  }

  ChunkedArray& makeReadings(std::size_t m, const FrameArrays& frames, Shape shape, Shape chunk) {
    const int components = profile_.layout().matrix(m).touch.components;
    shape.push_back(static_cast<hsize_t>(components));
    chunk.push_back(static_cast<hsize_t>(components));
    ChunkedArray& made =
        chunkedArray(hdf5_layout::readingsPath(m), f32(), std::move(shape), std::move(chunk));
    attribute(made.id.get(), "units", profile_.hand().unit);
    attribute(made.id.get(),
              "axes",
              std::string("time, row (0 is the fingertip), column, component") +
                  (components == 3 ? " (x, y, z)" : ""));
    attachScale(made.id.get(), frames.times->id.get(), 0);
    return made;
  }

  FrameArrays makeFrameArrays() {
    const auto lock = hdf5Lock();
    FrameArrays frames;
    frames.perChunk = framesPerChunk();
    const std::size_t count = profile_.numFrames();
    const bool counts = profile_.hasCounts();
    frames.times = &timeArray("tactile", count, frames.perChunk);
    for (std::size_t m = 0; m < profile_.layout().numMatrices(); ++m) makeMatrix(frames, m, counts);
    if (!counts) {
      frames.isFiltered = &chunkedArray("tactile/filtered", u8(), {count}, {frames.perChunk});
      attachScale(frames.isFiltered->id.get(), frames.times->id.get(), 0);
    }
    return frames;
  }

  void makeDeviceTimes(FrameArrays& frames) {
    const auto lock = hdf5Lock();
    frames.deviceTimes = &chunkedArray("tactile/device_time_ms",
                                       i64(),
                                       {profile_.numFrames()},
                                       {frames.perChunk},
                                       hdf5_layout::kNoDeviceTime);
    const hid_t id = frames.deviceTimes->id.get();
    attribute(id, "units", std::string("ms"));
    attribute(id, "missing_value", hdf5_layout::kNoDeviceTime);
    attachScale(id, frames.times->id.get(), 0);
  }

  void writeFrames() {
    FrameArrays frames = makeFrameArrays();
    for (const auto& series : content_.extras.series) startSeries(*series);
    const std::size_t count = profile_.numFrames();
    TactileFrame frame;
    for (std::size_t first = 0; first < count; first += frames.perChunk) {
      reportProgress(progress_, first, count);
      writeFrameChunk(frames, first, std::min(count, first + frames.perChunk), frame);
      for (const auto& series : series_) takeRows(series, first + frames.perChunk);
    }
    for (const auto& series : series_) takeRows(series, std::numeric_limits<std::size_t>::max());
  }

  void writeFrameChunk(FrameArrays& frames,
                       std::size_t first,
                       std::size_t end,
                       TactileFrame& frame) {
    const SensorLayout& layout = profile_.layout();
    const bool counts = frames.active.empty();
    Bytes times(frames.perChunk * 8);
    Bytes deviceTimes(frames.perChunk * 8);
    Bytes isFiltered(counts ? 0 : frames.perChunk);
    std::vector<Bytes> values(layout.numMatrices());
    std::vector<Bytes> active(counts ? 0 : layout.numMatrices());
    std::vector<Bytes> kept(active.size());
    std::vector<Bytes> readings(frames.readings.size());
    for (std::size_t m = 0; m < readings.size(); ++m)
      readings[m].resize(frames.perChunk * layout.matrix(m).numReadings() * sizeof(float));
    for (std::size_t m = 0; m < values.size(); ++m) {
      const std::size_t cells = frames.perChunk * layout.matrix(m).numCells();
      values[m].resize(cells * (counts ? 2 : 4));
      if (counts) continue;
      active[m].resize(cells);
      kept[m].resize(cells);
    }
    bool anyDevice = false;
    for (std::size_t i = 0; i < frames.perChunk; ++i)
      put(deviceTimes, i, hdf5_layout::kNoDeviceTime);
    for (std::size_t i = first; i < end; ++i) {
      profile_.readFrame(i, frame);
      const std::size_t at = i - first;
      put(times, at, frame.hostUs);
      put(deviceTimes, at, frame.deviceUs ? floorMs(*frame.deviceUs) : hdf5_layout::kNoDeviceTime);
      anyDevice = anyDevice || frame.deviceUs;
      if (!counts && !frame.filtered.empty()) {
        isFiltered[at] = 1;
        anyFiltered_ = true;
      }
      for (std::size_t m = 0; m < readings.size(); ++m) {
        const std::size_t bytes = layout.matrix(m).numReadings() * sizeof(float);
        std::memcpy(readings[m].data() + at * bytes,
                    frame.readings.data() + layout.readingOffset(m),
                    bytes);
      }
      for (std::size_t m = 0; m < values.size(); ++m) {
        const std::size_t cells = layout.matrix(m).numCells();
        const float* all = frame.allValues().data() + layout.offset(m);
        if (counts) {
          auto* to = reinterpret_cast<std::uint16_t*>(values[m].data()) + at * cells;
          bool exact = true;
          for (std::size_t k = 0; k < cells; ++k) {
            to[k] = static_cast<std::uint16_t>(static_cast<int>(all[k]));
            exact &= static_cast<float>(to[k]) == all[k];
          }
          if (!exact)
            throw std::invalid_argument("writeHdf5: frame " + std::to_string(i) +
                                        " of a recording of counts has another value");
        } else {
          std::memcpy(values[m].data() + at * cells * 4, all, cells * 4);
          const std::size_t begin = layout.offset(m);
          for (std::size_t k = 0; k < cells; ++k) {
            active[m][at * cells + k] = isActive(frame, begin + k);
            kept[m][at * cells + k] = isKept(frame, begin + k);
          }
        }
      }
    }
    if (anyDevice && !frames.deviceTimes) makeDeviceTimes(frames);
    addChunk(*frames.times, {first}, std::move(times));
    if (frames.deviceTimes) addChunk(*frames.deviceTimes, {first}, std::move(deviceTimes));
    if (frames.isFiltered) addChunk(*frames.isFiltered, {first}, std::move(isFiltered));
    for (std::size_t m = 0; m < readings.size(); ++m)
      addChunk(*frames.readings[m], {first, 0, 0, 0}, std::move(readings[m]));
    for (std::size_t m = 0; m < values.size(); ++m) {
      addChunk(*frames.matrices[m], {first, 0, 0}, std::move(values[m]));
      if (counts) continue;
      addChunk(*frames.active[m], {first, 0, 0}, std::move(active[m]));
      addChunk(*frames.kept[m], {first, 0, 0}, std::move(kept[m]));
    }
  }

  // -- Series --

  void startSeries(ExportedSeries& series) {
    const std::size_t count = series.numRows();
    const std::size_t width = series.columns().size();
    const std::size_t perChunk = std::clamp<std::size_t>(count, 1, kMaxChunkRows);
    WrittenSeries written;
    {
      const auto lock = hdf5Lock();
      const std::string& group = series.name();
      makeGroup(group);
      written.times = &timeArray(group, count, perChunk);
      written.values = &chunkedArray(group + "/values", f64(), {count, width}, {perChunk, 1});
      attribute(written.values->id.get(), "column_units", columnUnits(series.columns()));
      const Hdf5Id column = textArray(group + "/column", columnNames(series.columns()));
      makeScale(column.get(), "column");
      attachScale(written.values->id.get(), written.times->id.get(), 0);
      attachScale(written.values->id.get(), column.get(), 1);
    }
    written.rows = std::make_unique<RunningSeries>(series, "writeHdf5");
    series_.push_back(std::move(written));
  }

  // Writes the chunks that begin before row `until`.
  void takeRows(const WrittenSeries& series, std::size_t until) {
    RunningSeries& rows = *series.rows;
    const std::size_t perChunk = series.times->chunk[0];
    while (rows.taken() < until && rows.nextUs()) {
      const hsize_t first = rows.taken();
      Bytes times(perChunk * 8);
      std::vector<Bytes> columns(series.values->shape[1], Bytes(perChunk * 8));
      for (std::size_t i = 0; i < perChunk && rows.nextUs(); ++i, rows.advance()) {
        put(times, i, *rows.nextUs());
        for (std::size_t c = 0; c < columns.size(); ++c) put(columns[c], i, rows.row()[c]);
      }
      addChunk(*series.times, {first}, std::move(times));
      for (std::size_t c = 0; c < columns.size(); ++c)
        addChunk(*series.values, {first, c}, std::move(columns[c]));
    }
  }

  const RecordingContent& content_;
  const Profile& profile_;
  const Progress& progress_;
  bool anyFiltered_ = false;  // frames that were written so far
  std::vector<WrittenSeries> series_;
};

}  // namespace

void writeHdf5(const RecordingContent& content,
               const std::filesystem::path& path,
               Overwrite overwrite,
               const Progress& progress,
               const Hdf5WriteOptions& options) {
  if (options.level < 0 || options.level > 9)
    throw std::invalid_argument("Hdf5WriteOptions.level is " + std::to_string(options.level) +
                                ", not in 0..9");
  Hdf5Writer(content, path, overwrite, progress, options).write();
}

}  // namespace palpate
