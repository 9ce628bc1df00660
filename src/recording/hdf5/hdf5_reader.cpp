#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/hash.h"
#include "palpate/core/time.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/hdf5_process.h"
#include "palpate/recording/hdf5_recording.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/block_cache.h"
#include "recording/hdf5/hdf5_layout.h"
#include "recording/profile_meta.h"
#include "recording/sample_columns.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// Bounds of what is read, so that a hostile file costs little time and memory.
constexpr std::uint64_t kMaxFrames = std::uint64_t{1} << 31;
constexpr std::uint64_t kMaxSamples = std::uint64_t{1} << 31;
constexpr std::uint64_t kMaxEvents = 1'000'000;
constexpr std::uint64_t kMaxMetaRows = 1'000;
constexpr std::size_t kMaxAttributeBytes = 60'000;
constexpr std::size_t kMaxSeriesNameBytes = kMaxSeries * (kMaxSeriesName + 1);
constexpr std::size_t kMaxMetaBytes = 2 * kHandFileByteLimit;
constexpr std::size_t kMaxHdf5TextBytes = 64u << 20;  // of all texts of a file together
constexpr std::size_t kMaxReadFrames = 4096;          // in one block
constexpr std::size_t kMaxReadRows = 8192;
constexpr std::size_t kCachedFrameBlocks = 4;

// One data set of the file, with the message of each fault.
class ReadArray {
 public:
  ReadArray(Hdf5Process& file, std::string name) : file_(&file), name_(std::move(name)) {
    facts_ = file.facts(name_);
    if (facts_.shape.size() > 4) fail("has a different number of axes than in Palpate's layout");
    if (!facts_.fault.empty()) fail(facts_.fault);
  }

  const std::string& name() const { return name_; }
  Hdf5Process& file() const { return *file_; }
  const std::vector<std::uint64_t>& shape() const { return facts_.shape; }
  Hdf5Kind kind() const { return facts_.kind; }
  // Length of a chunk along the first axis; 0: not chunked.
  std::uint64_t chunkLength() const { return facts_.chunkLength; }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FormatError(file_->path(), inQuotes(name_) + " " + fault);
  }
  void requireShape(const std::vector<std::uint64_t>& shape) const {
    if (facts_.shape == shape) return;
    fail("has " + text(facts_.shape) + " values instead of " + text(shape));
  }
  void requireKind(std::initializer_list<Hdf5Kind> kinds) const {
    if (std::find(kinds.begin(), kinds.end(), facts_.kind) == kinds.end())
      fail("has a different type than in Palpate's layout");
  }

  // Reads rows of the first axis, `count` of them, as numbers of a type.
  template <typename Number>
  void read(std::uint64_t first,
            std::uint64_t count,
            Hdf5Number type,
            std::span<Number> out) const {
    if (!out.empty()) file_->read(name_, first, count, type, std::as_writable_bytes(out));
  }

  // Texts of an array of one axis. `left`: the bytes that texts of the file may still take.
  std::vector<std::string> texts(std::uint64_t mostCount,
                                 std::size_t mostBytes,
                                 std::size_t& left) const {
    requireKind({Hdf5Kind::kText});
    if (shape().size() != 1 || shape()[0] > mostCount) fail("has too many texts");
    std::vector<std::string> result;
    while (result.size() < shape()[0]) {
      auto piece = file_->texts(name_, result.size(), shape()[0] - result.size(), mostBytes);
      for (std::string& text : piece) {
        const std::size_t bytes = text.size() + sizeof text;
        if (bytes > left)
          fail("has too many texts: those of the file are more than " +
               std::to_string(kMaxHdf5TextBytes >> 20) + " MB");
        left -= bytes;
        result.push_back(std::move(text));
      }
    }
    return result;
  }

  // Of one axis, from `first` on.
  std::vector<std::int64_t> integers(std::uint64_t first, std::uint64_t count) const {
    std::vector<std::int64_t> values(static_cast<std::size_t>(count));
    read<std::int64_t>(first, count, Hdf5Number::kI64, values);
    return values;
  }
  void requireIntegers(std::uint64_t mostCount) const {
    requireKind({Hdf5Kind::kInteger});
    if (shape().size() != 1 || shape()[0] > mostCount) fail("has too many values, or several axes");
  }

 private:
  static std::string text(const std::vector<std::uint64_t>& shape) {
    std::string result;
    for (const std::uint64_t length : shape)
      result += (result.empty() ? "" : " x ") + std::to_string(length);
    return result.empty() ? "no" : result;
  }

  Hdf5Process* file_;
  std::string name_;
  Hdf5Facts facts_;
};

// The stamps of a series, which ascend. A part of them lies in memory; those of 400,000 samples
// (more than an hour) do so all the time. Safe from several threads.
class StampSeries {
 public:
  StampSeries() = default;
  // Reads all of them once.
  explicit StampSeries(ReadArray array, std::uint64_t mostCount) : array_(std::move(array)) {
    array_->requireIntegers(mostCount);
    size_ = static_cast<std::size_t>(array_->shape()[0]);
    constexpr std::int64_t kLatestUs = std::int64_t{1} << 60;  // as in a native recording
    std::int64_t before = std::numeric_limits<std::int64_t>::min();
    for (std::size_t first = 0; first < size_; first += kPiece) {
      const std::vector<std::int64_t>& piece = pieceWith(first);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        if (piece[i] < -kLatestUs || piece[i] > kLatestUs || piece[i] <= before)
          array_->fail("does not ascend at sample " + std::to_string(first + i));
        before = piece[i];
      }
      firstsUs_.push_back(piece.front());
    }
  }

  std::size_t size() const { return size_; }
  std::int64_t at(std::size_t index) const {
    const std::lock_guard lock(mutex_);
    return pieceWith(index)[index % kPiece];
  }
  // As ProfileStorage::frameAt(): reads one piece at most.
  std::optional<std::size_t> indexAt(std::int64_t timeUs) const {
    if (size_ == 0) return std::nullopt;
    const auto behind = std::upper_bound(firstsUs_.begin(), firstsUs_.end(), timeUs);
    if (behind == firstsUs_.begin()) return 0;
    const auto first = static_cast<std::size_t>(behind - firstsUs_.begin() - 1) * kPiece;
    const std::lock_guard lock(mutex_);
    const std::vector<std::int64_t>& piece = pieceWith(first);
    return first + static_cast<std::size_t>(std::upper_bound(piece.begin(), piece.end(), timeUs) -
                                            piece.begin() - 1);
  }

 private:
  static constexpr std::size_t kPiece = 1u << 16;
  static constexpr std::size_t kPieces = 6;  // in memory

  // The lock is held.
  const std::vector<std::int64_t>& pieceWith(std::size_t index) const {
    const std::size_t first = index - index % kPiece;
    if (const auto* kept = pieces_.find(first)) return *kept;
    return pieces_.add(first, 1, array_->integers(first, std::min(kPiece, size_ - first)));
  }

  std::optional<ReadArray> array_;
  std::size_t size_ = 0;
  std::vector<std::int64_t> firstsUs_;  // of the pieces
  mutable std::mutex mutex_;
  mutable BlockCache<std::vector<std::int64_t>> pieces_{kPieces};  // by first index
};

// The samples of a series: stamps, and values in blocks of rows. Safe from several threads.
class SampleSeries {
 public:
  // `name`: as in SeriesDescription.
  SampleSeries(Hdf5Process& file, std::size_t series, const std::string& name)
      : series_(series), timesUs_(timesOf(file, hdf5_layout::seriesGroup(series, name))) {
    const std::string group = hdf5_layout::seriesGroup(series, name);
    if (timesUs_.size() == 0 && !file.has(group + "/time_us")) return;  // none was recorded
    values_.emplace(file, group + "/" + hdf5_layout::seriesValues(series));
    values_->requireKind({Hdf5Kind::kFloat, Hdf5Kind::kInteger});
    if (values_->shape().size() != 2 || values_->shape()[1] < 1 ||
        values_->shape()[1] > kMaxSampleValues)
      values_->fail("must have 1 to " + std::to_string(kMaxSampleValues) + " columns");
    values_->requireShape({timesUs_.size(), values_->shape()[1]});
    width_ = static_cast<std::size_t>(values_->shape()[1]);
    rowsPerBlock_ =
        std::clamp<std::size_t>(static_cast<std::size_t>(values_->chunkLength()), 1, kMaxReadRows);
    if (series < kHandSeries || !file.has(group + "/device_time_us")) return;
    deviceTimes_.emplace(file, group + "/device_time_us");
    deviceTimes_->requireIntegers(kMaxSamples);
    deviceTimes_->requireShape({timesUs_.size()});
  }

  // Throws FormatError where the samples don't have so many values.
  void requireWidth(std::size_t columns) const {
    if (timesUs_.size() > 0 && width_ != columns)
      values_->fail("has a different number of columns than \"column\"");
  }
  std::size_t width() const { return timesUs_.size() == 0 ? 0 : width_; }
  const StampSeries& timesUs() const { return timesUs_; }

  Sample sample(std::size_t index) const {
    Sample sample{timesUs_.at(index), {}, series_};
    const std::lock_guard lock(mutex_);
    const std::size_t first = index / rowsPerBlock_ * rowsPerBlock_;
    if (block_.empty() || first != firstInBlock_) {
      const std::size_t count = std::min(rowsPerBlock_, timesUs_.size() - first);
      block_.assign(count * width_, 0.0);
      try {
        values_->read<double>(first, count, Hdf5Number::kF64, block_);
        if (deviceTimes_) deviceUs_ = deviceTimes_->integers(first, count);
      } catch (...) {
        block_.clear();
        throw;
      }
      firstInBlock_ = first;
    }
    const auto begin = block_.begin() + static_cast<std::ptrdiff_t>((index - first) * width_);
    sample.values.assign(begin, begin + static_cast<std::ptrdiff_t>(width_));
    if (!areSampleValues(series_, sample.values))
      values_->fail("has a value that is not a number in row " + std::to_string(index));
    if (deviceTimes_ && deviceUs_[index - first] != hdf5_layout::kNoDeviceTime)
      sample.deviceUs = deviceUs_[index - first];
    return sample;
  }

 private:
  static StampSeries timesOf(Hdf5Process& file, const std::string& group) {
    if (!file.has(group)) throw FormatError(file.path(), "the group '" + group + "' is missing");
    if (!file.has(group + "/time_us")) return {};
    return StampSeries(ReadArray(file, group + "/time_us"), kMaxSamples);
  }

  std::size_t series_;
  StampSeries timesUs_;
  std::optional<ReadArray> values_;
  std::optional<ReadArray> deviceTimes_;
  std::size_t width_ = 0;
  std::size_t rowsPerBlock_ = 1;
  mutable std::mutex mutex_;
  mutable std::vector<double> block_;           // the rows that were read last
  mutable std::vector<std::int64_t> deviceUs_;  // of the same rows
  mutable std::size_t firstInBlock_ = 0;
};

std::vector<Event> hdf5EventsOf(Hdf5Process& file, std::size_t& textBytesLeft) {
  if (!file.has("events")) throw FormatError(file.path(), "the group 'events' is missing");
  const ReadArray stamps(file, "events/time_us");
  stamps.requireIntegers(kMaxEvents);
  const std::uint64_t count = stamps.shape()[0];
  const auto integers = [&](const char* name) {
    const ReadArray array(file, name);
    array.requireIntegers(kMaxEvents);
    array.requireShape({count});
    return array.integers(0, count);
  };
  const auto texts = [&](const char* name) {
    const ReadArray array(file, name);
    array.requireShape({count});
    return array.texts(kMaxEvents, 2 * kMaxEventBytes, textBytesLeft);
  };
  const auto times = stamps.integers(0, count);
  const auto ends = integers("events/end_us");
  const auto matrices = integers("events/matrix");
  auto kinds = texts("events/kind");
  auto words = texts("events/text");
  auto jsons = texts("events/json");
  std::vector<Event> events;
  events.reserve(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    Event& event = events.emplace_back();
    event.tUs = times[i];
    event.t1Us = ends[i];
    if (matrices[i] < INT32_MIN || matrices[i] > INT32_MAX)
      throw FormatError(file.path(),
                        "\"events/matrix\" is out of range in row " + std::to_string(i));
    if (matrices[i] != hdf5_layout::kNoMatrix) event.matrix = static_cast<int>(matrices[i]);
    event.kind = std::move(kinds[i]);
    event.text = std::move(words[i]);
    event.json = std::move(jsons[i]);
    if (event.kind.size() + event.text.size() + event.json.size() > kMaxEventBytes)
      throw FormatError(file.path(), "event " + std::to_string(i) + " is too long");
  }
  return events;
}

RecordingMeta hdf5MetaOf(Hdf5Process& file, std::size_t& textBytesLeft) {
  if (!file.has("meta")) throw FormatError(file.path(), "the group 'meta' is missing");
  const auto keys =
      ReadArray(file, "meta/key").texts(kMaxMetaRows, kMaxAttributeBytes, textBytesLeft);
  const ReadArray valueArray(file, "meta/value");
  valueArray.requireShape({keys.size()});
  auto values = valueArray.texts(kMaxMetaRows, kMaxMetaBytes, textBytesLeft);
  RecordingMeta meta;
  for (std::size_t i = 0; i < keys.size(); ++i) meta[keys[i]] = std::move(values[i]);
  return meta;
}

Provenance hdf5ProvenanceOf(Hdf5Process& file) {
  const auto text = [&](const char* name) {
    return file.textAttribute("", name, kMaxAttributeBytes).value_or("");
  };
  Provenance from;
  from.program = text("program");
  from.sourceFile = text("source_file");
  from.sourceSha256 = text("source_sha256");
  from.filters = text("filters");
  from.calibration = text("calibration");
  from.hand = text("hand");
  return from;
}

class Hdf5Storage final : public ProfileStorage {
 public:
  explicit Hdf5Storage(std::unique_ptr<Hdf5Process> file)
      : file_(std::move(file)),
        from_(hdf5ProvenanceOf(*file_)),
        meta_(hdf5MetaOf(*file_, textBytesLeft_)),
        events_(hdf5EventsOf(*file_, textBytesLeft_)),
        further_(furtherSeries()),
        layout_(readLayout()),
        timesUs_(ReadArray(*file_, "tactile/time_us"), kMaxFrames) {
    samples_.emplace_back(*file_, kAngleSeries, "");
    samples_.emplace_back(*file_, kTemperatureSeries, "");
    for (const SeriesDescription& series : further_) {
      samples_.emplace_back(*file_, samples_.size(), series.name);
      samples_.back().requireWidth(series.columns.size());
    }
    if (file_->has("tactile/device_time_ms"))
      deviceTimes_.emplace(
          ofFrames("tactile/device_time_ms", {timesUs_.size()}, {Hdf5Kind::kInteger}));
    bool anyCounts = false;
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      if (givesReadings()) {
        std::vector<std::uint64_t> shape = shapeOf(m);
        shape.push_back(static_cast<std::uint64_t>(layout_.matrix(m).touch.components));
        matrices_.push_back(ofFrames(hdf5_layout::readingsPath(m), shape, {Hdf5Kind::kFloat}));
        continue;
      }
      matrices_.push_back(
          ofFrames(hdf5_layout::matrixPath(m), shapeOf(m), {Hdf5Kind::kInteger, Hdf5Kind::kFloat}));
      const bool counts = matrices_.back().kind() == Hdf5Kind::kInteger;
      if (m > 0 && counts != anyCounts)
        matrices_.back().fail("has a different type than the first");
      anyCounts = counts;
    }
    counts_ = anyCounts;
    if (file_->has("tactile/filtered") && !givesReadings()) {
      filtered_.emplace(ofFrames("tactile/filtered", {timesUs_.size()}, {Hdf5Kind::kInteger}));
      for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
        const std::string path = hdf5_layout::matrixPath(m);
        // Older files have them under the other name.
        kept_.push_back(ofFrames(path + (file_->has(path + "_kept") ? "_kept" : "_active"),
                                 shapeOf(m),
                                 {Hdf5Kind::kInteger}));
      }
    }
    // A block is a chunk, but not more than fits into memory.
    const std::size_t fitting = (16u << 20) / (layout_.numReadings() * sizeof(float)) + 1;
    framesPerBlock_ = std::clamp<std::size_t>(
        std::min<std::size_t>(static_cast<std::size_t>(matrices_[0].chunkLength()), fitting),
        1,
        kMaxReadFrames);
  }

  const SensorLayout& layout() const { return layout_; }
  bool counts() const { return counts_; }
  std::size_t width(std::size_t series) const { return samples_[series].width(); }
  const std::vector<SeriesDescription>& further() const { return further_; }
  const Provenance& provenance() const { return from_; }
  const RecordingMeta& meta() const { return meta_; }
  const std::vector<Event>& events() const { return events_; }

  bool givesReadings() const override { return layout_.decidesTouch(); }
  std::size_t numFrames() const override { return timesUs_.size(); }
  std::int64_t frameTimeUs(std::size_t frame) const override { return timesUs_.at(frame); }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    const std::shared_ptr<const FrameBlock> block = blockWith(frame);
    const std::size_t at = frame - block->first;
    out.deviceUs.reset();
    if (!block->deviceTimes.empty() && block->deviceTimes[at] != hdf5_layout::kNoDeviceTime)
      out.deviceUs = checkedUs(block->deviceTimes[at]);
    out.filtered.clear();
    std::vector<float>& stored = givesReadings() ? out.readings : out.values;
    stored.resize(layout_.numReadings());
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      const std::size_t count = layout_.matrix(m).numReadings();
      const auto from = block->values[m].begin() + static_cast<std::ptrdiff_t>(at * count);
      std::copy(from,
                from + static_cast<std::ptrdiff_t>(count),
                stored.begin() + static_cast<std::ptrdiff_t>(layout_.readingOffset(m)));
    }
    if (block->filtered.empty() || block->filtered[at] == 0) return;
    out.filtered = out.values;
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      const std::size_t cells = layout_.matrix(m).numCells();
      for (std::size_t k = 0; k < cells; ++k)
        if (block->kept[m][at * cells + k] == 0) out.values[layout_.offset(m) + k] = 0.0F;
    }
  }
  std::size_t numSamples(std::size_t series) const override {
    return samples_[series].timesUs().size();
  }
  std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const override {
    return samples_[series].timesUs().at(sample);
  }
  Sample sample(std::size_t series, std::size_t sample) const override {
    return samples_[series].sample(sample);
  }
  std::optional<std::size_t> frameAt(std::int64_t timeUs) const override {
    return timesUs_.indexAt(timeUs);
  }
  std::optional<std::size_t> sampleAt(std::size_t series, std::int64_t timeUs) const override {
    return samples_[series].timesUs().indexAt(timeUs);
  }

 private:
  // Consecutive frames as they are in the file.
  struct FrameBlock {
    std::size_t first = 0;
    std::vector<std::vector<float>> values;
    std::vector<std::int64_t> deviceTimes;
    std::vector<std::uint8_t> filtered;
    std::vector<std::vector<std::uint8_t>> kept;
  };

  // What the series beside the hand's are.
  std::vector<SeriesDescription> furtherSeries() {
    std::vector<SeriesDescription> all;
    if (!file_->has("series")) return all;
    const auto names =
        file_->textAttribute("series", hdf5_layout::kSeriesNames, kMaxSeriesNameBytes);
    if (!names) throw FormatError(file_->path(), "the group 'series' has no attribute names");
    std::istringstream list(*names);
    for (std::string name; std::getline(list, name, ',');) {
      SeriesDescription series{name, {}, {}, {}};
      const std::string group = hdf5_layout::seriesGroup(kHandSeries, series.name);
      if (all.size() == kMaxSeries - kHandSeries || !file_->has(group))
        throw FormatError(file_->path(),
                          "the group " + inQuotes(group) + " is missing, or one too many");
      const auto texts = [&](const char* array) {
        return ReadArray(*file_, group + array)
            .texts(kMaxColumns, kMaxAttributeBytes, textBytesLeft_);
      };
      const auto columns = texts("/column");
      const auto units = texts("/unit");
      for (std::size_t i = 0; i < columns.size(); ++i)
        series.columns.push_back({columns[i], i < units.size() ? units[i] : ""});
      const auto said = [&](const char* attribute) {
        return file_->textAttribute(group, attribute, kMaxAttributeBytes).value_or("");
      };
      series.role = said("role");
      series.source = said("source");
      all.push_back(std::move(series));
    }
    return all;
  }
  std::vector<std::uint64_t> shapeOf(std::size_t m) const {
    return {timesUs_.size(),
            static_cast<std::uint64_t>(layout_.matrix(m).rows),
            static_cast<std::uint64_t>(layout_.matrix(m).columns)};
  }
  ReadArray ofFrames(const std::string& name,
                     const std::vector<std::uint64_t>& shape,
                     std::initializer_list<Hdf5Kind> kinds) const {
    ReadArray array(*file_, name);
    array.requireKind(kinds);
    array.requireShape(shape);
    return array;
  }

  Mask readMask(const std::string& name, const std::vector<std::uint64_t>& shape) const {
    const ReadArray array(*file_, name);
    array.requireKind({Hdf5Kind::kInteger});
    array.requireShape(shape);
    Mask mask(static_cast<std::size_t>(shape[0] * shape[1]));
    array.read<std::uint8_t>(0, shape[0], Hdf5Number::kU8, mask);
    for (auto& on : mask) on = on != 0;
    return mask;
  }

  SensorLayout readLayout() const {
    if (!file_->has("tactile")) throw FormatError(file_->path(), "the group 'tactile' is missing");
    std::vector<MatrixLayout> matrices;
    std::uint64_t cells = 0;
    for (std::size_t m = 0; file_->has(hdf5_layout::matrixPath(m)); ++m) {
      const std::string name = hdf5_layout::matrixPath(m);
      const ReadArray array(*file_, name);
      if (m == kMaxMatrices) array.fail("is one matrix too many");
      const auto& shape = array.shape();
      if (shape.size() != 3 || shape[1] < 1 || shape[1] > 256 || shape[2] < 1 || shape[2] > 256)
        array.fail("must be frames x rows x columns, at most 256 x 256 taxels");
      cells += shape[1] * shape[2];
      if (cells > kMaxPlaces) array.fail("is too large: too many taxels in all");
      MatrixLayout& matrix = matrices.emplace_back();
      matrix.rows = static_cast<int>(shape[1]);
      matrix.columns = static_cast<int>(shape[2]);
      const auto pitch = file_->numberAttribute(name, "pitch_mm");
      if (!pitch) array.fail("has no attribute pitch_mm");
      matrix.pitchMm = {*pitch, file_->numberAttribute(name, "pitch_y_mm").value_or(*pitch)};
      matrix.uniqueId = file_->textAttribute(name, "unique_id", 64).value_or("");
      matrix.staticMask = readMask(name + "_static_mask", {shape[1], shape[2]});
      matrix.dynamicMask = readMask(name + "_dynamic_mask", {shape[1], shape[2]});
    }
    if (matrices.empty()) throw FormatError(file_->path(), "\"tactile/m0\" is missing");
    const auto rules = file_->textAttribute("tactile", kTouchRulesKey, kMaxAttributeBytes);
    try {
      SensorLayout layout(std::move(matrices));
      return rules ? withTouchRules(layout, *rules) : std::move(layout);
    } catch (const FormatError&) {
      throw;
    } catch (const Error& error) {
      throw FormatError(file_->path(), error.what());
    } catch (const std::invalid_argument& error) {
      throw FormatError(file_->path(),
                        std::string("the layout of its matrices is invalid: ") + error.what());
    }
  }

  // A block from the cache, or read now.
  std::shared_ptr<const FrameBlock> blockWith(std::size_t frame) const {
    const std::size_t first = frame / framesPerBlock_ * framesPerBlock_;
    const std::lock_guard lock(mutex_);
    if (const auto* kept = cache_.find(first)) return *kept;
    return cache_.add(first, 1, readBlock(first));
  }

  std::shared_ptr<const FrameBlock> readBlock(std::size_t first) const {
    auto block = std::make_shared<FrameBlock>();
    block->first = first;
    const std::size_t count = std::min(framesPerBlock_, timesUs_.size() - first);
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      const std::size_t number = count * layout_.matrix(m).numReadings();
      std::vector<float>& values = block->values.emplace_back(number);
      if (counts_) {
        // Values outside of the type of the memory are cut to its ends: INT32 holds what is wrong.
        std::vector<std::int32_t> counts(number);
        matrices_[m].read<std::int32_t>(first, count, Hdf5Number::kI32, counts);
        constexpr std::int32_t kMaxCounts = 4095;
        bool plausible = true;
        for (std::size_t k = 0; k < number; ++k) {
          plausible &= counts[k] >= 0 && counts[k] <= kMaxCounts;
          values[k] = static_cast<float>(counts[k]);
        }
        if (!plausible)
          matrices_[m].fail("has a value that is not in 0..4095 counts" + near(first));
      } else {
        matrices_[m].read<float>(first, count, Hdf5Number::kF32, values);
        if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
          matrices_[m].fail("has a value that is not a number" + near(first));
      }
    }
    if (deviceTimes_) {
      block->deviceTimes.resize(count);
      deviceTimes_->read<std::int64_t>(first, count, Hdf5Number::kI64, block->deviceTimes);
    }
    if (!filtered_) return block;
    block->filtered.resize(count);
    filtered_->read<std::uint8_t>(first, count, Hdf5Number::kU8, block->filtered);
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      auto& kept = block->kept.emplace_back(count * layout_.matrix(m).numCells());
      kept_[m].read<std::uint8_t>(first, count, Hdf5Number::kU8, kept);
    }
    return block;
  }

  std::string near(std::size_t first) const {
    return " (frames " + std::to_string(first) + " to " +
           std::to_string(std::min(first + framesPerBlock_, timesUs_.size()) - 1) + ")";
  }

  std::unique_ptr<Hdf5Process> file_;
  std::size_t textBytesLeft_ = kMaxHdf5TextBytes;
  Provenance from_;
  RecordingMeta meta_;
  std::vector<Event> events_;
  std::vector<SeriesDescription> further_;
  std::deque<SampleSeries> samples_;  // by series
  SensorLayout layout_;
  StampSeries timesUs_;
  std::optional<ReadArray> deviceTimes_;
  std::optional<ReadArray> filtered_;
  std::vector<ReadArray> matrices_;  // readings, or values
  std::vector<ReadArray> kept_;
  bool counts_ = true;
  std::size_t framesPerBlock_ = 1;
  mutable std::mutex mutex_;  // over the cache
  mutable BlockCache<std::shared_ptr<const FrameBlock>> cache_{kCachedFrameBlocks};
};

void requirePalpateLayout(Hdf5Process& file) {
  const fs::path& path = file.path();
  if (file.textAttribute("", "format", kMaxAttributeBytes) != hdf5_layout::kFormat)
    throw FormatError(path,
                      "is an HDF5 file of another program; import its tables ('palpate import')");
  const auto version = file.integerAttribute("", "format_version");
  if (!version || *version < 1)
    throw FormatError(path, "does not say which version of the layout it has (format_version)");
  if (*version > kHdf5LayoutVersion)
    throw FormatError(path,
                      "was written by a newer Palpate: its layout has version " +
                          std::to_string(*version) + ", this program reads up to " +
                          std::to_string(kHdf5LayoutVersion));
}

// A file whose checksum doesn't fit is not read at all.
void requireUndamaged(const fs::path& path, int descriptor) {
  if (::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw FormatError(path, "is being written by another program");
  std::string block(hdf5_layout::kUserBlockBytes, '\0');
  const ssize_t got = ::pread(descriptor, block.data(), block.size(), 0);
  block.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  if (block.starts_with(kHdf5Signature))
    throw FormatError(path,
                      "is an HDF5 file of another program; import its tables ('palpate import')");
  if (!block.starts_with(kHdf5RecordingStart))
    throw FormatError(
        path, "can't be opened as HDF5: its header is damaged or belongs to another format");
  if (block !=
      hdf5_layout::userBlock(sha256OfDescriptor(descriptor, hdf5_layout::kUserBlockBytes, path)))
    throw FormatError(
        path,
        "is damaged, cut off, or was changed by another program: its checksum doesn't "
        "fit");
}

std::shared_ptr<const Hdf5Storage> openedHdf5(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure))
    throw FileError(path, failure ? "can't be read: " + failure.message() : "is not a file");
  const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.get() < 0)
    throw FileError(path, "can't be read: " + std::generic_category().message(errno));
  requireUndamaged(path, descriptor.get());
  // The very file that was checked, whatever the name stands for by now.
  auto file = std::make_unique<Hdf5Process>(path, descriptor.get(), Hdf5Use::kRecording);
  requirePalpateLayout(*file);
  return std::make_shared<const Hdf5Storage>(std::move(file));
}

}  // namespace

Recording readHdf5(const fs::path& path) {
  const std::shared_ptr<const Hdf5Storage> storage = openedHdf5(path);
  auto meta = storage->meta();
  ProfileInfo info = readInfo(meta, "hdf5", storage->counts());
  HandDescription hand = recordedHand(
      meta, storage->layout(), storage->width(kAngleSeries), storage->width(kTemperatureSeries));
  Profile profile =
      recordedProfile(path, std::move(info), std::move(hand), storage, storage->further());
  Damage damage;
  if (profile.givesReadings())
    profile =
        profile.withBaselines(baselinesOf(storage->events(), profile.layout(), &damage.events));
  return {.profile = std::move(profile),
          .events = storage->events(),
          .meta = std::move(meta),
          .provenance = storage->provenance(),
          .damage = std::move(damage)};
}

}  // namespace palpate
