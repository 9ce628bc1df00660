#include "palpate/recording/mat_export.h"

#include <cstring>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/model/active_taxels.h"

#include "recording/exchange/mat_file.h"
#include "recording/profile_meta.h"
#include "recording/sample_columns.h"

namespace palpate {
namespace {

using Fields = std::vector<std::pair<std::string, MatValue>>;

template <typename Number>
std::string_view matBytesOf(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// Times are collected while values are written, and written behind them.
class MatExport {
 public:
  MatExport(const Profile& profile, const Progress& progress)
      : profile_(profile), progress_(progress) {}

  MatValue tactile() {
    const SensorLayout& layout = profile_.layout();
    const bool counts = profile_.hasCounts();
    Fields fields;
    for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
      const std::string name = "m" + std::to_string(m);
      fields.emplace_back(name,
                          MatValue::numbers(counts ? MatNumber::kU16 : MatNumber::kF32,
                                            shapeOf(m),
                                            [this, m, counts](const MatSink& sink) {
                                              writeMatrix(m, counts, sink);
                                            }));
      if (!counts)
        fields.emplace_back(
            name + "_active",
            MatValue::numbers(MatNumber::kU8, shapeOf(m), [this, m](const MatSink& sink) {
              writeActive(m, sink);
            }));
      const MatrixLayout& matrix = layout.matrix(m);
      if (profile_.givesReadings()) {
        std::vector<std::uint64_t> shape = shapeOf(m);
        shape.insert(shape.begin(), static_cast<std::uint64_t>(matrix.touch.components));
        fields.emplace_back(
            name + "_readings",
            MatValue::numbers(MatNumber::kF32, std::move(shape), [this, m](const MatSink& sink) {
              writeReadings(m, sink);
            }));
      }
      fields.emplace_back(name + "_static_mask", maskOf(matrix, matrix.staticMask));
      fields.emplace_back(name + "_dynamic_mask", maskOf(matrix, matrix.dynamicMask));
      fields.emplace_back(name + "_name", MatValue::text(profile_.hand().matrixName(m)));
      fields.emplace_back(name + "_y", positions(matrix.rows, matrix.pitchMm.y));
      fields.emplace_back(name + "_x", positions(matrix.columns, matrix.pitchMm.x));
    }
    if (profile_.givesReadings())
      fields.emplace_back(kTouchRulesKey, MatValue::text(touchRulesText(layout)));
    fields.emplace_back("units", MatValue::text(profile_.hand().unit));
    fields.emplace_back("time_us", stampsOf(profile_.numFrames(), [this](std::size_t i) {
                          return profile_.frameTimeUs(i);
                        }));
    fields.emplace_back(
        "device_time_ms",
        MatValue::numbers(MatNumber::kI64, {profile_.numFrames(), 1}, [this](const MatSink& sink) {
          sink(matBytesOf(deviceMs_));
        }));
    return MatValue::structure(std::move(fields));
  }

  // A series with samples of its own.
  static MatValue samples(const std::string& name, const WrittenSamples& from) {
    Fields fields{{name,
                   MatValue::numbers(MatNumber::kF64,
                                     {from.columns.size(), from.count},
                                     [from](const MatSink& sink) {
                                       for (std::size_t i = 0; i < from.count; ++i)
                                         sink(matBytesOf(from.values(i)));
                                     })},
                  {"column", MatValue::texts(columnNames(from.columns))},
                  {"units", MatValue::texts(columnUnits(from.columns))},
                  {"time_us", stampsOf(from.count, from.timeUs)}};
    if (from.deviceUs) fields.emplace_back("device_time_us", stampsOf(from.count, from.deviceUs));
    return MatValue::structure(std::move(fields));
  }

  // A field for each further series. Throws FileError where a name is too long.
  static MatValue further(const Profile& profile, const std::filesystem::path& path) {
    Fields fields;
    for (std::size_t i = kHandSeries; i < profile.series().size(); ++i) {
      const std::string& name = profile.series()[i].name;
      if (name.size() > kMaxMatName)
        throw FileError(path,
                        "can't hold the series '" + name + "': names have at most " +
                            std::to_string(kMaxMatName) + " letters; write .h5 or .palpate");
      fields.emplace_back(name, samples("values", writtenSamples(profile, i)));
    }
    return MatValue::structure(std::move(fields));
  }

  static MatValue series(ExportedSeries& from) {
    const auto times = std::make_shared<std::vector<std::int64_t>>();
    const std::size_t width = from.columns().size();
    return MatValue::structure(
        {{"values",
          MatValue::numbers(MatNumber::kF64,
                            {width, from.numRows()},
                            [times, width, &from](const MatSink& sink) {
                              std::vector<double> row(width);
                              std::int64_t timeUs = 0;
                              while (from.next(timeUs, row)) {
                                times->push_back(timeUs);
                                sink(matBytesOf(row));
                              }
                            })},
         {"column", MatValue::texts(columnNames(from.columns()))},
         {"units", MatValue::texts(columnUnits(from.columns()))},
         {"time_us",
          MatValue::numbers(MatNumber::kI64, {from.numRows(), 1}, [times](const MatSink& sink) {
            sink(matBytesOf(*times));
          })}});
  }

 private:
  std::vector<std::uint64_t> shapeOf(std::size_t m) const {
    const MatrixLayout& matrix = profile_.layout().matrix(m);
    return {static_cast<std::uint64_t>(matrix.columns),
            static_cast<std::uint64_t>(matrix.rows),
            profile_.numFrames()};
  }

  static MatValue maskOf(const MatrixLayout& matrix, const Mask& mask) {
    return MatValue::numbers(
        MatNumber::kU8,
        {static_cast<std::uint64_t>(matrix.columns), static_cast<std::uint64_t>(matrix.rows)},
        [mask](const MatSink& sink) { sink(matBytesOf(mask)); });
  }

  static MatValue positions(int count, double pitchMm) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(i * pitchMm);
    return MatValue::column(values);
  }

  template <typename TimeOf>
  static MatValue stampsOf(std::size_t count, TimeOf timeOf) {
    return MatValue::numbers(MatNumber::kI64, {count, 1}, [count, timeOf](const MatSink& sink) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t timeUs = timeOf(i);
        sink({reinterpret_cast<const char*>(&timeUs), sizeof timeUs});
      }
    });
  }

  template <typename Take>
  void forEachFrame(Take take) {
    constexpr std::size_t kFramesPerReport = 256;
    TactileFrame frame;
    for (std::size_t i = 0; i < profile_.numFrames(); ++i) {
      if (progress_ && i % kFramesPerReport == 0) {
        const double within = static_cast<double>(i) / static_cast<double>(profile_.numFrames());
        const auto passes = static_cast<double>(profile_.layout().numMatrices());
        if (!progress_((static_cast<double>(pass_) + within) / passes)) throw Cancelled();
      }
      profile_.readFrame(i, frame);
      take(frame);
    }
  }

  void writeMatrix(std::size_t m, bool counts, const MatSink& sink) {
    const std::size_t cells = profile_.layout().matrix(m).numCells();
    std::vector<std::uint16_t> whole(cells);
    pass_ = m;
    forEachFrame([&](const TactileFrame& frame) {
      if (m == 0) deviceMs_.push_back(frame.deviceUs ? floorMs(*frame.deviceUs) : INT64_MIN);
      const float* all = frame.allValues().data() + profile_.layout().offset(m);
      if (!counts) return sink({reinterpret_cast<const char*>(all), cells * sizeof(float)});
      for (std::size_t k = 0; k < cells; ++k) whole[k] = static_cast<std::uint16_t>(all[k]);
      sink(matBytesOf(whole));
    });
  }

  void writeActive(std::size_t m, const MatSink& sink) {
    const std::size_t cells = profile_.layout().matrix(m).numCells();
    std::vector<std::uint8_t> active(cells);
    forEachFrame([&](const TactileFrame& frame) {
      const std::size_t begin = profile_.layout().offset(m);
      for (std::size_t k = 0; k < cells; ++k) active[k] = isActive(frame, begin + k);
      sink(matBytesOf(active));
    });
  }

  void writeReadings(std::size_t m, const MatSink& sink) {
    forEachFrame([&](const TactileFrame& frame) {
      const float* readings = frame.readings.data() + profile_.layout().readingOffset(m);
      sink({reinterpret_cast<const char*>(readings),
            profile_.layout().matrix(m).numReadings() * sizeof(float)});
    });
  }

  const Profile& profile_;
  const Progress& progress_;
  std::size_t pass_ = 0;
  std::vector<std::int64_t> deviceMs_;  // of the frames, collected with the first matrix
};

MatValue matEventsOf(std::span<const Event> events) {
  const EventColumns<double> columns(events, -1.0);
  return MatValue::structure({{"time_us", MatValue::column(columns.timesUs)},
                              {"end_us", MatValue::column(columns.endsUs)},
                              {"kind", MatValue::texts(columns.kinds)},
                              {"matrix", MatValue::column(columns.matrices)},
                              {"text", MatValue::texts(columns.texts)},
                              {"json", MatValue::texts(columns.jsons)}});
}

MatValue matMetaOf(const Profile& profile, const RecordingMeta& said) {
  std::vector<std::string> keys;
  std::vector<std::string> values;
  for (const auto& [key, value] : writtenMeta(profile.info(), profile.hand(), said)) {
    keys.push_back(key);
    values.push_back(value);
  }
  return MatValue::structure({{"key", MatValue::texts(keys)}, {"value", MatValue::texts(values)}});
}

MatValue matProvenanceOf(const Provenance& from, const Profile& profile) {
  return MatValue::structure(
      {{"program", MatValue::text(from.program)},
       {"source_file", MatValue::text(from.sourceFile)},
       {"source_sha256", MatValue::text(from.sourceSha256)},
       {"filters", MatValue::text(from.filters)},
       {"calibration", MatValue::text(from.calibration)},
       {"hand", MatValue::text(from.hand.empty() ? profile.hand().name : from.hand)}});
}

}  // namespace

void writeMat(const RecordingContent& content,
              const std::filesystem::path& path,
              Overwrite overwrite,
              const Progress& progress) {
  const Profile& profile = content.profile;
  const ExportExtras& extras = content.extras;
  const MatValue further = MatExport::further(profile, path);
  MatFile file(path, overwrite, extras.provenance.program);
  MatExport samples(profile, progress);
  file.add("provenance", matProvenanceOf(extras.provenance, profile));
  file.add("meta", matMetaOf(profile, content.meta));
  file.add("tactile", samples.tactile());
  file.add("joints", MatExport::samples("angles", writtenSamples(profile, kAngleSeries)));
  file.add("temperatures",
           MatExport::samples("values", writtenSamples(profile, kTemperatureSeries)));
  if (profile.series().size() > kHandSeries) file.add("series", further);
  file.add("events", matEventsOf(content.events));
  for (const auto& series : extras.series) file.add(series->name(), MatExport::series(*series));
  file.commit();
}

}  // namespace palpate
