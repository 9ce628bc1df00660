#include "recording/mcap/mcap_foreign.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/model/frame_coding.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile.h"
#include "palpate/recording/palpate_schema.h"
#include "palpate/recording/recording.h"

#include "recording/block_cache.h"
#include "recording/mcap/mcap_format.h"
#include "recording/mcap/mcap_messages.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kForeignMessages = 50'000'000;
// Unpacked chunks that are kept: those of topics that are written to chunks of their own.
constexpr std::uint64_t kKeptForeignBytes = 64u << 20;
// What an empty chunk takes of them.
constexpr std::uint64_t kKeptForeignPieceBytes = 64;
// Chunks that have to be unpacked again while frames are read in order, in bytes: this, or four
// times all chunks.
constexpr std::uint64_t kForeignUnpackedAgain = 512u << 20;

// Where a message is.
struct ForeignPlace {
  std::int64_t timeUs = 0;
  std::int64_t logUs = 0;
  std::uint32_t piece = 0;
  std::uint32_t offset = 0;  // of its data in the records of the piece
  std::uint32_t size = 0;
  std::uint16_t series = 0;
};

// The unpacked chunks of a file, of which the latest used are kept. Not thread-safe.
class ForeignChunks {
 public:
  using Records = std::shared_ptr<const std::string>;
  ForeignChunks(McapFile file, std::vector<McapPiece> pieces, bool salvage)
      : file_(std::move(file)),
        pieces_(std::move(pieces)),
        salvage_(salvage),
        bad_(pieces_.size()) {}

  const fs::path& path() const { return file_.path(); }
  std::size_t size() const { return pieces_.size(); }
  std::size_t numBad() const { return numBad_; }
  const std::string& firstFault() const { return firstFault_; }

  // Records of a piece; nothing of a damaged one in a salvage.
  Records of(std::size_t piece) {
    if (bad_[piece]) return nullptr;
    if (const Records* kept = kept_.find(piece)) return *kept;
    kept_.makeRoom(keptBytesOf(piece));
    try {
      return kept_.add(
          piece,
          keptBytesOf(piece),
          std::make_shared<const std::string>(readMcapPiece(file_, pieces_[piece], piece)));
    } catch (const Error& error) {
      if (!salvage_ || !dynamic_cast<const FormatError*>(&error)) throw;
      bad_[piece] = true;
      if (numBad_++ == 0) firstFault_ = mcapFaultOf(path(), error);
      return nullptr;
    }
  }

  // Throws FormatError where messages in this order can't be read in a bearable time; Cancelled.
  void requireOrder(const std::vector<ForeignPlace>& places, const Progress& progress) {
    constexpr std::size_t kPlacesPerReport = 1u << 16;
    std::uint64_t all = 0;
    for (const McapPiece& piece : pieces_) all += piece.rawSize;
    std::uint64_t again = 0;
    kept_.clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (progress && i % kPlacesPerReport == 0 && !progress(1.0)) throw Cancelled();
      const std::size_t piece = places[i].piece;
      if (kept_.find(piece)) continue;
      kept_.add(piece, keptBytesOf(piece), nullptr);
      again += pieces_[piece].rawSize;
    }
    kept_.clear();
    if (again > std::max(kForeignUnpackedAgain, 4 * all))
      throw FormatError(path(),
                        "has its messages in too many chunks at a time to be read in order; "
                        "rewrite it with 'mcap sort'");
  }

 private:
  std::uint64_t keptBytesOf(std::size_t piece) const {
    return pieces_[piece].rawSize + kKeptForeignPieceBytes;
  }

  McapFile file_;
  std::vector<McapPiece> pieces_;
  bool salvage_ = false;
  std::vector<bool> bad_;
  std::size_t numBad_ = 0;
  std::string firstFault_;  // of a damaged piece
  BlockCache<Records> kept_{kKeptForeignBytes};
};

// What a message of joints says; positions in rad or m.
struct ForeignJoints {
  std::int64_t timeUs = 0;
  std::vector<std::string> names;  // may be empty
  std::vector<double> positions;
};

// Nothing of a damaged message.
std::optional<ForeignJoints> foreignJoints(std::string_view message) {
  constexpr std::size_t kMaxJoints = 1024;
  CdrReader reader(message);
  ForeignJoints joints;
  joints.timeUs = reader.time();
  reader.text();  // frame_id
  joints.names = reader.texts(kMaxJoints);
  joints.positions = reader.doubles(kMaxJoints);
  if (!reader.ok()) return std::nullopt;
  return joints;
}

std::optional<McapImage> foreignImage(std::string_view message, bool isRawImage) {
  return isRawImage ? readRawImage(message) : readRosImage(message);
}

// Puts 0 where a value is not a number. Returns how often.
std::size_t zeroNotNumbers(std::span<float> values) {
  std::size_t count = 0;
  for (float& value : values)
    if (!std::isfinite(value)) {
      value = 0.0F;
      ++count;
    }
  return count;
}

// Where the messages of a series go.
struct ForeignTarget {
  std::optional<std::size_t> matrix = {};  // of images
  bool isRawImage = false;                 // foxglove.RawImage
  bool isJoints = false;                   // neither: they are not used
};

// The columns of the angles.
struct ForeignAngles {
  std::map<std::string, std::size_t, std::less<>> columnOf;  // by name; empty: by position
  std::vector<double> unitsPerSi;                            // [deg/rad] or [mm/m]
};

// Frames and angles as they are asked for.
class ForeignStorage final : public ProfileStorage {
 public:
  // `places`: in order of time. `targets`: by series.
  ForeignStorage(ForeignChunks chunks,
                 std::shared_ptr<const SensorLayout> layout,
                 std::vector<ForeignPlace> places,
                 std::vector<ForeignTarget> targets,
                 ForeignAngles columns)
      : chunks_(std::move(chunks)),
        layout_(std::move(layout)),
        places_(std::move(places)),
        targets_(std::move(targets)),
        columns_(std::move(columns)),
        images_(layout_->numMatrices()),
        shown_(layout_->numMatrices()),
        values_(layout_->numCells()) {
    const auto numSets = std::count_if(
        targets_.begin(), targets_.end(), [](const ForeignTarget& each) { return each.isJoints; });
    std::map<std::uint16_t, std::size_t> sets;  // of joints, by series
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto at = static_cast<std::uint32_t>(i);
      const ForeignTarget& target = targets_[places_[i].series];
      if (target.matrix) {
        images_[*target.matrix].push_back(at);
        addSample(frames_, at);
      } else if (target.isJoints) {
        const auto set = sets.emplace(places_[i].series, sets.size()).first->second;
        if (set == joints_.size()) joints_.emplace_back();
        joints_[set].push_back(at);
        if (static_cast<std::ptrdiff_t>(sets.size()) == numSets)
          addSample(angles_, at);
        else
          ++numEarly_;
      }
    }
  }

  // Messages of joints before the first one of each joint: no angles are made of them.
  std::size_t numEarly() const { return numEarly_; }

  std::size_t numFrames() const override { return frames_.size(); }
  std::int64_t frameTimeUs(std::size_t frame) const override {
    return places_[frames_[frame]].timeUs;
  }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    const std::lock_guard lock(mutex_);
    for (std::size_t m = 0; m < images_.size(); ++m) show(m, frames_[frame]);
    out.deviceUs.reset();
    out.filtered.clear();
    out.values = values_;
  }
  std::size_t numSamples(std::size_t series) const override {
    return series == kAngleSeries ? angles_.size() : 0;
  }
  std::int64_t sampleTimeUs(std::size_t, std::size_t sample) const override {
    return places_[angles_[sample]].timeUs;
  }
  Sample sample(std::size_t series, std::size_t sample) const override {
    const std::lock_guard lock(mutex_);
    std::vector<std::uint32_t> latest;  // of each set of joints
    for (const std::vector<std::uint32_t>& set : joints_) {
      const auto behind = std::upper_bound(set.begin(), set.end(), angles_[sample]);
      if (behind != set.begin()) latest.push_back(*std::prev(behind));
    }
    std::sort(latest.begin(), latest.end());
    Sample result{sampleTimeUs(series, sample), std::vector<double>(columns_.unitsPerSi.size())};
    for (const std::uint32_t at : latest) takeAngles(places_[at], result.values);
    return result;
  }

 private:
  [[noreturn]] void throwChanged() const {
    throw FormatError(chunks_.path(), "was changed while it was read");
  }
  std::string_view dataOf(const ForeignChunks::Records& records, const ForeignPlace& place) const {
    if (!records || place.offset > records->size() || place.size > records->size() - place.offset)
      throwChanged();
    return std::string_view(*records).substr(place.offset, place.size);
  }

  // Messages of one stamp are one sample.
  void addSample(std::vector<std::uint32_t>& samples, std::uint32_t at) const {
    if (samples.empty() || places_[samples.back()].timeUs != places_[at].timeUs)
      samples.push_back(at);
    else
      samples.back() = at;
  }

  void takeAngles(const ForeignPlace& place, std::vector<double>& angles) const {
    const auto records = chunks_.of(place.piece);
    const auto joints = foreignJoints(dataOf(records, place));
    if (!joints || (!joints->names.empty() && joints->names.size() != joints->positions.size()))
      throwChanged();
    for (std::size_t i = 0; i < joints->positions.size(); ++i) {
      std::size_t column = i;
      if (!joints->names.empty()) {
        const auto found = columns_.columnOf.find(joints->names[i]);
        if (found == columns_.columnOf.end()) continue;
        column = found->second;
      }
      if (column >= angles.size()) throwChanged();
      angles[column] = joints->positions[i] * columns_.unitsPerSi[column];
    }
  }

  // Puts the last image of a matrix that is not behind a place into `values_`.
  void show(std::size_t matrix, std::uint32_t last) const {
    const std::vector<std::uint32_t>& images = images_[matrix];
    const auto behind = std::upper_bound(images.begin(), images.end(), last);
    const std::size_t offset = layout_->offset(matrix);
    const std::size_t cells = layout_->matrix(matrix).numCells();
    if (behind == images.begin()) {
      std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(offset), cells, 0.0F);
      shown_[matrix].reset();
      return;
    }
    const std::uint32_t at = *std::prev(behind);
    if (shown_[matrix] == at) return;
    const ForeignPlace& place = places_[at];
    const auto records = chunks_.of(place.piece);
    const auto image = foreignImage(dataOf(records, place), targets_[place.series].isRawImage);
    if (!image || std::size_t{image->rows} * image->columns != cells) throwChanged();
    mcapPixels(*image, values_.data() + offset);
    zeroNotNumbers(std::span(values_).subspan(offset, cells));
    shown_[matrix] = at;
  }

  mutable std::mutex mutex_;
  mutable ForeignChunks chunks_;
  std::shared_ptr<const SensorLayout> layout_;
  std::vector<ForeignPlace> places_;
  std::vector<ForeignTarget> targets_;
  ForeignAngles columns_;
  std::vector<std::vector<std::uint32_t>> images_;           // places, by matrix
  std::vector<std::vector<std::uint32_t>> joints_;           // places, by set of joints
  std::vector<std::uint32_t> frames_;                        // the last place of each
  std::vector<std::uint32_t> angles_;                        // the last place of each
  std::size_t numEarly_ = 0;                                 // of joints
  mutable std::vector<std::optional<std::uint32_t>> shown_;  // place of each matrix in `values_`
  mutable std::vector<float> values_;
};

// A topic of images or joints.
struct ForeignTopic {
  std::string name;
  bool isJoints = false;
  bool isRawImage = false;
  std::string unusable = {};  // why the topic is left out as a whole
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  bool isBytes = true;           // of images: 8 bits per pixel
  bool hasManyIds = false;       // more than are told apart
  std::size_t messages = 0;      // that are used
  std::size_t leftOut = 0;       // messages that are not
  std::string firstReason = {};  // why the first of those is not
  std::string unfit = {};        // why an image can't be a matrix: the first that can't
  std::size_t notNumbers = 0;    // values that are 0 instead
};

// The images of a topic, or the messages about one set of joints, of one publisher until others are
// put behind it (joinPublishers()).
struct ForeignSeries {
  std::size_t topic = 0;
  std::uint16_t channel = 0;
  std::string frameId = {};           // of images
  std::set<std::string> joints = {};  // their names
  std::int64_t firstUs = 0;
  std::int64_t lastUs = 0;
  std::int64_t lastLogUs = 0;
  bool begun = false;
  bool logsAscend = true;
  std::size_t notLater = 0;  // messages whose stamp is not behind the one before
};

class ForeignReader {
 public:
  ForeignReader(McapFile file,
                McapStructure structure,
                const std::vector<std::string>& chosen,
                const Progress& progress,
                bool salvage)
      : chunks_(std::move(file), std::move(structure.pieces), salvage),
        channels_(std::move(structure.channels)),
        damage_(std::move(structure.damage)),
        chosen_(chosen),
        progress_(progress),
        salvage_(salvage) {}

  Recording read() {
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
      reportProgress(progress_, i, chunks_.size());
      findIn(i);
    }
    if (chunks_.numBad() > 0)
      damage_ += (damage_.empty() ? "has " : "; ") +
                 mcapDamagedChunksText(chunks_.numBad(), chunks_.firstFault(), "messages");
    limitJoints();
    findUnfitTopics();
    requireChosen();
    requireImages();
    joinPublishers();
    useOneClock();
    orderByTime();
    return built();
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw FormatError(chunks_.path(), fault);
  }

  void note(std::string text) { notes_.push_back(std::move(text)); }

  // Counts a message of a topic that is not used.
  static void leaveOut(ForeignTopic& topic, const std::string& reason) {
    if (topic.leftOut++ == 0) topic.firstReason = reason;
  }

  // The topic of a channel: its number, or nothing where its messages are of another kind.
  std::optional<std::size_t> topicOf(std::uint16_t id) {
    const auto known = topicOfChannel_.find(id);
    if (known != topicOfChannel_.end()) return known->second;
    const auto channel = channels_.channels.find(id);
    if (channel == channels_.channels.end()) return std::nullopt;
    return topicOfChannel_[id] = newTopicOf(channel->second);
  }

  std::optional<std::size_t> newTopicOf(const McapChannel& channel) {
    if (!isChosen(channel.topic)) return std::nullopt;
    const std::string name = schemaOf(channel);
    const bool isRawImage = name == "foxglove.RawImage";
    const bool isImage = name == "sensor_msgs/msg/Image" || name == "sensor_msgs/Image";
    const bool isJoints = name == "sensor_msgs/msg/JointState" || name == "sensor_msgs/JointState";
    if (!isRawImage && !isImage && !isJoints) return std::nullopt;
    // Several channels of a topic (publishers) are one.
    const auto [same, isNew] = topicOfName_.emplace(channel.topic + '\n' + name, topics_.size());
    if (!isNew) return same->second;
    ForeignTopic topic{.name = channel.topic, .isJoints = isJoints, .isRawImage = isRawImage};
    const char* const read = isRawImage ? "protobuf" : "cdr";
    if (channel.encoding != read)
      topic.unusable = "its messages have the encoding " + inQuotes(channel.encoding) + " (only " +
                       read + (isRawImage ? "" : ", of ROS 2,") + " is read)";
    else if (isJoints && joints_)
      topic.unusable = "the angles are those of " + inQuotes(topics_[*joints_].name) +
                       " (--topic chooses topics)";
    else if (isJoints)
      joints_ = topics_.size();
    topics_.push_back(std::move(topic));
    return topics_.size() - 1;
  }

  bool isChosen(const std::string& topic) const {
    return chosen_.empty() || std::find(chosen_.begin(), chosen_.end(), topic) != chosen_.end();
  }

  std::string schemaOf(const McapChannel& channel) const {
    const auto schema = channels_.schemas.find(channel.schema);
    return schema == channels_.schemas.end() ? std::string() : schema->second.name;
  }

  void findIn(std::size_t piece) {
    const auto records = chunks_.of(piece);
    if (!records) return;
    const bool whole =
        forEachMcapRecord(*records, [&](std::uint8_t opcode, std::string_view content) {
          if (opcode == mcap_format::kSchema || opcode == mcap_format::kChannel) {
            const std::string fault = channels_.add(opcode, content);
            if (!fault.empty()) fail(fault + " in chunk " + std::to_string(piece));
            return;
          }
          McapMessage message;
          if (opcode != mcap_format::kMessage) return;
          if (!readMcapMessage(content, message))
            fail("chunk " + std::to_string(piece) + " has a damaged message");
          const auto topic = topicOf(message.channel);
          if (!topic || !topics_[*topic].unusable.empty()) return;
          if (topics_[*topic].isJoints)
            addJoints(*topic, message, piece, *records);
          else
            addImage(*topic, message, piece, *records);
        });
    if (!whole) fail("chunk " + std::to_string(piece) + " is damaged: its records don't fit");
  }

  void addImage(std::size_t index,
                const McapMessage& message,
                std::size_t piece,
                const std::string& records) {
    ForeignTopic& topic = topics_[index];
    const auto image = foreignImage(message.data, topic.isRawImage);
    if (!image) return leaveOut(topic, "a damaged image");
    const std::string fault = faultOf(*image);
    const bool isFirst = topic.messages == 0;
    if (!fault.empty()) {
      if (topic.unfit.empty()) topic.unfit = fault;
      return leaveOut(topic, fault);
    }
    if (!isFirst && (image->rows != topic.rows || image->columns != topic.columns))
      return leaveOut(topic,
                      "the size of its images changes from " + sizeText(topic.rows, topic.columns) +
                          " to " + sizeText(image->rows, image->columns) + " pixels");
    if (isFirst) {
      if (imageSeries_.size() == kMaxMatrices)
        fail("has more than " + std::to_string(kMaxMatrices) +
             " topics of images; choose some with --topic");
      imageSeries_[index] = seriesOf(index, message.channel, std::string(image->frameId), {});
    }
    topic.rows = image->rows;
    topic.columns = image->columns;
    topic.isBytes &= mcapPixelBytes(image->encoding) == 1;
    takePixels(*image, topic);
    addPlace(seriesOf(index, message.channel, std::string(image->frameId), {}),
             image->timeUs,
             message,
             piece,
             records);
  }

  // Leaves out topics without an image that could be a matrix: those of cameras.
  void findUnfitTopics() {
    for (ForeignTopic& topic : topics_)
      if (topic.messages == 0 && topic.unusable.empty()) topic.unusable = topic.unfit;
  }

  // Why an image can't be a matrix, or an empty text.
  static std::string faultOf(const McapImage& image) {
    if (mcapPixelBytes(image.encoding) == 0)
      return "its images have the encoding " + inQuotes(image.encoding) +
             " (mono8, mono16, 8UC1, 16UC1 and 32FC1 are read)";
    if (image.rows < 1 || image.rows > 256 || image.columns < 1 || image.columns > 256)
      return "its images have " + sizeText(image.rows, image.columns) +
             " pixels (a matrix has at most 256 x 256 taxels)";
    return "";
  }
  static std::string sizeText(std::uint32_t rows, std::uint32_t columns) {
    return std::to_string(columns) + " x " + std::to_string(rows);
  }

  void takePixels(const McapImage& image, ForeignTopic& topic) {
    pixels_.resize(std::size_t{image.rows} * image.columns);
    mcapPixels(image, pixels_.data());
    topic.notNumbers += zeroNotNumbers(pixels_);
    for (const float value : pixels_) largest_ = std::max(largest_, value);
    allCounts_ = allCounts_ && codingFor(std::span<const float>(pixels_)) == FrameCoding::kCounts;
  }

  void addJoints(std::size_t index,
                 const McapMessage& message,
                 std::size_t piece,
                 const std::string& records) {
    ForeignTopic& topic = topics_[index];
    const auto joints = foreignJoints(message.data);
    if (!joints) return leaveOut(topic, "a damaged message");
    if (joints->positions.empty()) return;  // speeds and torques are not read
    const std::string fault = faultOf(*joints);
    if (!fault.empty()) return leaveOut(topic, fault);
    if (joints->names != lastJoints_ || message.channel != lastJointChannel_ ||
        jointSeries_.empty()) {
      const std::set<std::string> names(joints->names.begin(), joints->names.end());
      if (names.contains("")) return leaveOut(topic, "a joint has no name");
      if (names.size() != joints->names.size()) return leaveOut(topic, "a joint is named twice");
      lastJointSeries_ = seriesOf(index, message.channel, {}, names);
      if (jointSeries_.emplace(names, lastJointSeries_).second) {
        for (const std::string& name : joints->names)
          if (std::find(jointNames_.begin(), jointNames_.end(), name) == jointNames_.end())
            jointNames_.push_back(name);
        if (names.empty()) numUnnamed_ = joints->positions.size();
        if (jointNames_.size() > kMaxSampleValues || numUnnamed_ > kMaxSampleValues ||
            jointSeries_.size() > kMaxSampleValues) {
          topic.unusable = "it has more than " + std::to_string(kMaxSampleValues) + " joints";
          return;
        }
      }
      lastJoints_ = joints->names;
      lastJointChannel_ = message.channel;
    }
    addPlace(lastJointSeries_, joints->timeUs, message, piece, records);
  }

  // Why a message of joints can't be used, or an empty text.
  std::string faultOf(const ForeignJoints& joints) const {
    const std::size_t size = joints.positions.size();
    if (!joints.names.empty() && joints.names.size() != size)
      return counted(joints.names.size(), "name") + " for " + counted(size, "position");
    if (!std::all_of(joints.positions.begin(), joints.positions.end(), [](double position) {
          return std::isfinite(position);
        }))
      return "a position that is not a number";
    if (jointSeries_.empty()) return "";
    if (joints.names.empty() != jointNames_.empty())
      return "positions with names and without names";
    if (joints.names.empty() && size != numUnnamed_)
      return "the number of positions without names changes";
    return "";
  }

  // The messages of a publisher: those of a channel with one frame_id. Of more publishers than
  // anybody has, the rest count as the first one.
  std::uint16_t seriesOf(std::size_t topic,
                         std::uint16_t channel,
                         std::string frameId,
                         const std::set<std::string>& joints) {
    constexpr std::size_t kMaxForeignSeries = 4096;
    const auto same = [&](const ForeignSeries& each) {
      return each.topic == topic && each.channel == channel && each.frameId == frameId &&
             each.joints == joints;
    };
    if (lastSeries_ < series_.size() && same(series_[lastSeries_])) return lastSeries_;
    auto found = std::find_if(series_.begin(), series_.end(), same);
    if (found == series_.end() && series_.size() >= kMaxForeignSeries) {
      topics_[topic].hasManyIds = true;
      found = std::find_if(series_.begin(), series_.end(), [&](const ForeignSeries& each) {
        return each.topic == topic && each.joints == joints;
      });
    }
    if (found == series_.end()) {
      series_.push_back(
          {.topic = topic, .channel = channel, .frameId = std::move(frameId), .joints = joints});
      found = std::prev(series_.end());
    }
    return lastSeries_ = static_cast<std::uint16_t>(found - series_.begin());
  }

  // Publishers of one topic after each other are one series. Of those at the same time only the
  // first one is read: nobody could tell their messages apart.
  void joinPublishers() {
    std::vector<std::uint16_t> joined(series_.size());  // the series of each
    std::vector<bool> isLeftOut(series_.size());
    for (std::size_t s = 0; s < series_.size(); ++s) {
      joined[s] = static_cast<std::uint16_t>(s);
      for (std::size_t first = 0; first < s && series_[s].begun; ++first) {
        ForeignSeries& before = series_[first];
        if (joined[first] != first || isLeftOut[first] || !before.begun ||
            before.topic != series_[s].topic || !sharesJoints(before, series_[s]) ||
            (before.channel == series_[s].channel && !before.joints.empty()))
          continue;
        const bool isCounted =  // a frame_id that counts the messages
            topics_[before.topic].hasManyIds && before.channel == series_[s].channel;
        isLeftOut[s] = series_[s].firstUs <= before.lastUs && !isCounted;
        if (isLeftOut[s]) break;
        if (before.joints != series_[s].joints) continue;
        joined[s] = static_cast<std::uint16_t>(first);
        before.lastUs = std::max(before.lastUs, series_[s].lastUs);
        before.lastLogUs = series_[s].lastLogUs;
        before.logsAscend = before.logsAscend && series_[s].logsAscend;
        before.notLater += series_[s].notLater;
        break;
      }
    }
    std::erase_if(places_, [&](const ForeignPlace& place) {
      const ForeignSeries& series = series_[place.series];
      if (!isLeftOut[place.series]) return false;
      --topics_[series.topic].messages;
      leaveOut(topics_[series.topic], otherPublisherText(place.series));
      return true;
    });
    for (ForeignPlace& place : places_) place.series = joined[place.series];
    for (std::size_t s = 0; s < series_.size(); ++s)
      if (isLeftOut[s] || joined[s] != s) series_[s] = {.topic = series_[s].topic};
    std::erase_if(jointSeries_, [&](const auto& set) { return isLeftOut[set.second]; });
    if (std::find(isLeftOut.begin(), isLeftOut.end(), true) != isLeftOut.end())
      std::erase_if(jointNames_, [&](const std::string& name) {
        return std::none_of(jointSeries_.begin(), jointSeries_.end(), [&](const auto& set) {
          return set.first.contains(name);
        });
      });
  }

  static bool sharesJoints(const ForeignSeries& a, const ForeignSeries& b) {
    return (a.joints.empty() && b.joints.empty()) ||
           std::any_of(a.joints.begin(), a.joints.end(), [&](const std::string& name) {
             return b.joints.contains(name);
           });
  }

  std::string otherPublisherText(std::size_t series) const {
    const ForeignSeries& left = series_[series];
    return "it is from another publisher, channel " + std::to_string(left.channel) +
           (left.frameId.empty() ? "" : ", frame_id " + inQuotes(left.frameId));
  }

  // Where the stamps of one topic are of another clock than those of another, as one that counts
  // from the start of a computer, all times are the log times.
  void useOneClock() {
    constexpr std::int64_t kMaxApartUs = 86'400'000'000;
    std::optional<std::int64_t> least;
    std::optional<std::int64_t> most;
    std::string names;
    for (const ForeignSeries& series : series_) {
      if (!series.begun) continue;
      const std::int64_t ahead = series.lastUs - series.lastLogUs;
      if (!least || ahead < *least) least = ahead;
      if (!most || ahead > *most) most = ahead;
    }
    if (!least || *most - *least <= kMaxApartUs) return;
    for (const ForeignSeries& series : series_)
      if (series.begun && std::abs(series.lastUs - series.lastLogUs) > kMaxApartUs)
        names += (names.empty() ? "" : ", ") + inQuotes(topics_[series.topic].name);
    for (ForeignPlace& place : places_) place.timeUs = place.logUs;
    for (ForeignSeries& series : series_) series.notLater = 0;
    usesLogTimes_ = true;
    note("the stamps of the topic " + names +
         " are from another clock: all times are the file's log times instead");
  }

  void addPlace(std::uint16_t index,
                std::int64_t stampUs,
                const McapMessage& message,
                std::size_t piece,
                const std::string& records) {
    ForeignSeries& series = series_[index];
    const auto logUs = static_cast<std::int64_t>(message.logNs / 1000);
    // A message without a stamp has that of its record.
    const std::int64_t timeUs = stampUs == 0 ? logUs : stampUs;
    if (!series.begun) series.firstUs = timeUs;
    if (series.begun && timeUs <= series.lastUs) ++series.notLater;
    if (series.begun && logUs <= series.lastLogUs) series.logsAscend = false;
    series.lastUs = timeUs;
    series.lastLogUs = logUs;
    series.begun = true;
    ++topics_[series.topic].messages;
    if (places_.size() == kForeignMessages) fail("has too many messages");
    places_.push_back({timeUs,
                       logUs,
                       static_cast<std::uint32_t>(piece),
                       static_cast<std::uint32_t>(message.data.data() - records.data()),
                       static_cast<std::uint32_t>(message.data.size()),
                       index});
  }

  // Takes back the messages of a topic that turned out to have too many joints.
  void limitJoints() {
    if (!joints_ || topics_[*joints_].unusable.empty()) return;
    std::erase_if(places_, [&](const ForeignPlace& place) {
      return series_[place.series].topic == *joints_;
    });
    for (ForeignSeries& series : series_)
      if (series.topic == *joints_) series = {.topic = *joints_};
    topics_[*joints_].messages = 0;
    jointSeries_.clear();
    jointNames_.clear();
    numUnnamed_ = 0;
  }

  // The topics of the file with what their messages are.
  std::string topicsText() const {
    constexpr std::size_t kMaxListed = 8;
    std::map<std::string, std::string> texts;
    for (const auto& [id, channel] : channels_.channels)
      texts.emplace(channel.topic,
                    shortened(schemaOf(channel)) + ", " + shortened(channel.encoding));
    for (const ForeignTopic& topic : topics_)
      if (!topic.unusable.empty() || !topic.firstReason.empty())
        texts[topic.name] = topic.unusable.empty() ? topic.firstReason : topic.unusable;
    if (texts.empty()) return "it has no topics";
    std::string list;
    std::size_t listed = 0;
    for (const auto& [topic, text] : texts)
      if (listed++ < kMaxListed) list += (list.empty() ? "" : "; ") + inQuotes(topic) + ": " + text;
    return "its topics: " + list +
           (listed > kMaxListed ? "; and " + std::to_string(listed - kMaxListed) + " more" : "");
  }

  std::string afterDamage() const { return damage_.empty() ? "" : damage_ + "; before that it "; }

  // All topics that were asked for must be usable.
  void requireChosen() const {
    for (const std::string& name : chosen_) {
      const auto topic = std::find_if(
          topics_.begin(), topics_.end(), [&](const auto& each) { return each.name == name; });
      if (topic == topics_.end())
        fail(afterDamage() + "has no topic " + inQuotes(name) + " with images or joint states; " +
             topicsText());
      if (!topic->unusable.empty())
        fail("the topic " + inQuotes(name) + " can't be read: " + topic->unusable);
    }
  }

  void requireImages() const {
    if (!imageSeries_.empty()) return;
    fail(afterDamage() +
         "has no images that could be matrices (sensor_msgs/msg/Image in cdr or foxglove.RawImage, "
         "at most 256 x 256); " +
         topicsText());
  }

  // By the stamps of the headers. Where these don't ascend, by the log times; where those don't,
  // either, the messages are sorted, and of those of one stamp the first is taken.
  void orderByTime() {
    const bool stampsAscend = std::all_of(
        series_.begin(), series_.end(), [](const auto& each) { return each.notLater == 0; });
    const bool logsAscend = std::all_of(
        series_.begin(), series_.end(), [](const auto& each) { return each.logsAscend; });
    if (!stampsAscend && logsAscend) {
      for (ForeignPlace& place : places_) place.timeUs = place.logUs;
      for (const ForeignSeries& series : series_)
        if (series.notLater > 0)
          note(counted(series.notLater, "stamp") + " of the topic " +
               inQuotes(topics_[series.topic].name) +
               (series.notLater == 1 ? " repeats or comes" : " repeat or come") +
               " late: all times are the file's log times instead");
    }
    std::stable_sort(places_.begin(), places_.end(), [](const auto& a, const auto& b) {
      return a.timeUs < b.timeUs;
    });
    if (logsAscend || (stampsAscend && !usesLogTimes_)) return;
    for (const ForeignSeries& series : series_)
      if (series.notLater > 0)
        note("stamps of the topic " + inQuotes(topics_[series.topic].name) +
             " repeat or come late: its messages are sorted by them");
    std::vector<std::optional<std::int64_t>> last(series_.size());
    std::erase_if(places_, [&](const ForeignPlace& place) {
      if (std::exchange(last[place.series], place.timeUs) != place.timeUs) return false;
      leaveOut(topics_[series_[place.series].topic], "its stamp is that of another message");
      return true;
    });
  }

  // Topics of images, in the order of their names.
  std::vector<std::size_t> matrixTopics() const {
    std::vector<std::size_t> order;
    for (const auto& [topic, series] : imageSeries_) order.push_back(topic);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return topics_[a].name < topics_[b].name;
    });
    return order;
  }

  // Takes the joints in the order of the hand's axes, by the names of the axes or of the URDF's
  // joints. Returns false, and changes nothing, where an axis isn't found.
  bool takeAxes(const HandDescription& hand) {
    std::vector<std::string> ordered;
    for (std::size_t axis = 0; axis < hand.axes.size(); ++axis) {
      std::vector<std::string> known{hand.axes[axis].name};
      if (axis < hand.file->axisJoints.size())
        known.insert(
            known.end(), hand.file->axisJoints[axis].begin(), hand.file->axisJoints[axis].end());
      const auto found =
          std::find_first_of(jointNames_.begin(), jointNames_.end(), known.begin(), known.end());
      if (found == jointNames_.end()) return false;
      ordered.push_back(*found);
    }
    jointNames_ = std::move(ordered);
    return true;
  }

  HandDescription handOf(const std::shared_ptr<const SensorLayout>& layout,
                         const std::vector<std::size_t>& order) {
    HandDescription hand = describeHand(*layout, 0, 0);
    hand.layout = layout;
    if (hand.file && !hand.axes.empty() && takeAxes(hand)) return hand;
    const std::size_t numAngles = std::max(jointNames_.size(), numUnnamed_);
    const bool sameNumber = numAngles == hand.axes.size();
    hand = withSeriesOf(std::move(hand), numAngles, 0);
    if (hand.file && sameNumber && !jointNames_.empty())
      note("the joints are taken for the axes of " + hand.name +
           " in the order of the file, since their names differ");
    if (!hand.file || !sameNumber)
      for (std::size_t i = 0; i < hand.axes.size() && i < jointNames_.size(); ++i)
        hand.axes[i].name = jointNames_[i];
    if (hand.file) return hand;  // a hand of these sizes is known
    for (std::size_t m = 0; m < order.size(); ++m)
      hand.matrices[m].name = hand.matrices[m].shortName = topics_[order[m]].name;
    const bool bytes =
        std::all_of(order.begin(), order.end(), [&](std::size_t i) { return topics_[i].isBytes; });
    constexpr float kMaxByte = 255.0F;
    hand.maximumCounts = bytes ? kMaxByte : std::max(hand.maximumCounts, std::ceil(largest_));
    hand.saturationCounts = hand.maximumCounts;
    return hand;
  }

  std::vector<ForeignTarget> targetsOf(const std::vector<std::size_t>& order) const {
    std::vector<ForeignTarget> targets(series_.size());
    for (std::size_t m = 0; m < order.size(); ++m) {
      const std::uint16_t series = imageSeries_.at(order[m]);
      targets[series] = {.matrix = m, .isRawImage = topics_[order[m]].isRawImage};
    }
    for (const auto& [names, series] : jointSeries_) targets[series] = {.isJoints = true};
    return targets;
  }

  ForeignAngles anglesOf(const HandDescription& hand) const {
    ForeignAngles angles;
    for (std::size_t i = 0; i < jointNames_.size(); ++i) angles.columnOf[jointNames_[i]] = i;
    const std::size_t numAngles = std::max(jointNames_.size(), numUnnamed_);
    for (std::size_t i = 0; i < numAngles; ++i)
      angles.unitsPerSi.push_back(
          i < hand.axes.size() && hand.axes[i].isSliding ? 1000.0 : 180.0 / std::numbers::pi);
    return angles;
  }

  void noteTopics() {
    for (const ForeignTopic& topic : topics_)
      if (!topic.unusable.empty())
        note("the topic " + inQuotes(topic.name) + " is left out: " + topic.unusable);
    if (jointSeries_.size() > 1)
      note("the messages of " + inQuotes(topics_[*joints_].name) +
           " have different joints, which are put together by name");
    constexpr std::size_t kMaxNotes = 20;
    if (notes_.size() <= kMaxNotes) return;
    const std::size_t more = notes_.size() - kMaxNotes;
    notes_.resize(kMaxNotes);
    note("and " + counted(more, "more note"));
  }

  // `numEarly`: messages of joints that no angles are made of.
  std::string lostOfTopics(std::size_t numEarly) const {
    constexpr std::size_t kMaxListed = 8;
    std::string text;
    std::size_t listed = 0;
    const auto add = [&](std::size_t count,
                         const char* what,
                         const std::string& topic,
                         const std::string& rest) {
      if (count == 0 || ++listed > kMaxListed) return;
      text += (text.empty() ? "" : "; ") + counted(count, what) + " of the topic " +
              inQuotes(topic) + (count == 1 ? " is " : " are ") + rest;
    };
    for (const ForeignTopic& topic : topics_) {
      if (!topic.unusable.empty()) continue;
      add(topic.leftOut, "message", topic.name, "left out (the first: " + topic.firstReason + ")");
      add(topic.notNumbers, "value", topic.name, "taken as 0 (NaN or infinite)");
    }
    if (joints_)
      add(numEarly, "message", topics_[*joints_].name, "left out (before all joints are known)");
    return listed > kMaxListed ? text + "; and more" : text;
  }

  Recording built() {
    const std::vector<std::size_t> order = matrixTopics();
    std::vector<MatrixLayout> matrices;
    std::size_t cells = 0;
    for (const std::size_t i : order) {
      // The pitch of foreign images is not known.
      matrices.push_back(MatrixLayout::full(
          static_cast<int>(topics_[i].rows), static_cast<int>(topics_[i].columns), 1.0));
      cells += matrices.back().numCells();
    }
    if (cells > kMaxPlaces) fail("has too many pixels for one hand; choose topics with --topic");
    const auto layout = std::make_shared<const SensorLayout>(std::move(matrices));
    chunks_.requireOrder(places_, progress_);
    HandDescription hand = handOf(layout, order);
    const ForeignAngles angles = anglesOf(hand);
    const std::size_t numColumns = angles.unitsPerSi.size();
    auto storage = std::make_shared<ForeignStorage>(
        std::move(chunks_), layout, std::move(places_), targetsOf(order), angles);
    noteTopics();
    ProfileInfo info;
    info.format = "mcap";
    info.valueType = allCounts_ ? ValueType::kCounts : ValueType::kFloat;
    info.warnings = std::move(notes_);
    std::string lost = lostOfTopics(storage->numEarly());
    if (!lost.empty() && !salvage_) info.warnings.push_back(std::string(kLostWarning) + lost);
    const std::size_t axes = storage->numSamples(kAngleSeries) > 0 ? numColumns : 0;
    return {.profile = Profile(
                std::move(info), withSeriesOf(std::move(hand), axes, 0), std::move(storage)),
            .damage = {.text = std::move(damage_), .unused = std::move(lost)}};
  }

  ForeignChunks chunks_;
  McapChannels channels_;
  std::string damage_;
  const std::vector<std::string>& chosen_;
  const Progress& progress_;
  const bool salvage_;
  std::map<std::uint16_t, std::optional<std::size_t>> topicOfChannel_;
  std::map<std::string, std::size_t> topicOfName_;  // by name and schema
  std::vector<ForeignTopic> topics_;
  std::optional<std::size_t> joints_;  // topic
  std::vector<ForeignSeries> series_;
  std::map<std::size_t, std::uint16_t> imageSeries_;            // by topic
  std::map<std::set<std::string>, std::uint16_t> jointSeries_;  // by the names of the joints
  std::vector<std::string> jointNames_;                         // in the order of the file
  std::size_t numUnnamed_ = 0;                                  // joints without names
  std::vector<std::string> lastJoints_;                         // of the last message
  std::uint16_t lastJointChannel_ = 0;
  std::uint16_t lastSeries_ = 0;
  bool usesLogTimes_ = false;
  std::uint16_t lastJointSeries_ = 0;
  std::vector<ForeignPlace> places_;
  std::vector<std::string> notes_;
  std::vector<float> pixels_;
  float largest_ = 0.0F;
  bool allCounts_ = true;
};

}  // namespace

Recording readForeignMcap(McapFile file,
                          McapStructure structure,
                          const std::vector<std::string>& topics,
                          const Progress& progress,
                          bool salvage) {
  return ForeignReader(std::move(file), std::move(structure), topics, progress, salvage).read();
}

}  // namespace palpate
