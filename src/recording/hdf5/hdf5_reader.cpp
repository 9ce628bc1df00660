#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
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
#include "palpate/model/hand_file.h"
#include "palpate/recording/hdf5_recording.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/hdf5/hdf5_layout.h"
#include "recording/hdf5_library.h"
#include "recording/profile_meta.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

// Bounds of what is read, so that a hostile file costs little time and memory.
constexpr hsize_t kMostFrames = hsize_t{1} << 31;
constexpr hsize_t kMostSamples = hsize_t{1} << 31;
constexpr hsize_t kMostEvents = 1'000'000;
constexpr hsize_t kMostMetaRows = 1'000;
constexpr std::size_t kMostAttributeBytes = 60'000;
constexpr std::size_t kMostMetaBytes = 2 * kHandFileByteLimit;
constexpr hsize_t kMostReadChunkBytes = 64u << 20;
constexpr std::size_t kMostReadFrames = 4096;  // in one block
constexpr std::size_t kMostReadRows = 8192;
constexpr std::size_t kCachedFrameBlocks = 4;

// One data set of the file, with the message of each fault.
class ReadArray {
 public:
  ReadArray(const fs::path& path, hid_t file, std::string name)
      : path_(path), name_(std::move(name)) {
    if (H5Lexists(file, name_.c_str(), H5P_DEFAULT) <= 0) fail("is missing");
    const Hdf5Id access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    H5Pset_chunk_cache(access.get(), 0, 0, 1.0);  // blocks are kept here, not by the library
    id_ = Hdf5Id(H5Dopen2(file, name_.c_str(), access.get()), H5Dclose);
    if (!id_.ok()) fail("can't be opened: damaged, or no data set");
    const Hdf5Id space(H5Dget_space(id_.get()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 0 || rank > 3) fail("has another number of axes than in Palpate's layout");
    shape_.resize(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), shape_.data(), nullptr);
    const Hdf5Id type(H5Dget_type(id_.get()), H5Tclose);
    kind_ = H5Tget_class(type.get());
    typeBytes_ = H5Tget_size(type.get());
    requireReadableChunks();
  }

  hid_t id() const { return id_.get(); }
  const std::vector<hsize_t>& shape() const { return shape_; }
  H5T_class_t kind() const { return kind_; }
  // Length of a chunk along the first axis; 0: not chunked.
  hsize_t chunkLength() const { return chunkLength_; }

  [[noreturn]] void fail(const std::string& fault) const {
    throw FormatError(path_, inQuotes(name_) + " " + fault);
  }
  void requireShape(const std::vector<hsize_t>& shape) const {
    if (shape_ == shape) return;
    fail("has " + text(shape_) + " values instead of " + text(shape));
  }
  void requireKind(std::initializer_list<H5T_class_t> kinds) const {
    if (std::find(kinds.begin(), kinds.end(), kind_) == kinds.end())
      fail("has another type than in Palpate's layout");
  }

  // Reads rows first..first+count-1 of the first axis as numbers of a type of the memory.
  void read(hsize_t first, hsize_t count, hid_t memoryType, void* out) const {
    if (count == 0 || std::find(shape_.begin(), shape_.end(), 0) != shape_.end()) return;
    const Hdf5Id space(H5Dget_space(id_.get()), H5Sclose);
    std::vector<hsize_t> start(shape_.size(), 0);
    std::vector<hsize_t> size = shape_;
    start[0] = first;
    size[0] = count;
    const Hdf5Id memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                        H5Sclose);
    if (H5Sselect_hyperslab(
            space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) < 0 ||
        H5Dread(id_.get(), memoryType, memory.get(), space.get(), H5P_DEFAULT, out) < 0)
      fail("can't be read: damaged or cut off");
  }

  // Texts of an array of one axis.
  std::vector<std::string> texts(hsize_t mostCount, std::size_t mostBytes) const {
    requireKind({H5T_STRING});
    if (shape_.size() != 1 || shape_[0] > mostCount) fail("has too many texts");
    const Hdf5Id type(H5Dget_type(id_.get()), H5Tclose);
    if (H5Tis_variable_str(type.get()) <= 0) fail("has texts of another type");
    const Hdf5Id memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory.get(), H5T_VARIABLE);
    H5Tset_cset(memory.get(), H5Tget_cset(type.get()));
    std::vector<std::string> result;
    // One after the other, so that a hostile file can't ask for all memory at once.
    for (hsize_t i = 0; i < shape_[0]; ++i) {
      char* pointer = nullptr;
      read(i, 1, memory.get(), static_cast<void*>(&pointer));
      std::string one = pointer ? pointer : "";
      H5free_memory(pointer);
      if (one.size() > mostBytes) fail("has a text that is too long");
      result.push_back(hdf5RestoredText(one));
    }
    return result;
  }

  std::vector<std::int64_t> integers(hsize_t mostCount) const {
    requireKind({H5T_INTEGER});
    if (shape_.size() != 1 || shape_[0] > mostCount) fail("has too many values, or several axes");
    std::vector<std::int64_t> values;
    // Piece by piece: a false length fails at the first piece that isn't there.
    constexpr hsize_t kPiece = 1u << 20;
    for (hsize_t first = 0; first < shape_[0]; first += kPiece) {
      const hsize_t count = std::min(kPiece, shape_[0] - first);
      values.resize(static_cast<std::size_t>(first + count));
      read(first, count, H5T_NATIVE_INT64, values.data() + first);
    }
    return values;
  }

 private:
  static std::string text(const std::vector<hsize_t>& shape) {
    std::string result;
    for (const hsize_t length : shape)
      result += (result.empty() ? "" : " x ") + std::to_string(length);
    return result.empty() ? "no" : result;
  }

  void requireReadableChunks() {
    const Hdf5Id properties(H5Dget_create_plist(id_.get()), H5Pclose);
    const int numFilters = H5Pget_nfilters(properties.get());
    for (int i = 0; i < numFilters; ++i) {
      unsigned flags = 0;
      std::size_t numValues = 0;
      char name[64] = "";
      const H5Z_filter_t filter = H5Pget_filter2(properties.get(),
                                                 static_cast<unsigned>(i),
                                                 &flags,
                                                 &numValues,
                                                 nullptr,
                                                 sizeof name,
                                                 name,
                                                 nullptr);
      if (filter < 0 || H5Zfilter_avail(filter) <= 0)
        fail("is compressed by a filter that is not there (" + std::to_string(filter) +
             (name[0] ? ", " + std::string(name) : "") + "); write it with gzip or without");
    }
    if (H5Pget_layout(properties.get()) != H5D_CHUNKED) return;
    std::vector<hsize_t> chunk(shape_.size());
    H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
    hsize_t bytes = typeBytes_;
    for (const hsize_t length : chunk)
      if (__builtin_mul_overflow(bytes, length, &bytes) || bytes > kMostReadChunkBytes)
        fail("has chunks that are too large to be read");
    if (!chunk.empty()) chunkLength_ = chunk[0];
  }

  fs::path path_;
  std::string name_;
  Hdf5Id id_;
  std::vector<hsize_t> shape_;
  H5T_class_t kind_ = H5T_NO_CLASS;
  std::size_t typeBytes_ = 0;
  hsize_t chunkLength_ = 0;
};

bool hdf5HasObject(hid_t file, const std::string& name) {
  // Of a path every part must be there.
  for (std::size_t slash = name.find('/'); slash != std::string::npos;
       slash = name.find('/', slash + 1))
    if (H5Lexists(file, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0;
}

void requireAscendingStamps(const ReadArray& array, const std::vector<std::int64_t>& times) {
  constexpr std::int64_t kLatestUs = std::int64_t{1} << 60;  // as in a native recording
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i] < -kLatestUs || times[i] > kLatestUs || (i > 0 && times[i] <= times[i - 1]))
      array.fail("does not ascend at sample " + std::to_string(i));
}

// Joint angles or temperatures: stamps in memory, values in blocks of rows.
class SampleSeries {
 public:
  SampleSeries(const fs::path& path,
               hid_t file,
               const std::string& group,
               const std::string& name) {
    if (!hdf5HasObject(file, group))
      throw FormatError(path, "the group '" + group + "' is missing");
    if (!hdf5HasObject(file, group + "/time_us")) return;  // none was recorded
    const ReadArray times(path, file, group + "/time_us");
    timesUs_ = times.integers(kMostSamples);
    requireAscendingStamps(times, timesUs_);
    values_.emplace(path, file, group + "/" + name);
    values_->requireKind({H5T_FLOAT, H5T_INTEGER});
    if (values_->shape().size() != 2 || values_->shape()[1] < 1 ||
        values_->shape()[1] > kMaxSampleValues)
      values_->fail("must have 1 to " + std::to_string(kMaxSampleValues) + " columns");
    values_->requireShape({timesUs_.size(), values_->shape()[1]});
    width_ = static_cast<std::size_t>(values_->shape()[1]);
    rowsPerBlock_ =
        std::clamp<std::size_t>(static_cast<std::size_t>(values_->chunkLength()), 1, kMostReadRows);
  }

  std::size_t width() const { return timesUs_.empty() ? 0 : width_; }
  const std::vector<std::int64_t>& timesUs() const { return timesUs_; }

  std::vector<double> row(std::size_t index) const {
    const auto lock = hdf5Lock();
    const std::size_t first = index / rowsPerBlock_ * rowsPerBlock_;
    if (block_.empty() || first != firstInBlock_) {
      const std::size_t count = std::min(rowsPerBlock_, timesUs_.size() - first);
      block_.assign(count * width_, 0.0);
      try {
        values_->read(first, count, H5T_NATIVE_DOUBLE, block_.data());
      } catch (...) {
        block_.clear();
        throw;
      }
      firstInBlock_ = first;
    }
    const auto begin = block_.begin() + static_cast<std::ptrdiff_t>((index - first) * width_);
    std::vector<double> values(begin, begin + static_cast<std::ptrdiff_t>(width_));
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
      values_->fail("has a value that is not a number in row " + std::to_string(index));
    return values;
  }

 private:
  std::vector<std::int64_t> timesUs_;
  std::optional<ReadArray> values_;
  std::size_t width_ = 0;
  std::size_t rowsPerBlock_ = 1;
  mutable std::vector<double> block_;  // the rows that were read last
  mutable std::size_t firstInBlock_ = 0;
};

std::vector<RecordingEvent> hdf5EventsOf(const fs::path& path, hid_t file) {
  if (!hdf5HasObject(file, "events")) throw FormatError(path, "the group 'events' is missing");
  const auto times = ReadArray(path, file, "events/time_us").integers(kMostEvents);
  const auto integers = [&](const char* name) {
    const ReadArray array(path, file, name);
    array.requireShape({times.size()});
    return array.integers(kMostEvents);
  };
  const auto texts = [&](const char* name) {
    const ReadArray array(path, file, name);
    array.requireShape({times.size()});
    return array.texts(kMostEvents, 2 * kMaxEventBytes);
  };
  const auto ends = integers("events/end_us");
  const auto matrices = integers("events/matrix");
  auto kinds = texts("events/kind");
  auto words = texts("events/text");
  auto jsons = texts("events/json");
  std::vector<RecordingEvent> events;
  for (std::size_t i = 0; i < times.size(); ++i) {
    RecordingEvent& event = events.emplace_back();
    event.tUs = times[i];
    event.t1Us = ends[i];
    if (matrices[i] < INT32_MIN || matrices[i] > INT32_MAX)
      throw FormatError(path, "\"events/matrix\" is out of range in row " + std::to_string(i));
    if (matrices[i] != hdf5_layout::kNoMatrix) event.matrix = static_cast<int>(matrices[i]);
    event.kind = std::move(kinds[i]);
    event.text = std::move(words[i]);
    event.json = std::move(jsons[i]);
    if (event.kind.size() + event.text.size() + event.json.size() > kMaxEventBytes)
      throw FormatError(path, "event " + std::to_string(i) + " is too long");
  }
  return events;
}

std::map<std::string, std::string> hdf5MetaOf(const fs::path& path, hid_t file) {
  if (!hdf5HasObject(file, "meta")) throw FormatError(path, "the group 'meta' is missing");
  const auto keys = ReadArray(path, file, "meta/key").texts(kMostMetaRows, kMostAttributeBytes);
  const ReadArray valueArray(path, file, "meta/value");
  valueArray.requireShape({keys.size()});
  auto values = valueArray.texts(kMostMetaRows, kMostMetaBytes);
  std::map<std::string, std::string> meta;
  for (std::size_t i = 0; i < keys.size(); ++i) meta[keys[i]] = std::move(values[i]);
  return meta;
}

Provenance hdf5ProvenanceOf(hid_t file) {
  const auto text = [&](const char* name) {
    return hdf5RestoredText(readHdf5Text(file, name, kMostAttributeBytes).value_or(""));
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
  // The lock is held.
  Hdf5Storage(const fs::path& path, Hdf5Id file)
      : path_(path),
        file_(std::move(file)),
        from_(hdf5ProvenanceOf(file_.get())),
        meta_(hdf5MetaOf(path, file_.get())),
        events_(hdf5EventsOf(path, file_.get())),
        angles_(path, file_.get(), "joints", "angles"),
        temperatures_(path, file_.get(), "temperatures", "values") {
    readLayout();
    const ReadArray times(path, file_.get(), "tactile/time_us");
    timesUs_ = times.integers(kMostFrames);
    requireAscendingStamps(times, timesUs_);
    if (hdf5HasObject(file_.get(), "tactile/device_time_ms"))
      deviceTimes_.emplace(ofFrames("tactile/device_time_ms", {timesUs_.size()}, {H5T_INTEGER}));
    bool anyCounts = false;
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      matrices_.push_back(
          ofFrames(hdf5_layout::matrixPath(m), shapeOf(m), {H5T_INTEGER, H5T_FLOAT}));
      const bool counts = matrices_.back().kind() == H5T_INTEGER;
      if (m > 0 && counts != anyCounts) matrices_.back().fail("has another type than the first");
      anyCounts = counts;
    }
    counts_ = anyCounts;
    if (hdf5HasObject(file_.get(), "tactile/filtered")) {
      filtered_.emplace(ofFrames("tactile/filtered", {timesUs_.size()}, {H5T_INTEGER}));
      for (std::size_t m = 0; m < layout_.numMatrices(); ++m)
        active_.push_back(
            ofFrames(hdf5_layout::matrixPath(m) + "_active", shapeOf(m), {H5T_INTEGER}));
    }
    // A block is a chunk, but not more than fits into memory.
    const std::size_t fitting = (16u << 20) / (layout_.numCells() * sizeof(float)) + 1;
    framesPerBlock_ = std::clamp<std::size_t>(
        std::min<std::size_t>(static_cast<std::size_t>(matrices_[0].chunkLength()), fitting),
        1,
        kMostReadFrames);
  }

  const SensorLayout& layout() const { return layout_; }
  bool counts() const { return counts_; }
  const SampleSeries& angleSeries() const { return angles_; }
  const SampleSeries& temperatureSeries() const { return temperatures_; }
  const Provenance& provenance() const { return from_; }
  const std::map<std::string, std::string>& meta() const { return meta_; }
  const std::vector<RecordingEvent>& events() const { return events_; }

  std::size_t numFrames() const override { return timesUs_.size(); }
  std::int64_t frameTimeUs(std::size_t frame) const override { return timesUs_[frame]; }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    const std::shared_ptr<const FrameBlock> block = blockWith(frame);
    const std::size_t at = frame - block->first;
    out.deviceMs.reset();
    if (!block->deviceTimes.empty() && block->deviceTimes[at] != hdf5_layout::kNoDeviceTime)
      out.deviceMs = block->deviceTimes[at];
    out.filtered.clear();
    out.values.resize(layout_.numCells());
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      const std::size_t cells = layout_.matrix(m).numCells();
      const auto from = block->values[m].begin() + static_cast<std::ptrdiff_t>(at * cells);
      std::copy(from,
                from + static_cast<std::ptrdiff_t>(cells),
                out.values.begin() + static_cast<std::ptrdiff_t>(layout_.offset(m)));
    }
    if (block->filtered.empty() || block->filtered[at] == 0) return;
    out.filtered = out.values;
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      const std::size_t cells = layout_.matrix(m).numCells();
      for (std::size_t k = 0; k < cells; ++k)
        if (block->active[m][at * cells + k] == 0) out.values[layout_.offset(m) + k] = 0.0F;
    }
  }
  std::size_t numAngles() const override { return angles_.timesUs().size(); }
  std::int64_t angleTimeUs(std::size_t sample) const override { return angles_.timesUs()[sample]; }
  JointAngles angles(std::size_t sample) const override {
    return {angles_.timesUs()[sample], angles_.row(sample)};
  }
  std::size_t numTemperatures() const override { return temperatures_.timesUs().size(); }
  std::int64_t temperatureTimeUs(std::size_t sample) const override {
    return temperatures_.timesUs()[sample];
  }
  Temperatures temperatures(std::size_t sample) const override {
    return {temperatures_.timesUs()[sample], temperatures_.row(sample)};
  }

 private:
  // Consecutive frames as they are in the file.
  struct FrameBlock {
    std::size_t first = 0;
    std::vector<std::vector<float>> values;
    std::vector<std::int64_t> deviceTimes;
    std::vector<std::uint8_t> filtered;
    std::vector<std::vector<std::uint8_t>> active;
  };

  std::vector<hsize_t> shapeOf(std::size_t m) const {
    return {timesUs_.size(),
            static_cast<hsize_t>(layout_.matrix(m).rows),
            static_cast<hsize_t>(layout_.matrix(m).columns)};
  }
  ReadArray ofFrames(const std::string& name,
                     const std::vector<hsize_t>& shape,
                     std::initializer_list<H5T_class_t> kinds) const {
    ReadArray array(path_, file_.get(), name);
    array.requireKind(kinds);
    array.requireShape(shape);
    return array;
  }

  Mask readMask(const std::string& name, const std::vector<hsize_t>& shape) const {
    const ReadArray array(path_, file_.get(), name);
    array.requireKind({H5T_INTEGER});
    array.requireShape(shape);
    Mask mask(static_cast<std::size_t>(shape[0] * shape[1]));
    array.read(0, shape[0], H5T_NATIVE_UINT8, mask.data());
    for (auto& on : mask) on = on != 0;
    return mask;
  }

  void readLayout() {
    if (!hdf5HasObject(file_.get(), "tactile"))
      throw FormatError(path_, "the group 'tactile' is missing");
    std::vector<MatrixLayout> matrices;
    hsize_t cells = 0;
    for (std::size_t m = 0; hdf5HasObject(file_.get(), hdf5_layout::matrixPath(m)); ++m) {
      const std::string name = hdf5_layout::matrixPath(m);
      const ReadArray array(path_, file_.get(), name);
      if (m == kMaxMatrices) array.fail("is one matrix too many");
      const auto& shape = array.shape();
      if (shape.size() != 3 || shape[1] < 1 || shape[1] > 256 || shape[2] < 1 || shape[2] > 256)
        array.fail("must be frames x rows x columns, at most 256 x 256 taxels");
      cells += shape[1] * shape[2];
      if (cells > kMaxPlaces) array.fail("is too large: too many taxels in all");
      MatrixLayout& matrix = matrices.emplace_back();
      matrix.rows = static_cast<int>(shape[1]);
      matrix.columns = static_cast<int>(shape[2]);
      const auto pitch = readHdf5Number(array.id(), "pitch_mm");
      if (!pitch) array.fail("has no attribute pitch_mm");
      matrix.pitchMm = *pitch;
      matrix.uniqueId = readHdf5Text(array.id(), "unique_id", 64).value_or("");
      matrix.staticMask = readMask(name + "_static_mask", {shape[1], shape[2]});
      matrix.dynamicMask = readMask(name + "_dynamic_mask", {shape[1], shape[2]});
    }
    if (matrices.empty()) throw FormatError(path_, "\"tactile/m0\" is missing");
    try {
      layout_ = SensorLayout(std::move(matrices));
    } catch (const std::invalid_argument& error) {
      throw FormatError(path_,
                        std::string("the layout of its matrices is invalid: ") + error.what());
    }
  }

  // A block from the cache, or read now.
  std::shared_ptr<const FrameBlock> blockWith(std::size_t frame) const {
    const std::size_t first = frame / framesPerBlock_ * framesPerBlock_;
    const auto lock = hdf5Lock();
    for (auto it = cache_.begin(); it != cache_.end(); ++it)
      if ((*it)->first == first) {
        cache_.splice(cache_.begin(), cache_, it);
        return cache_.front();
      }
    auto block = readBlock(first);
    cache_.push_front(block);
    if (cache_.size() > kCachedFrameBlocks) cache_.pop_back();
    return block;
  }

  std::shared_ptr<const FrameBlock> readBlock(std::size_t first) const {
    auto block = std::make_shared<FrameBlock>();
    block->first = first;
    const std::size_t count = std::min(framesPerBlock_, timesUs_.size() - first);
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      const std::size_t number = count * layout_.matrix(m).numCells();
      std::vector<float>& values = block->values.emplace_back(number);
      if (counts_) {
        // Values outside of the type of the memory are cut to its ends: INT32 holds what is wrong.
        std::vector<std::int32_t> counts(number);
        matrices_[m].read(first, count, H5T_NATIVE_INT32, counts.data());
        constexpr std::int32_t kMostCounts = 4095;
        bool plausible = true;
        for (std::size_t k = 0; k < number; ++k) {
          plausible &= counts[k] >= 0 && counts[k] <= kMostCounts;
          values[k] = static_cast<float>(counts[k]);
        }
        if (!plausible)
          matrices_[m].fail("has a value that is not in 0..4095 counts" + near(first));
      } else {
        matrices_[m].read(first, count, H5T_NATIVE_FLOAT, values.data());
        if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
          matrices_[m].fail("has a value that is not a number" + near(first));
      }
    }
    if (deviceTimes_) {
      block->deviceTimes.resize(count);
      deviceTimes_->read(first, count, H5T_NATIVE_INT64, block->deviceTimes.data());
    }
    if (!filtered_) return block;
    block->filtered.resize(count);
    filtered_->read(first, count, H5T_NATIVE_UINT8, block->filtered.data());
    for (std::size_t m = 0; m < layout_.numMatrices(); ++m) {
      auto& active = block->active.emplace_back(count * layout_.matrix(m).numCells());
      active_[m].read(first, count, H5T_NATIVE_UINT8, active.data());
    }
    return block;
  }

  std::string near(std::size_t first) const {
    return " (frames " + std::to_string(first) + " to " +
           std::to_string(std::min(first + framesPerBlock_, timesUs_.size()) - 1) + ")";
  }

  fs::path path_;
  Hdf5Id file_;
  Provenance from_;
  std::map<std::string, std::string> meta_;
  std::vector<RecordingEvent> events_;
  SampleSeries angles_;
  SampleSeries temperatures_;
  SensorLayout layout_;
  std::vector<std::int64_t> timesUs_;
  std::optional<ReadArray> deviceTimes_;
  std::optional<ReadArray> filtered_;
  std::vector<ReadArray> matrices_;
  std::vector<ReadArray> active_;
  bool counts_ = true;
  std::size_t framesPerBlock_ = 1;
  mutable std::list<std::shared_ptr<const FrameBlock>> cache_;  // the last used one first
};

void requirePalpateLayout(const fs::path& path, hid_t file) {
  if (readHdf5Text(file, "format", kMostAttributeBytes) != hdf5_layout::kFormat)
    throw FormatError(path,
                      "is an HDF5 file of another program; import its tables ('palpate import')");
  const auto version = readHdf5Integer(file, "format_version");
  if (!version || *version < 1)
    throw FormatError(path, "does not say which version of the layout it has (format_version)");
  if (*version > kHdf5LayoutVersion)
    throw FormatError(path,
                      "was written by a newer Palpate: its layout has version " +
                          std::to_string(*version) + ", this program reads up to " +
                          std::to_string(kHdf5LayoutVersion));
}

// What is the same as long as nobody writes a file.
struct FileIdentity {
  dev_t device;
  ino_t node;
  off_t bytes;
  std::int64_t changedNs;
  bool operator==(const FileIdentity&) const = default;
};

FileIdentity identityOf(const fs::path& path, int descriptor) {
  struct stat found {};
  if (::fstat(descriptor, &found) != 0)
    throw FileError(path, "can't be read: " + std::generic_category().message(errno));
  return {found.st_dev,
          found.st_ino,
          found.st_size,
          std::int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec};
}

// The library is not safe against damage in a file's structures: it sees none whose checksum
// doesn't fit.
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
    throw FormatError(path,
                      "can't be opened as HDF5: its beginning is damaged, or of another file");
  if (block !=
      hdf5_layout::userBlock(sha256OfDescriptor(descriptor, hdf5_layout::kUserBlockBytes, path)))
    throw FormatError(
        path,
        "is damaged, cut off, or was changed by another program: its checksum doesn't "
        "fit");
}

// Files that are open, so that events and meta of a recording are not another opening.
struct OpenHdf5File {
  FileIdentity identity;
  std::weak_ptr<const Hdf5Storage> storage;
};

std::shared_ptr<const Hdf5Storage> openedHdf5(const fs::path& path) {
  const auto lock = hdf5Lock();
  static std::vector<OpenHdf5File> open;
  std::error_code failure;
  if (!fs::is_regular_file(path, failure))
    throw FileError(path, failure ? "can't be read: " + failure.message() : "is not a file");
  const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.get() < 0)
    throw FileError(path, "can't be read: " + std::generic_category().message(errno));
  const FileIdentity identity = identityOf(path, descriptor.get());
  std::erase_if(open, [](const OpenHdf5File& file) { return file.storage.expired(); });
  for (const OpenHdf5File& file : open)
    if (file.identity == identity)
      if (auto storage = file.storage.lock()) return storage;
  requireUndamaged(path, descriptor.get());
  // The very file that was checked, whatever the name stands for by now.
  const std::string checked = "/proc/self/fd/" + std::to_string(descriptor.get());
  Hdf5Id file(H5Fopen(checked.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.ok()) throw FormatError(path, "can't be opened as HDF5: it is being written");
  requirePalpateLayout(path, file.get());
  auto storage = std::make_shared<const Hdf5Storage>(path, std::move(file));
  open.push_back({identity, storage});
  return storage;
}

}  // namespace

Hdf5Recording readHdf5(const fs::path& path) {
  const std::shared_ptr<const Hdf5Storage> storage = openedHdf5(path);
  auto meta = storage->meta();
  ProfileInfo info = readInfo(meta, "hdf5", storage->counts());
  HandDescription hand = recordedHand(meta,
                                      storage->layout(),
                                      storage->angleSeries().width(),
                                      storage->temperatureSeries().width());
  return {Profile(std::move(info), std::move(hand), storage),
          storage->events(),
          std::move(meta),
          storage->provenance()};
}

}  // namespace palpate
