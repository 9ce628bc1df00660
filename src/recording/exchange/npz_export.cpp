// writeNpz() of table_export.h: arrays for NumPy, in a zip file.
#include <bit>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <zlib.h>

#include "palpate/core/byte_order.h"
#include "palpate/core/error.h"
#include "palpate/core/json.h"
#include "palpate/core/output_file.h"
#include "palpate/core/time.h"
#include "palpate/model/active_taxels.h"
#include "palpate/recording/table_export.h"

#include "recording/event_sidecar.h"
#include "recording/sample_columns.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// PKWARE APPNOTE.TXT 6.3: local file header, central directory, zip64 records.
constexpr std::uint16_t kZipWriterVersion = 45;      // 4.5: zip64
constexpr std::uint16_t kChecksumFollows = 1u << 3;  // general purpose flag
constexpr std::uint32_t kMax32 = 0xFFFFFFFF;
// 1980-01-01: files do not depend on when they were made
constexpr std::uint16_t kDosDate = 0x0021;

// Extra field 1: sizes and offset as 64-bit numbers.
std::string zip64(std::uint64_t size, bool withOffset, std::uint64_t offset) {
  std::string extra;
  appendLittleEndian(extra, 1, 2);
  appendLittleEndian(extra, withOffset ? 24 : 16, 2);
  appendLittleEndian(extra, size, 8);
  appendLittleEndian(extra, size, 8);
  if (withOffset) appendLittleEndian(extra, offset, 8);
  return extra;
}

// A zip file without compression, of named pieces, with 64-bit sizes where they are needed.
class ZipWriter {
 public:
  explicit ZipWriter(OutputFile& out) : out_(out) {}
  // Pieces one after the other: begin(), write() exactly `size` bytes in total, end(). The checksum
  // follows the bytes, so they need not be known beforehand.
  void begin(std::string_view name, std::uint64_t size);
  void write(std::string_view bytes);
  void end();
  void finish();  // the directory

 private:
  struct Entry {
    std::string name;
    std::uint64_t size = 0;
    std::uint64_t offset = 0;
    std::uint32_t crc = 0;
  };
  void put(const std::string& bytes);

  OutputFile& out_;
  std::vector<Entry> entries_;
  std::uint64_t position_ = 0;
};

void ZipWriter::put(const std::string& bytes) {
  out_.write(bytes);
  position_ += bytes.size();
}

void ZipWriter::begin(std::string_view name, std::uint64_t size) {
  entries_.push_back({std::string(name), size, position_});
  const std::string extra = zip64(size, false, 0);
  std::string head;
  appendLittleEndian(head, 0x04034B50, 4);
  appendLittleEndian(head, kZipWriterVersion, 2);
  appendLittleEndian(head, kChecksumFollows, 2);
  appendLittleEndian(head, 0, 2);  // stored
  appendLittleEndian(head, 0, 2);  // time
  appendLittleEndian(head, kDosDate, 2);
  appendLittleEndian(head, 0, 4);       // checksum
  appendLittleEndian(head, kMax32, 4);  // sizes stand in the extra field
  appendLittleEndian(head, kMax32, 4);
  appendLittleEndian(head, name.size(), 2);
  appendLittleEndian(head, extra.size(), 2);
  put(head + std::string(name) + extra);
}

void ZipWriter::write(std::string_view bytes) {
  if (bytes.empty()) return;  // zlib would start its checksum over
  Entry& entry = entries_.back();
  entry.crc = static_cast<std::uint32_t>(
      crc32_z(entry.crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  out_.write(bytes);
  position_ += bytes.size();
}

void ZipWriter::end() {
  const Entry& entry = entries_.back();
  std::string descriptor;
  appendLittleEndian(descriptor, 0x08074B50, 4);
  appendLittleEndian(descriptor, entry.crc, 4);
  appendLittleEndian(descriptor, entry.size, 8);
  appendLittleEndian(descriptor, entry.size, 8);
  put(descriptor);
}

void ZipWriter::finish() {
  const std::uint64_t start = position_;
  for (const Entry& entry : entries_) {
    const std::string extra = zip64(entry.size, true, entry.offset);
    std::string row;
    appendLittleEndian(row, 0x02014B50, 4);
    appendLittleEndian(row, kZipWriterVersion, 2);
    appendLittleEndian(row, kZipWriterVersion, 2);
    appendLittleEndian(row, kChecksumFollows, 2);
    appendLittleEndian(row, 0, 2);  // stored
    appendLittleEndian(row, 0, 2);  // time
    appendLittleEndian(row, kDosDate, 2);
    appendLittleEndian(row, entry.crc, 4);
    appendLittleEndian(row, kMax32, 4);
    appendLittleEndian(row, kMax32, 4);
    appendLittleEndian(row, entry.name.size(), 2);
    appendLittleEndian(row, extra.size(), 2);
    appendLittleEndian(row, 0, 2);  // comment
    appendLittleEndian(row, 0, 2);  // disk
    appendLittleEndian(row, 0, 2);  // attributes
    appendLittleEndian(row, 0, 4);
    appendLittleEndian(row, kMax32, 4);  // offset
    put(row + entry.name + extra);
  }
  const std::uint64_t size = position_ - start;
  std::string end;
  appendLittleEndian(end, 0x06064B50, 4);  // zip64 end of central directory
  appendLittleEndian(end, 44, 8);
  appendLittleEndian(end, kZipWriterVersion, 2);
  appendLittleEndian(end, kZipWriterVersion, 2);
  appendLittleEndian(end, 0, 4);
  appendLittleEndian(end, 0, 4);
  appendLittleEndian(end, entries_.size(), 8);
  appendLittleEndian(end, entries_.size(), 8);
  appendLittleEndian(end, size, 8);
  appendLittleEndian(end, start, 8);
  appendLittleEndian(end, 0x07064B50, 4);  // its locator
  appendLittleEndian(end, 0, 4);
  appendLittleEndian(end, position_, 8);
  appendLittleEndian(end, 1, 4);
  appendLittleEndian(end, 0x06054B50, 4);  // end of central directory
  appendLittleEndian(end, 0, 2);
  appendLittleEndian(end, 0, 2);
  appendLittleEndian(end, 0xFFFF, 2);
  appendLittleEndian(end, 0xFFFF, 2);
  appendLittleEndian(end, kMax32, 4);
  appendLittleEndian(end, kMax32, 4);
  appendLittleEndian(end, 0, 2);
  put(end);
}

constexpr std::size_t kNpzExportPieceBytes = 1u << 16;

// The head of a .npy file, format 1.0 (numpy.lib.format): magic, version, length, a Python literal.
std::string npyHead(const std::string& type, const std::vector<std::size_t>& shape) {
  constexpr std::size_t kAlignment = 64;
  std::string dimensions;
  for (std::size_t size : shape) dimensions += std::to_string(size) + ", ";
  std::string literal =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + dimensions + "), }";
  const std::size_t before = 10;  // magic, version, length
  while ((before + literal.size() + 1) % kAlignment != 0) literal += ' ';
  literal += '\n';
  std::string head = "\x93NUMPY";
  head += '\x01';
  head += '\0';
  appendLittleEndian(head, literal.size(), 2);
  return head + literal;
}

// One array, filled number by number in little-endian form.
class NpyArray {
 public:
  NpyArray(ZipWriter& zip,
           const std::string& name,
           const std::string& type,
           std::size_t bytesPerNumber,
           const std::vector<std::size_t>& shape)
      : zip_(zip) {
    std::uint64_t numbers = 1;
    for (std::size_t size : shape) numbers *= size;
    const std::string head = npyHead(type, shape);
    zip_.begin(name + ".npy", head.size() + numbers * bytesPerNumber);
    zip_.write(head);
  }
  void u8(std::uint64_t value) { put(value, 1); }
  void u16(std::uint64_t value) { put(value, 2); }
  void i64(std::int64_t value) { put(static_cast<std::uint64_t>(value), 8); }
  void f32(float value) { put(std::bit_cast<std::uint32_t>(value), 4); }
  void f64(double value) { put(std::bit_cast<std::uint64_t>(value), 8); }
  void end() {
    flush();
    zip_.end();
  }

 private:
  void put(std::uint64_t value, int bytes) {
    appendLittleEndian(buffer_, value, bytes);
    if (buffer_.size() >= kNpzExportPieceBytes) flush();
  }
  void flush() {
    zip_.write(buffer_);
    buffer_.clear();
  }

  ZipWriter& zip_;
  std::string buffer_;
};

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

// A text as a NumPy array of no dimension: UTF-32 code points, so that no pickle is needed.
void writeText(ZipWriter& zip, const std::string& name, const std::string& ascii) {
  NpyArray array(zip, name, "<U" + std::to_string(ascii.size()), 4 * ascii.size(), {});
  for (unsigned char c : ascii) {
    array.u8(c);
    for (int i = 0; i < 3; ++i) array.u8(0);
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

  writeText(zip, "meta", metaText(profile, events));
  zip.finish();
  out.commit();
}

}  // namespace palpate
