// readMcap() and recoverMcap() of mcap_recording.h.
#include <algorithm>
#include <cmath>
#include <future>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/parallel.h"
#include "palpate/core/time.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/mcap_recording.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/block_cache.h"
#include "recording/mcap/mcap_foreign.h"
#include "recording/mcap/mcap_format.h"
#include "recording/mcap/mcap_messages.h"
#include "recording/mcap/mcap_structure.h"
#include "recording/profile_meta.h"
#include "recording/sample_columns.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kMcapLatestUs = std::int64_t{1} << 60;  // as in a native recording
constexpr std::size_t kCachedMcapBlocks = 4;
constexpr float kMaxMcapCounts = 4095.0F;

std::int64_t mcapTextNumber(const std::map<std::string, std::string>& texts,
                            const char* key,
                            std::int64_t otherwise) {
  const auto found = texts.find(key);
  if (found == texts.end()) return otherwise;
  return parseInteger(found->second).value_or(otherwise);
}

// What a channel of Palpate's holds.
enum class McapRole { kOther, kFrame, kImage, kSample, kEvent };

// The first events of a file, or of a chunk.
class McapEvents {
 public:
  void add(Event event) {
    bytes_ += sizeof event + event.kind.size() + event.text.size() + event.json.size();
    if (bytes_ > kMaxMcapEventsBytes)
      ++leftOut_;
    else
      kept_.push_back(std::move(event));
  }
  void add(McapEvents&& others) {
    for (Event& event : others.kept_) add(std::move(event));
    leftOut_ += others.leftOut_;
  }
  std::vector<Event> take() { return std::move(kept_); }
  std::size_t leftOut() const noexcept { return leftOut_; }

 private:
  std::vector<Event> kept_;
  std::size_t bytes_ = 0;
  std::size_t leftOut_ = 0;
};

// The samples of a series in a chunk.
struct McapSamples {
  std::vector<std::int64_t> timesUs;
  std::vector<std::int64_t> deviceUs;  // empty of the hand's series
  std::vector<double> values;          // rows x width
  std::size_t width = 0;               // 0: not known
};

// What a chunk holds.
struct McapBlock {
  std::vector<std::int64_t> frameUs;
  std::vector<std::int64_t> deviceMs;
  std::vector<std::uint8_t> filtered;
  std::vector<float> values;       // frames x places
  std::vector<std::uint8_t> kept;  // frames x bytes; empty where no frame is filtered
  bool anyFloat = false;
  std::vector<McapSamples> samples;  // by series
  McapEvents events;
  bool cutFrame = false;  // the last frame had not all of its images, and is left out
  // Other programs may put the images of a frame into two chunks.
  std::size_t leading = 0;    // images that belong to the last frame of the chunk before
  std::size_t continued = 0;  // images of the last frame that came from the chunk behind
};

// Where the messages of a recording are in a file that Palpate has written, and what they say.
class McapOwnFile {
 public:
  McapOwnFile(const fs::path& path, const McapStructure& structure) : path_(path) {
    const auto& about = structure.metadata.at(mcap_format::kAboutRecord);
    const std::int64_t version = mcapTextNumber(about, "layout_version", 0);
    if (version < 1)
      throw FormatError(path_, "does not say which version of the layout it has (layout_version)");
    if (version > kMcapLayoutVersion)
      throw FormatError(path_,
                        "was written by a newer Palpate: its layout has version " +
                            std::to_string(version) + ", this program reads up to " +
                            std::to_string(kMcapLayoutVersion));
    const auto type = about.find("value_type");
    saysFloat_ = type != about.end() && type->second == "float";
    findChannels(structure.channels, mcapTextNumber(about, "matrices", 0));
  }

  const SensorLayout& layout() const { return layout_; }
  // Those beside the hand's.
  const std::vector<SeriesDescription>& further() const { return further_; }
  std::size_t numSeries() const { return kHandSeries + further_.size(); }
  // "angles", "samples of wrist".
  std::string samplesText(std::size_t series) const {
    return series == kAngleSeries         ? "angles"
           : series == kTemperatureSeries ? "temperatures"
                                          : "samples of " + further_[series - kHandSeries].name;
  }
  bool saysFloat() const { return saysFloat_; }
  std::optional<std::uint16_t> eventChannel() const { return eventChannel_; }

  // The records of chunk (current + ahead), or nullopt past the end.
  using Next = std::function<std::optional<std::string>(std::size_t ahead)>;
  // Throws FormatError, which begins with `place`. Of a salvage a frame that was cut is left out.
  McapBlock block(std::string records,
                  const std::string& place,
                  bool salvage,
                  const Next& next) const {
    McapBlock block;
    block.samples.resize(numSeries());
    for (std::size_t i = 0; i < further_.size(); ++i)
      block.samples[kHandSeries + i].width = further_[i].columns.size();
    std::size_t images = layout_.numMatrices();  // of the last frame, that are there
    const auto fail = [&](const std::string& fault) {
      throw FormatError(path_, place + " " + fault);
    };
    const auto endFrame = [&] {
      if (images == layout_.numMatrices()) return;
      fail(
          "has a frame without all of its images: the file was changed by another program, or is "
          "damaged");
    };
    const auto takeImage = [&](const McapMessage& message) {
      if (images >= layout_.numMatrices() || roles_[message.channel].matrix != images)
        fail(
            "has an image that belongs to no frame: the file was changed by another program, or "
            "is damaged");
      const std::string fault = addImage(message.data, message.channel, block);
      if (!fault.empty()) fail("has an image that " + fault);
      ++images;
    };
    reserveFrames(records, block);
    const bool whole = forEachMcapRecord(records, [&](std::uint8_t op, std::string_view content) {
      McapMessage message;
      if (!readRoleMessage(op, content, message)) return;
      switch (roles_[message.channel].role) {
        case McapRole::kFrame:
          endFrame();
          images = 0;
          if (!addFrame(message.data, block)) fail("has a damaged message about a frame");
          break;
        case McapRole::kImage:
          if (block.frameUs.empty())
            ++block.leading;
          else
            takeImage(message);
          break;
        case McapRole::kSample: {
          const std::size_t series = roles_[message.channel].series;
          if (!addSample(message.data, series, block.samples[series]))
            fail("has damaged " + samplesText(series));
          break;
        }
        case McapRole::kEvent:
          if (!addEvent(message.data, block.events)) fail("has a damaged event");
          break;
        case McapRole::kOther:
          break;
      }
    });
    if (!whole) fail("is damaged: its records don't fit");
    records = {};
    // A frame may go on over several chunks where these are very small.
    for (std::size_t ahead = 1; images != layout_.numMatrices(); ++ahead) {
      const std::optional<std::string> more = next(ahead);
      if (!more) break;
      bool ended = false;
      forEachMcapRecord(*more, [&](std::uint8_t op, std::string_view content) {
        McapMessage message;
        if (ended || !readRoleMessage(op, content, message)) return;
        const McapRole role = roles_[message.channel].role;
        ended = role == McapRole::kFrame;
        if (role != McapRole::kImage) return;
        takeImage(message);
        ++block.continued;
      });
      if (ended) break;
    }
    if (images != layout_.numMatrices() && salvage)
      dropLastFrame(block);
    else
      endFrame();
    return block;
  }

 private:
  struct ChannelRole {
    McapRole role = McapRole::kOther;
    std::size_t matrix = 0;
    std::size_t series = 0;
    bool protobuf = false;
  };

  // A large chunk would have its values twice in memory while they grow.
  void reserveFrames(std::string_view records, McapBlock& block) const {
    std::size_t frames = 0;
    forEachMcapRecord(records, [&](std::uint8_t op, std::string_view content) {
      McapMessage message;
      if (readRoleMessage(op, content, message) && roles_[message.channel].role == McapRole::kFrame)
        ++frames;
    });
    // As many as the images of their bytes can be.
    block.values.reserve(std::min(frames * layout_.numCells(), records.size() / sizeof(short)));
  }

  // Returns false for records that are no message of a known channel.
  bool readRoleMessage(std::uint8_t opcode, std::string_view content, McapMessage& message) const {
    if (opcode != mcap_format::kMessage) return false;
    if (!readMcapMessage(content, message)) throw FormatError(path_, "has a damaged message");
    return message.channel < roles_.size();
  }

  void dropLastFrame(McapBlock& block) const {
    block.cutFrame = true;
    block.frameUs.pop_back();
    block.deviceMs.pop_back();
    block.filtered.pop_back();
    block.values.resize(block.frameUs.size() * layout_.numCells());
    if (!block.kept.empty()) block.kept.resize(block.frameUs.size() * maskBytes());
  }

  std::size_t maskBytes() const { return (layout_.numCells() + 7) / 8; }

  void findChannels(const McapChannels& channels, std::int64_t numMatrices) {
    if (numMatrices < 1 || numMatrices > static_cast<std::int64_t>(kMaxMatrices))
      throw FormatError(path_, "has no matrices, or too many");
    std::vector<MatrixLayout> matrices(static_cast<std::size_t>(numMatrices));
    std::vector<bool> found(matrices.size());
    bool frames = false;
    for (const auto& entry : channels.channels) {
      const std::uint16_t id = entry.first;
      const McapChannel& channel = entry.second;
      if (roles_.size() <= id) roles_.resize(std::size_t{id} + 1);
      ChannelRole& role = roles_[id];
      const auto schema = channels.schemas.find(channel.schema);
      const std::string name = schema == channels.schemas.end() ? "" : schema->second.name;
      const auto is = [&](const char* topic, const char* type) {
        if (channel.topic != topic) return false;
        if (name != type || channel.encoding != "cdr")
          throw FormatError(path_,
                            "the topic " + escapedLine(topic) + " has messages " + inQuotes(name) +
                                " (" + escapedLine(channel.encoding) + ") instead of " + type);
        return true;
      };
      if (is(mcap_format::kFrames, "palpate_msgs/msg/Frame")) {
        role.role = McapRole::kFrame;
        frames = true;
      } else if (is(mcap_format::kAngles, "palpate_msgs/msg/Values")) {
        role = {.role = McapRole::kSample, .series = kAngleSeries};
      } else if (is(mcap_format::kTemperatures, "palpate_msgs/msg/Values")) {
        role = {.role = McapRole::kSample, .series = kTemperatureSeries};
      } else if (channel.topic.starts_with(mcap_format::kSeries) &&
                 is(channel.topic.c_str(), "palpate_msgs/msg/Sample")) {
        role = {.role = McapRole::kSample, .series = numSeries()};
        further_.push_back(seriesOf(channel));
        if (numSeries() > kMaxSeries) throw FormatError(path_, "has too many series");
      } else if (is(mcap_format::kEvents, "palpate_msgs/msg/Event")) {
        role.role = McapRole::kEvent;
        eventChannel_ = id;
      }
      for (std::size_t m = 0; m < matrices.size(); ++m) {
        if (channel.topic != mcap_format::imageTopic(m)) continue;
        if (found[m]) throw FormatError(path_, "has two topics " + channel.topic);
        found[m] = true;
        role.role = McapRole::kImage;
        role.matrix = m;
        role.protobuf = channel.encoding == "protobuf" && name == "foxglove.RawImage";
        if (!role.protobuf && !(channel.encoding == "cdr" && name == "sensor_msgs/msg/Image"))
          throw FormatError(path_, "the topic " + channel.topic + " has no images");
        matrices[m] = matrixOf(channel);
      }
    }
    if (!frames) throw FormatError(path_, "the topic /palpate/frames is missing");
    std::size_t cells = 0;
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      if (!found[m])
        throw FormatError(path_, "the topic " + mcap_format::imageTopic(m) + " is missing");
      cells += matrices[m].numCells();
    }
    if (cells > kMaxPlaces) throw FormatError(path_, "has too many taxels");
    try {
      layout_ = SensorLayout(std::move(matrices));
    } catch (const std::invalid_argument& error) {
      throw FormatError(path_,
                        std::string("the layout of its matrices is invalid: ") + error.what());
    }
  }

  SeriesDescription seriesOf(const McapChannel& channel) const {
    const auto text = [&](const char* key) {
      const auto found = channel.metadata.find(key);
      return found == channel.metadata.end() ? std::string() : found->second;
    };
    SeriesDescription series{channel.topic.substr(std::string_view(mcap_format::kSeries).size()),
                             mcapRestoredText(text("role")),
                             {},
                             mcapRestoredText(text("source"))};
    try {
      const Json names = Json::parse(text("columns"));
      const Json units = Json::parse(text("units"));
      for (std::size_t i = 0; i < names.size(); ++i)
        series.columns.push_back(
            {mcapRestoredText(names.at(i).asString()), mcapRestoredText(units.at(i).asString())});
      validate(series);
    } catch (const std::exception& error) {
      throw FormatError(path_,
                        "the topic " + escapedLine(channel.topic) + " has no valid columns (" +
                            escapedLine(error.what()) + ")");
    }
    return series;
  }

  MatrixLayout matrixOf(const McapChannel& channel) const {
    MatrixLayout matrix;
    const auto fail = [&](const char* what) {
      throw FormatError(path_, "the topic " + channel.topic + " has no valid " + what);
    };
    const std::int64_t rows = mcapTextNumber(channel.metadata, "rows", 0);
    const std::int64_t columns = mcapTextNumber(channel.metadata, "columns", 0);
    if (rows < 1 || rows > 256 || columns < 1 || columns > 256) fail("rows and columns (1..256)");
    matrix.rows = static_cast<int>(rows);
    matrix.columns = static_cast<int>(columns);
    const auto text = [&](const char* key) {
      const auto found = channel.metadata.find(key);
      return found == channel.metadata.end() ? std::string() : found->second;
    };
    const auto pitch = parseDouble(text("pitch_mm"));
    if (!pitch) fail("pitch_mm");
    matrix.pitchMm = *pitch;
    if (const std::string along = text("pitch_y_mm"); !along.empty()) {
      const auto pitchY = parseDouble(along);
      if (!pitchY) fail("pitch_y_mm");
      matrix.pitchMm.y = *pitchY;
    }
    matrix.uniqueId = mcapRestoredText(text("unique_id"));
    const auto mask = [&](const char* key) {
      const std::string digits = text(key);
      Mask on;
      for (const char digit : digits) on.push_back(digit == '1' ? 1 : 0);
      if (on.size() != matrix.numCells() || digits.find_first_not_of("01") != std::string::npos)
        fail(key);
      return on;
    };
    matrix.staticMask = mask("static_mask");
    matrix.dynamicMask = mask("dynamic_mask");
    return matrix;
  }

  bool addFrame(std::string_view data, McapBlock& block) const {
    CdrReader reader(data);
    block.frameUs.push_back(reader.number<std::int64_t>());
    block.deviceMs.push_back(reader.number<std::int64_t>());
    block.filtered.push_back(reader.number<std::uint8_t>() != 0 ? 1 : 0);
    const std::string_view active = reader.bytes();
    block.values.resize(block.frameUs.size() * layout_.numCells());
    if (!reader.ok()) return false;
    if (block.filtered.back() == 0) {
      if (!block.kept.empty()) block.kept.resize(block.frameUs.size() * maskBytes());
      return active.empty();
    }
    // Older files have only `active`, for both.
    std::string_view kept = reader.bytes();
    if (!reader.ok()) kept = active;
    if (active.size() != maskBytes() || kept.size() != maskBytes()) return false;
    block.kept.resize(block.frameUs.size() * maskBytes());
    std::copy(
        kept.begin(), kept.end(), block.kept.end() - static_cast<std::ptrdiff_t>(kept.size()));
    return true;
  }

  // Returns what is wrong, or an empty text.
  std::string addImage(std::string_view data, std::uint16_t channel, McapBlock& block) const {
    const ChannelRole& role = roles_[channel];
    const auto image = role.protobuf ? readRawImage(data) : readRosImage(data);
    if (!image) return "is damaged";
    const MatrixLayout& layout = layout_.matrix(role.matrix);
    if (image->rows != static_cast<std::uint32_t>(layout.rows) ||
        image->columns != static_cast<std::uint32_t>(layout.columns))
      return "has a different size than its matrix";
    const bool isFloat = image->encoding == "32FC1";
    if (!isFloat && image->encoding != "mono16")
      return "has another encoding, " + inQuotes(image->encoding);
    block.anyFloat |= isFloat;
    float* const to = block.values.data() + block.values.size() - layout_.numCells() +
                      layout_.offset(role.matrix);
    mcapPixels(*image, to);
    for (std::size_t k = 0; k < layout.numCells(); ++k) {
      if (isFloat ? !std::isfinite(to[k]) : to[k] > kMaxMcapCounts)
        return isFloat ? "has a value that is not a number"
                       : "has a value that is not in 0..4095 counts";
    }
    return "";
  }

  static bool addSample(std::string_view data, std::size_t series, McapSamples& samples) {
    CdrReader reader(data);
    samples.timesUs.push_back(reader.number<std::int64_t>());
    if (series >= kHandSeries) samples.deviceUs.push_back(reader.number<std::int64_t>());
    const std::vector<double> row = reader.doubles(kMaxSampleValues);
    if (!reader.ok() || row.empty() || (samples.width != 0 && samples.width != row.size()) ||
        !areSampleValues(series, row))
      return false;
    samples.width = row.size();
    samples.values.insert(samples.values.end(), row.begin(), row.end());
    return true;
  }

  static bool addEvent(std::string_view data, McapEvents& events) {
    CdrReader reader(data);
    Event event;
    event.tUs = reader.number<std::int64_t>();
    event.t1Us = reader.number<std::int64_t>();
    const auto matrix = reader.number<std::int32_t>();
    if (matrix != mcap_format::kNoMatrix) event.matrix = matrix;
    event.kind = mcapRestoredText(reader.text());
    event.text = mcapRestoredText(reader.text());
    event.json = mcapRestoredText(reader.text());
    if (!reader.ok() || event.kind.size() + event.text.size() + event.json.size() > kMaxEventBytes)
      return false;
    events.add(std::move(event));
    return true;
  }

  fs::path path_;
  SensorLayout layout_;
  std::vector<ChannelRole> roles_;  // by number of the channel
  std::vector<SeriesDescription> further_;
  std::optional<std::uint16_t> eventChannel_;
  bool saysFloat_ = false;
};

McapBlock readMcapBlock(const McapFile& file,
                        const McapOwnFile& own,
                        const std::vector<McapPiece>& pieces,
                        std::size_t index,
                        bool salvage) {
  const auto next = [&](std::size_t ahead) -> std::optional<std::string> {
    if (ahead >= pieces.size() - index) return std::nullopt;
    try {
      return readMcapPiece(file, pieces[index + ahead], index + ahead);
    } catch (const FormatError&) {
      if (!salvage) throw;
      return std::nullopt;
    }
  };
  return own.block(
      readMcapPiece(file, pieces[index], index), "chunk " + std::to_string(index), salvage, next);
}

// Where the samples of a series begin in each chunk, and their stamps.
struct McapSeriesIndex {
  std::vector<std::int64_t> timesUs;
  std::vector<std::size_t> firsts;  // by chunk: index of its first sample
  std::size_t width = 0;            // of a series

  // Chunk that holds a sample.
  std::size_t pieceOf(std::size_t sample) const {
    return static_cast<std::size_t>(std::upper_bound(firsts.begin(), firsts.end(), sample) -
                                    firsts.begin()) -
           1;
  }
};

class McapStorage final : public ProfileStorage {
 public:
  McapStorage(McapFile file, McapOwnFile own, std::vector<McapPiece> pieces)
      : file_(std::move(file)),
        own_(std::move(own)),
        pieces_(std::move(pieces)),
        samples_(own_.numSeries()) {}

  // Reads all chunks, checks them and notes where samples are. In a salvage, damaged ones are left
  // out; their number is returned.
  std::size_t scan(const Progress& progress, std::size_t threads, bool salvage) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    looksAhead_ = threads > 1;
    const std::size_t largestBatch = 2 * threads;
    std::size_t damaged = 0;
    salvage_ = salvage;
    std::size_t count = 0;
    for (std::size_t first = 0; first < pieces_.size(); first += count) {
      reportProgress(progress, first, pieces_.size());
      std::uint64_t raw = pieces_[first].rawSize;
      count = 1;
      while (count < std::min(largestBatch, pieces_.size() - first) &&
             (raw += pieces_[first + count].rawSize) <= kSmallMcapPiecesBytes)
        ++count;
      std::vector<McapBlock> blocks(count);
      std::vector<std::string> faults(count);
      forEachInParallel(
          count,
          [&](std::size_t i) {
            try {
              blocks[i] = readBlock(first + i);
            } catch (const FormatError& error) {
              if (!salvage) throw;
              blocks[i] = {};
              blocks[i].samples.resize(own_.numSeries());
              faults[i] = mcapFaultOf(file_.path(), error);
            }
          },
          {},
          threads);
      for (std::size_t i = 0; i < count; ++i) {
        if (!faults[i].empty() && damaged++ == 0) firstFault_ = faults[i];
        take(blocks[i], first + i);
      }
    }
    return damaged;
  }

  const McapOwnFile& own() const { return own_; }
  bool counts() const { return !anyFloat_ && !own_.saysFloat(); }
  std::size_t width(std::size_t series) const { return samples_[series].width; }
  McapEvents& events() { return events_; }
  std::size_t cutFrames() const { return cutFrames_; }
  const std::string& firstFault() const { return firstFault_; }  // of a damaged chunk

  std::size_t numFrames() const override { return frames_.timesUs.size(); }
  std::int64_t frameTimeUs(std::size_t frame) const override { return frames_.timesUs[frame]; }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    const std::size_t piece = frames_.pieceOf(frame);
    const std::shared_ptr<const McapBlock> block = blockOf(piece);
    const std::size_t at = frame - frames_.firsts[piece];
    requireThere(block->frameUs.size(), at, piece);
    const std::size_t cells = own_.layout().numCells();
    out.deviceUs.reset();
    if (block->deviceMs[at] != mcap_format::kNoDeviceTime)
      out.deviceUs = checkedUs(block->deviceMs[at]);
    const auto begin = block->values.begin() + static_cast<std::ptrdiff_t>(at * cells);
    out.values.assign(begin, begin + static_cast<std::ptrdiff_t>(cells));
    out.filtered.clear();
    if (block->filtered[at] == 0) return;
    out.filtered = out.values;
    const std::uint8_t* const kept = block->kept.data() + at * ((cells + 7) / 8);
    for (std::size_t k = 0; k < cells; ++k)
      if ((kept[k / 8] >> k % 8 & 1) == 0) out.values[k] = 0.0F;
  }
  std::size_t numSamples(std::size_t series) const override {
    return samples_[series].timesUs.size();
  }
  std::int64_t sampleTimeUs(std::size_t series, std::size_t sample) const override {
    return samples_[series].timesUs[sample];
  }
  Sample sample(std::size_t series, std::size_t sample) const override {
    const McapSeriesIndex& index = samples_[series];
    const std::size_t piece = index.pieceOf(sample);
    const std::shared_ptr<const McapBlock> block = blockOf(piece);
    const McapSamples& samples = block->samples[series];
    const std::size_t row = sample - index.firsts[piece];
    requireThere(samples.values.size() / index.width, row, piece);
    const auto begin = samples.values.begin() + static_cast<std::ptrdiff_t>(row * index.width);
    Sample read{
        index.timesUs[sample], {begin, begin + static_cast<std::ptrdiff_t>(index.width)}, series};
    if (series >= kHandSeries && samples.deviceUs[row] != mcap_format::kNoDeviceTime)
      read.deviceUs = samples.deviceUs[row];
    return read;
  }

 private:
  McapBlock readBlock(std::size_t piece) const {
    return readMcapBlock(file_, own_, pieces_, piece, salvage_);
  }

  // The file may be another one by now.
  void requireThere(std::size_t count, std::size_t at, std::size_t piece) const {
    if (at >= count)
      throw FormatError(file_.path(), "chunk " + std::to_string(piece) + " was changed");
  }

  void append(McapSeriesIndex& series,
              const std::vector<std::int64_t>& times,
              std::size_t width,
              const std::string& name,
              std::size_t piece) const {
    const auto fail = [&](const std::string& fault) {
      throw FormatError(file_.path(), "chunk " + std::to_string(piece) + ": " + name + " " + fault);
    };
    series.firsts.push_back(series.timesUs.size());
    if (width != 0 && series.width != 0 && width != series.width)
      fail("have a different number of values than before");
    if (width != 0) series.width = width;
    for (const std::int64_t timeUs : times) {
      if (timeUs < -kMcapLatestUs || timeUs > kMcapLatestUs ||
          (!series.timesUs.empty() && timeUs <= series.timesUs.back()))
        fail("don't ascend in time at sample " + std::to_string(series.timesUs.size()));
      series.timesUs.push_back(timeUs);
    }
  }

  void take(McapBlock& block, std::size_t piece) {
    // Images without a frame are those that frames before have taken.
    if (!salvage_ && block.leading > continued_)
      throw FormatError(file_.path(),
                        "chunk " + std::to_string(piece) +
                            " has images that belong to no frame: the file was changed by another "
                            "program, or is damaged");
    continued_ -= std::min(continued_, block.leading);
    continued_ += block.continued;
    append(frames_, block.frameUs, 0, "frames", piece);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const McapSamples& samples = block.samples[i];
      append(samples_[i], samples.timesUs, samples.width, own_.samplesText(i), piece);
    }
    anyFloat_ |= block.anyFloat;
    if (block.cutFrame) ++cutFrames_;
    events_.add(std::move(block.events));
  }

  // A block from the cache, or read now.
  std::shared_ptr<const McapBlock> blockOf(std::size_t piece) const {
    const std::lock_guard lock(mutex_);
    if (const auto* kept = cache_.find(piece)) return *kept;
    cache_.makeRoom(pieces_[piece].rawSize);  // of large chunks one at a time is in memory
    const bool isAhead = ahead_.valid() && aheadPiece_ == piece;
    auto block = std::make_shared<McapBlock>(isAhead ? ahead_.get() : readBlock(piece));
    block->events = {};
    lookAhead(piece);
    return cache_.add(piece, pieces_[piece].rawSize, std::move(block));
  }

  // Where pieces are read in order, begins to read the next one on another thread. What that throws
  // is thrown when the piece is asked for. The lock is held.
  void lookAhead(std::size_t piece) const {
    const std::size_t next = piece + 1;
    const bool inOrder = piece == std::exchange(nextPiece_, next);
    if (!looksAhead_ || !inOrder || next == pieces_.size() || cache_.find(next) ||
        pieces_[piece].rawSize + pieces_[next].rawSize > kSmallMcapPiecesBytes)
      return;
    try {
      ahead_ = std::async(std::launch::async, [this, next] { return readBlock(next); });
      aheadPiece_ = next;
    } catch (const std::system_error&) {
      // No thread: the piece is read when it is asked for.
    }
  }

  McapFile file_;
  McapOwnFile own_;
  std::vector<McapPiece> pieces_;
  bool salvage_ = false;
  McapSeriesIndex frames_;
  std::vector<McapSeriesIndex> samples_;  // by series
  McapEvents events_;
  std::size_t cutFrames_ = 0;
  std::string firstFault_;
  std::size_t continued_ = 0;  // images that frames have taken from chunks to come
  bool anyFloat_ = false;
  mutable std::mutex mutex_;
  mutable BlockCache<std::shared_ptr<const McapBlock>> cache_{kSmallMcapPiecesBytes,
                                                              kCachedMcapBlocks};
  bool looksAhead_ = false;
  mutable std::size_t nextPiece_ = 0;  // behind the one that was read last
  mutable std::size_t aheadPiece_ = 0;
  mutable std::future<McapBlock> ahead_;  // last: its end waits for the thread, which uses the rest
};

std::map<std::string, std::string> mcapRestored(const std::map<std::string, std::string>& texts) {
  std::map<std::string, std::string> restored;
  for (const auto& [key, value] : texts) restored[mcapRestoredText(key)] = mcapRestoredText(value);
  return restored;
}

// With the texts of the hand's files.
RecordingMeta mcapMetaOf(const McapStructure& structure) {
  RecordingMeta meta;
  const auto said = structure.metadata.find(mcap_format::kMetaRecord);
  if (said != structure.metadata.end()) meta = mcapRestored(said->second);
  const auto add = [&](const char* attachment, const char* key) {
    const auto found = structure.attachments.find(attachment);
    if (found != structure.attachments.end()) meta[key] = found->second;
  };
  add(mcap_format::kHandJson, "hand_json");
  add(mcap_format::kHandUrdf, "hand_urdf");
  return meta;
}

Provenance mcapProvenanceOf(const McapStructure& structure) {
  const auto about = mcapRestored(structure.metadata.at(mcap_format::kAboutRecord));
  const auto text = [&](const char* key) {
    const auto found = about.find(key);
    return found == about.end() ? std::string() : found->second;
  };
  return {text("program"),
          text("source_file"),
          text("source_sha256"),
          text("filters"),
          text("calibration"),
          text("hand")};
}

bool isOwnMcap(const McapStructure& structure) {
  return structure.metadata.contains(mcap_format::kAboutRecord);
}

Recording openOwnMcap(McapFile file,
                      McapStructure structure,
                      const Progress& progress,
                      std::size_t threads,
                      bool salvage) {
  const fs::path path = file.path();
  McapOwnFile own(path, structure);
  auto storage =
      std::make_shared<McapStorage>(std::move(file), std::move(own), std::move(structure.pieces));
  const std::size_t damaged = storage->scan(progress, threads, salvage);
  auto meta = mcapMetaOf(structure);
  ProfileInfo info = readInfo(meta, "mcap", storage->counts());
  HandDescription hand = recordedHand(meta,
                                      storage->own().layout(),
                                      storage->width(kAngleSeries),
                                      storage->width(kTemperatureSeries));
  std::vector<SeriesDescription> further = storage->own().further();
  std::string damage = structure.damage;
  if (damaged > 0)
    damage += (damage.empty() ? "has " : "; ") +
              mcapDamagedChunksText(damaged, storage->firstFault(), "samples");
  const std::size_t leftOut = storage->events().leftOut();
  std::vector<Event> events = storage->events().take();
  return {.profile = recordedProfile(
              path, std::move(info), std::move(hand), std::move(storage), std::move(further)),
          .events = std::move(events),
          .meta = std::move(meta),
          .provenance = mcapProvenanceOf(structure),
          .damage = {.text = std::move(damage), .events = leftOut}};
}

Recording openMcap(const fs::path& path,
                   const std::vector<std::string>& topics,
                   const Progress& progress,
                   std::size_t threads,
                   bool salvage) {
  constexpr double kWalk = 0.3;  // share of the time
  McapFile file(path);
  McapStructure structure = readMcapStructure(file, true, partOf(progress, 0.0, kWalk));
  if (!structure.damage.empty() && !salvage) {
    // Names the chunk that is damaged, if it is one.
    if (structure.checksumWrong)
      for (std::size_t i = 0; i < structure.pieces.size(); ++i)
        readMcapPiece(file, structure.pieces[i], i);
    throw FormatError(path, structure.damage + "; 'palpate recover' saves what can be read");
  }
  if (isOwnMcap(structure) && !topics.empty())
    throw FileError(path,
                    "is a recording of Palpate's, which is read as a whole: leave out --topic");
  if (isOwnMcap(structure))
    return openOwnMcap(
        std::move(file), std::move(structure), partOf(progress, kWalk, 1.0), threads, salvage);
  return readForeignMcap(
      std::move(file), std::move(structure), topics, partOf(progress, kWalk, 1.0), salvage);
}

}  // namespace

Recording readMcap(const fs::path& path,
                   const Progress& progress,
                   std::size_t threads,
                   const std::vector<std::string>& topics) {
  return openMcap(path, topics, progress, threads, false);
}

Recording recoverMcap(const fs::path& path,
                      const Progress& progress,
                      std::size_t threads,
                      const std::vector<std::string>& topics) {
  return openMcap(path, topics, progress, threads, true);
}

std::string mcapEventsLeftOutText(std::size_t count) {
  return counted(count, "event") + " beyond the " + std::to_string(kMaxMcapEventsBytes >> 20) +
         " MB that are read " + (count == 1 ? "was" : "were") + " left out";
}

EventsReport readMcapEvents(const fs::path& path) {
  const McapFile file(path);
  const McapStructure structure = readMcapStructure(file, false);
  if (!structure.damage.empty())
    throw FormatError(path, structure.damage + "; 'palpate recover' saves what can be read");
  if (!isOwnMcap(structure)) return {};
  const McapOwnFile own(path, structure);
  McapEvents events;
  for (std::size_t i = 0; i < structure.pieces.size(); ++i) {
    const McapPiece& piece = structure.pieces[i];
    if (!piece.indexed.empty() && own.eventChannel() &&
        std::find(piece.indexed.begin(), piece.indexed.end(), *own.eventChannel()) ==
            piece.indexed.end())
      continue;
    McapBlock block = readMcapBlock(file, own, structure.pieces, i, false);
    events.add(std::move(block.events));
  }
  return {events.take(), events.leftOut()};
}

RecordingMeta readMcapMeta(const fs::path& path) {
  const McapFile file(path);
  const McapStructure structure = readMcapStructure(file, false);
  if (!structure.damage.empty())
    throw FormatError(path, structure.damage + "; 'palpate recover' saves what can be read");
  return mcapMetaOf(structure);
}

}  // namespace palpate
