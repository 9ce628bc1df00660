// writeNpz() of table_export.h: arrays for NumPy, in a zip file.
#include <set>
#include <span>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/output_file.h"
#include "palpate/core/time.h"
#include "palpate/model/active_taxels.h"
#include "palpate/recording/table_export.h"

#include "recording/event_sidecar.h"
#include "recording/exchange/npz_file.h"
#include "recording/sample_columns.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// NAME_ms, whole milliseconds, and NAME_us.
template <typename TimeOf>
void writeTimes(ZipWriter& zip, const std::string& name, std::size_t count, TimeOf timeOf) {
  NpyArray ms(zip, name + "_ms", "<i8", 8, {count});
  for (std::size_t i = 0; i < count; ++i) ms.i64(floorMs(timeOf(i)));
  ms.end();
  NpyArray us(zip, name + "_us", "<i8", 8, {count});
  for (std::size_t i = 0; i < count; ++i) us.i64(timeOf(i));
  us.end();
}

// Arrays NAMEs and NAME_time of joint angles or temperatures.
void npzExportWriteSamples(ZipWriter& zip, const std::string& name, const WrittenSamples& samples) {
  const std::size_t width = samples.count > 0 ? samples.columns.size() : 0;
  NpyArray array(zip, name + "s", "<f8", 8, {samples.count, width});
  for (std::size_t i = 0; i < samples.count; ++i)
    for (double value : samples.values(i)) array.f64(value);
  array.end();
  writeTimes(zip, name + "_time", samples.count, samples.timeUs);
}

// NAME, NAME_time_us and NAME_device_time_us of a further series.
void writeSeries(ZipWriter& zip, const std::string& name, const WrittenSamples& samples) {
  NpyArray array(zip, name, "<f8", 8, {samples.count, samples.columns.size()});
  for (std::size_t i = 0; i < samples.count; ++i)
    for (double value : samples.values(i)) array.f64(value);
  array.end();
  const auto writeStamps = [&](const char* ending, const auto& timeOf) {
    NpyArray stamps(zip, name + ending, "<i8", 8, {samples.count});
    for (std::size_t i = 0; i < samples.count; ++i) stamps.i64(timeOf(i));
    stamps.end();
  };
  writeStamps("_time_us", samples.timeUs);
  if (samples.deviceUs) writeStamps("_device_time_us", samples.deviceUs);
}

// Throws FileError where an array of a further series would have the name of another array.
void requireOwnNames(const Profile& profile, const fs::path& path) {
  std::set<std::string> taken{"angles",
                              "angle_time_ms",
                              "angle_time_us",
                              "temperatures",
                              "temperature_time_ms",
                              "temperature_time_us",
                              "time_ms",
                              "time_us",
                              "static_mask",
                              "meta"};
  for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m)
    taken.insert({"m" + std::to_string(m),
                  "m" + std::to_string(m) + "_active",
                  "m" + std::to_string(m) + "_readings"});
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    for (const char* ending : {"", "_time_us", "_device_time_us"})
      if (const std::string& name = profile.series()[i].name; !taken.insert(name + ending).second)
        throw FileError(path,
                        "can't hold the series '" + name + "': another array has the name '" +
                            name + ending + "'; write .h5 or .palpate");
}

std::vector<std::size_t> shapeOf(const Profile& profile, std::size_t m) {
  const MatrixLayout& layout = profile.layout().matrix(m);
  return {profile.numFrames(),
          static_cast<std::size_t>(layout.rows),
          static_cast<std::size_t>(layout.columns)};
}

// True: a frame was filtered, so that its values don't say by themselves which taxels are active.
bool writeMatrix(ZipWriter& zip, const Profile& profile, std::size_t m, const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 1024;
  const bool counts = profile.hasCounts();
  NpyArray array(
      zip, "m" + std::to_string(m), counts ? "<u2" : "<f4", counts ? 2 : 4, shapeOf(profile, m));
  TactileFrame frame;
  bool filtered = false;
  const double numMatrices = static_cast<double>(profile.layout().numMatrices());
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const double within = static_cast<double>(i) / static_cast<double>(profile.numFrames());
    if (progress && i % kFramesPerReport == 0 &&
        !progress((static_cast<double>(m) + within) / numMatrices))
      throw Cancelled();
    profile.readFrame(i, frame);
    filtered = filtered || !frame.filtered.empty();
    const auto values = frame.allValues(m);
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      if (counts)
        array.u16(static_cast<std::uint64_t>(values.data()[k]));
      else
        array.f32(values.data()[k]);
    }
  }
  array.end();
  return filtered;
}

void writeActive(ZipWriter& zip, const Profile& profile, std::size_t m) {
  NpyArray array(zip, "m" + std::to_string(m) + "_active", "|b1", 1, shapeOf(profile, m));
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    const std::size_t begin = profile.layout().offset(m);
    for (std::size_t k = 0; k < profile.layout().matrix(m).numCells(); ++k)
      array.u8(isActive(frame, begin + k) ? 1 : 0);
  }
  array.end();
}

// What the sensor sent: the shape of the matrix, and its components.
void writeReadings(ZipWriter& zip, const Profile& profile, std::size_t m) {
  const MatrixLayout& layout = profile.layout().matrix(m);
  std::vector<std::size_t> shape = shapeOf(profile, m);
  shape.push_back(static_cast<std::size_t>(layout.touch.components));
  NpyArray array(zip, "m" + std::to_string(m) + "_readings", "<f4", 4, shape);
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    const std::size_t begin = profile.layout().readingOffset(m);
    for (std::size_t k = 0; k < layout.numReadings(); ++k) array.f32(frame.readings[begin + k]);
  }
  array.end();
}

std::string metaText(const Profile& profile, std::span<const Event> events) {
  Json pitches = Json::array();
  for (const MatrixLayout& matrix : profile.layout().matrices())
    pitches.push(pitchJson(matrix.pitchMm));
  Json meta = Json::object();
  meta.set("format", "palpate npz 1")
      .set("hand", profile.hand().name)
      .set("serial", profile.info().serial)
      .set("firmware", profile.info().firmware)
      .set("value_type", profile.hasCounts() ? "counts" : "float")
      .set("pitch_mm", std::move(pitches))
      .set("events", eventsToJson(events));
  if (profile.givesReadings())
    meta.set(kTouchRulesKey, Json::parse(touchRulesText(profile.layout())));
  if (profile.series().size() > kHandSeries)
    meta.set(
        "series",
        jsonList(
            std::span(profile.series()).subspan(kHandSeries), [](const SeriesDescription& series) {
              return Json::object()
                  .set("name", series.name)
                  .set("role", series.role)
                  .set("source", series.source)
                  .set("columns", jsonList(series.columns, [](const Column& column) {
                         return Json::object().set("name", column.name).set("unit", column.unit);
                       }));
            }));
  return meta.asciiText();
}

}  // namespace

void writeNpz(const Profile& profile,
              std::span<const Event> events,
              const fs::path& path,
              Overwrite overwrite,
              const Progress& progress) {
  requireOwnNames(profile, path);
  OutputFile out(path, overwrite);
  ZipWriter zip(out);
  writeTimes(
      zip, "time", profile.numFrames(), [&](std::size_t i) { return profile.frameTimeUs(i); });
  bool filtered = false;
  for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m)
    filtered = writeMatrix(zip, profile, m, progress) || filtered;
  for (std::size_t m = 0; filtered && m < profile.layout().numMatrices(); ++m)
    writeActive(zip, profile, m);
  for (std::size_t m = 0; profile.givesReadings() && m < profile.layout().numMatrices(); ++m)
    writeReadings(zip, profile, m);
  npzExportWriteSamples(zip, "angle", writtenSamples(profile, kAngleSeries));
  npzExportWriteSamples(zip, "temperature", writtenSamples(profile, kTemperatureSeries));
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    writeSeries(zip, profile.series()[i].name, writtenSamples(profile, i));
  NpyArray mask(zip, "static_mask", "|u1", 1, {profile.layout().numCells()});
  for (const MatrixLayout& matrix : profile.layout().matrices())
    for (auto on : matrix.staticMask) mask.u8(on);
  mask.end();

  writeNpyText(zip, "meta", metaText(profile, events));
  zip.finish();
  out.commit();
}

}  // namespace palpate
