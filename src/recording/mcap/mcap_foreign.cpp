#include "recording/mcap/mcap_foreign.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/model/frame_coding.h"
#include "palpate/model/profile.h"
#include "palpate/recording/palpate_schema.h"

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

  // Records of a piece; nothing of a damaged one in a salvage.
  Records of(std::size_t piece) {
    if (bad_[piece]) return nullptr;
    if (keeps(piece)) return kept_.front().second;
    try {
      kept_.front().second =
          std::make_shared<const std::string>(readMcapPiece(file_, pieces_[piece], piece));
    } catch (const Error& error) {
      forget(kept_.begin());
      if (!salvage_ || !dynamic_cast<const FormatError*>(&error)) throw;
      bad_[piece] = true;
      ++numBad_;
      return nullptr;
    }
    return kept_.front().second;
  }

  // Throws FormatError where messages in this order can't be read in a bearable time; Cancelled.
  void requireOrder(const std::vector<ForeignPlace>& places, const Progress& progress) {
    constexpr std::size_t kPlacesPerReport = 1u << 16;
    std::uint64_t all = 0;
    for (const McapPiece& piece : pieces_) all += piece.rawSize;
    std::uint64_t again = 0;
    forgetAll();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (progress && i % kPlacesPerReport == 0 && !progress(1.0)) throw Cancelled();
      if (!keeps(places[i].piece)) again += pieces_[places[i].piece].rawSize;
    }
    forgetAll();
    if (again > std::max(kForeignUnpackedAgain, 4 * all))
      throw FormatError(path(),
                        "has its messages in too many chunks at a time to be read in order; write "
                        "it anew with 'mcap sort'");
  }

 private:
  using Kept = std::list<std::pair<std::size_t, Records>>;

  // Puts a piece in front. Returns false where it was not kept: it is empty then.
  bool keeps(std::size_t piece) {
    if (const auto found = places_.find(piece); found != places_.end()) {
      kept_.splice(kept_.begin(), kept_, found->second);
      return true;
    }
    keptBytes_ += keptBytesOf(piece);
    while (!kept_.empty() && keptBytes_ > kKeptForeignBytes) forget(std::prev(kept_.end()));
    kept_.emplace_front(piece, nullptr);
    places_[piece] = kept_.begin();
    return false;
  }
  std::uint64_t keptBytesOf(std::size_t piece) const {
    return pieces_[piece].rawSize + kKeptForeignPieceBytes;
  }
  void forget(Kept::iterator entry) {
    keptBytes_ -= keptBytesOf(entry->first);
    places_.erase(entry->first);
    kept_.erase(entry);
  }
  void forgetAll() {
    kept_.clear();
    places_.clear();
    keptBytes_ = 0;
  }

  McapFile file_;
  std::vector<McapPiece> pieces_;
  bool salvage_ = false;
  std::vector<bool> bad_;
  std::size_t numBad_ = 0;
  Kept kept_;                                               // the latest used first
  std::unordered_map<std::size_t, Kept::iterator> places_;  // of pieces in it
  std::uint64_t keptBytes_ = 0;
};

// Frames and angles as they are asked for.
class ForeignStorage final : public ProfileStorage {
 public:
  // `places`: in order of time. `matrixOf`: by series; nothing: of the joints.
  ForeignStorage(ForeignChunks chunks,
                 std::shared_ptr<const SensorLayout> layout,
                 std::vector<ForeignPlace> places,
                 const std::vector<std::optional<std::size_t>>& matrixOf)
      : chunks_(std::move(chunks)),
        layout_(std::move(layout)),
        places_(std::move(places)),
        images_(layout_->numMatrices()),
        shown_(layout_->numMatrices()),
        values_(layout_->numCells()) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto at = static_cast<std::uint32_t>(i);
      const std::int64_t timeUs = places_[i].timeUs;
      const auto matrix = matrixOf[places_[i].series];
      if (!matrix) {
        angles_.push_back(at);
        continue;
      }
      images_[*matrix].push_back(at);
      // Images of one stamp are one frame.
      if (frames_.empty() || places_[frames_.back()].timeUs != timeUs)
        frames_.push_back(at);
      else
        frames_.back() = at;
    }
  }

  std::size_t numFrames() const override { return frames_.size(); }
  std::int64_t frameTimeUs(std::size_t frame) const override {
    return places_[frames_[frame]].timeUs;
  }
  void readFrame(std::size_t frame, TactileFrame& out) const override {
    const std::lock_guard lock(mutex_);
    for (std::size_t m = 0; m < images_.size(); ++m) show(m, frames_[frame]);
    out.deviceMs.reset();
    out.filtered.clear();
    out.values = values_;
  }
  std::size_t numAngles() const override { return angles_.size(); }
  std::int64_t angleTimeUs(std::size_t sample) const override {
    return places_[angles_[sample]].timeUs;
  }
  JointAngles angles(std::size_t sample) const override {
    const std::lock_guard lock(mutex_);
    const ForeignPlace& place = places_[angles_[sample]];
    const auto records = chunks_.of(place.piece);
    auto angles = foreignAngles(dataOf(records, place));
    if (!angles) throwChanged();
    return {place.timeUs, std::move(*angles)};
  }
  std::size_t numTemperatures() const override { return 0; }
  std::int64_t temperatureTimeUs(std::size_t) const override { return 0; }
  Temperatures temperatures(std::size_t) const override { return {}; }

  // Degrees of a message; empty: it is damaged.
  static std::optional<std::vector<double>> foreignAngles(
      std::string_view message,
      std::int64_t* timeUs = nullptr,
      std::vector<std::string>* names = nullptr) {
    CdrReader reader(message);
    const std::int64_t stampUs = reader.time();
    reader.text();
    std::vector<std::string> joints = reader.texts(kMaxSampleValues);
    std::vector<double> angles = reader.doubles(kMaxSampleValues);
    if (!reader.ok()) return std::nullopt;
    for (double& angle : angles) angle *= 180.0 / std::numbers::pi;
    if (timeUs) *timeUs = stampUs;
    if (names) *names = std::move(joints);
    return angles;
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
    const auto image = readRosImage(dataOf(records, place));
    if (!image || std::size_t{image->rows} * image->columns != cells) throwChanged();
    mcapPixels(*image, values_.data() + offset);
    shown_[matrix] = at;
  }

  mutable std::mutex mutex_;
  mutable ForeignChunks chunks_;
  std::shared_ptr<const SensorLayout> layout_;
  std::vector<ForeignPlace> places_;
  std::vector<std::vector<std::uint32_t>> images_;           // places, by matrix
  std::vector<std::uint32_t> frames_;                        // the last place of each
  std::vector<std::uint32_t> angles_;                        // places
  mutable std::vector<std::optional<std::uint32_t>> shown_;  // place of each matrix in `values_`
  mutable std::vector<float> values_;
};

// A topic of images, or that of the joints.
struct ForeignTopic {
  std::string topic;
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  std::int64_t lastUs = 0;
  std::size_t messages = 0;
  bool isBytes = false;  // of images: 8 bits per pixel
};

class ForeignReader {
 public:
  ForeignReader(McapFile file, McapStructure structure, const Progress& progress, bool salvage)
      : chunks_(std::move(file), std::move(structure.pieces), salvage),
        channels_(std::move(structure.channels)),
        damage_(std::move(structure.damage)),
        progress_(progress) {}

  McapRecording read() {
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
      reportProgress(progress_, i, chunks_.size());
      findIn(i);
    }
    requireImages();
    sortTopics();
    return built();
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw FormatError(chunks_.path(), fault);
  }

  // The topic of a channel: its number, or nothing where its messages are of another kind.
  std::optional<std::uint16_t> seriesOf(std::uint16_t id) {
    const auto known = series_.find(id);
    if (known != series_.end()) return known->second;
    const auto channel = channels_.channels.find(id);
    if (channel == channels_.channels.end()) return std::nullopt;
    const auto schema = channels_.schemas.find(channel->second.schema);
    std::optional<std::uint16_t> result;
    if (schema != channels_.schemas.end()) {
      const std::string& name = schema->second.name;
      const bool isImage = name == "sensor_msgs/msg/Image" || name == "sensor_msgs/Image";
      const bool isJoints = name == "sensor_msgs/msg/JointState";
      if (isImage && channel->second.encoding != "cdr")
        fail("the topic " + inQuotes(channel->second.topic) + " has images in the encoding " +
             inQuotes(channel->second.encoding) + "; only cdr (ROS 2) is read");
      if (isImage || (isJoints && channel->second.encoding == "cdr" && !joints_)) {
        if (topics_.size() > kMaxMatrices) fail("has too many topics of images");
        // Several channels of a topic (publishers) are one.
        const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const auto& topic) {
          return topic.topic == channel->second.topic;
        });
        result = static_cast<std::uint16_t>(same - topics_.begin());
        if (same == topics_.end()) topics_.push_back({channel->second.topic});
        if (isJoints) joints_ = result;
      }
    }
    series_[id] = result;
    return result;
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
          if (const auto series = seriesOf(message.channel))
            addPlace(*series, message, piece, *records);
        });
    if (!whole) fail("chunk " + std::to_string(piece) + " is damaged: its records don't fit");
  }

  void addPlace(std::uint16_t series,
                const McapMessage& message,
                std::size_t piece,
                const std::string& records) {
    ForeignTopic& topic = topics_[series];
    std::int64_t timeUs = 0;
    bool known = true;  // values of joints that were not known are none
    if (joints_ == series) {
      std::vector<std::string> names;
      const auto angles = ForeignStorage::foreignAngles(message.data, &timeUs, &names);
      if (!angles) fail("the topic " + inQuotes(topic.topic) + " has a damaged message");
      if (topic.messages == 0) {
        numAngles_ = angles->size();
        jointNames_ = std::move(names);
      }
      if (angles->size() != numAngles_)
        fail("the number of joints of the topic " + inQuotes(topic.topic) + " changes");
      known = numAngles_ > 0 && std::all_of(angles->begin(), angles->end(), [](double v) {
                return std::isfinite(v);
              });
    } else {
      const auto image = readRosImage(message.data);
      if (!image) fail("the topic " + inQuotes(topic.topic) + " has a damaged image");
      takeImage(*image, topic);
      timeUs = image->timeUs;
    }
    // A message without a stamp has that of its record.
    if (timeUs == 0) timeUs = static_cast<std::int64_t>(message.logNs / 1000);
    if (topic.messages > 0 && timeUs <= topic.lastUs)
      fail("the stamps of the topic " + inQuotes(topic.topic) + " don't ascend at message " +
           std::to_string(topic.messages));
    topic.lastUs = timeUs;
    ++topic.messages;
    if (!known) return;
    if (places_.size() == kForeignMessages) fail("has too many messages");
    places_.push_back({timeUs,
                       static_cast<std::uint32_t>(piece),
                       static_cast<std::uint32_t>(message.data.data() - records.data()),
                       static_cast<std::uint32_t>(message.data.size()),
                       series});
  }

  void takeImage(const McapImage& image, ForeignTopic& topic) {
    if (mcapPixelBytes(image.encoding) == 0)
      fail("the topic " + inQuotes(topic.topic) + " has images of the encoding " +
           inQuotes(image.encoding) + "; mono8, mono16, 8UC1, 16UC1 and 32FC1 are read");
    if (image.rows < 1 || image.rows > 256 || image.columns < 1 || image.columns > 256)
      fail("the topic " + inQuotes(topic.topic) + " has images of " +
           std::to_string(image.columns) + " x " + std::to_string(image.rows) +
           " pixels; a matrix has at most 256 x 256 taxels");
    if (topic.messages > 0 && (image.rows != topic.rows || image.columns != topic.columns))
      fail("the size of the images of the topic " + inQuotes(topic.topic) + " changes at message " +
           std::to_string(topic.messages));
    topic.rows = image.rows;
    topic.columns = image.columns;
    topic.isBytes = mcapPixelBytes(image.encoding) == 1;
    pixels_.resize(std::size_t{image.rows} * image.columns);
    mcapPixels(image, pixels_.data());
    for (const float value : pixels_) {
      if (!std::isfinite(value))
        fail("the topic " + inQuotes(topic.topic) +
             " has an image with a value that is not a number");
      if (value > largest_) largest_ = value;
    }
    allCounts_ = allCounts_ && codingFor(std::span<const float>(pixels_)) == FrameCoding::kCounts;
  }

  void requireImages() const {
    for (std::size_t i = 0; i < topics_.size(); ++i)
      if (topics_[i].messages > 0 && joints_ != i) return;
    fail((damage_.empty() ? "" : damage_ + "; before that it ") +
         std::string("has no images (sensor_msgs/msg/Image, CDR) that could be matrices"));
  }

  // Matrices in the order of the names of their topics.
  void sortTopics() {
    for (std::size_t i = 0; i < topics_.size(); ++i)
      if (joints_ != i && topics_[i].messages > 0) order_.push_back(i);
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return topics_[a].topic < topics_[b].topic;
    });
    if (order_.size() > kMaxMatrices) fail("has too many topics of images");
    std::stable_sort(places_.begin(), places_.end(), [](const auto& a, const auto& b) {
      return a.timeUs < b.timeUs;
    });
  }

  HandDescription handOf(const std::shared_ptr<const SensorLayout>& layout) const {
    HandDescription hand = describeHand(*layout, numAngles_, 0);
    hand.layout = layout;
    if (hand.file) return hand;  // a hand of these sizes is known
    for (std::size_t m = 0; m < order_.size(); ++m)
      hand.matrices[m].name = hand.matrices[m].shortName = topics_[order_[m]].topic;
    for (std::size_t i = 0; i < hand.axes.size() && i < jointNames_.size(); ++i)
      hand.axes[i].name = jointNames_[i];
    const bool bytes = std::all_of(
        order_.begin(), order_.end(), [&](std::size_t i) { return topics_[i].isBytes; });
    constexpr float kMostOfBytes = 255.0F;
    hand.maximumCounts = bytes ? kMostOfBytes : std::max(hand.maximumCounts, std::ceil(largest_));
    hand.saturationCounts = hand.maximumCounts;
    return hand;
  }

  McapRecording built() {
    std::vector<MatrixLayout> matrices;
    std::size_t cells = 0;
    for (const std::size_t i : order_) {
      // The pitch of foreign images is not known.
      matrices.push_back(MatrixLayout::full(
          static_cast<int>(topics_[i].rows), static_cast<int>(topics_[i].columns), 1.0));
      cells += matrices.back().numCells();
    }
    if (cells > kMaxPlaces) fail("has too many pixels for one hand");
    const auto layout = std::make_shared<const SensorLayout>(std::move(matrices));
    chunks_.requireOrder(places_, progress_);
    std::vector<std::optional<std::size_t>> matrixOf(topics_.size());
    for (std::size_t m = 0; m < order_.size(); ++m) matrixOf[order_[m]] = m;
    HandDescription hand = handOf(layout);
    ProfileInfo info;
    info.format = "mcap";
    info.valueType = allCounts_ ? ValueType::kCounts : ValueType::kFloat;
    if (chunks_.numBad() > 0)
      damage_ += (damage_.empty() ? "has " : "; ") + counted(chunks_.numBad(), "damaged chunk") +
                 ", whose messages are lost";
    auto storage =
        std::make_shared<ForeignStorage>(std::move(chunks_), layout, std::move(places_), matrixOf);
    const std::size_t axes = storage->numAngles() > 0 ? numAngles_ : 0;
    return {Profile(std::move(info), withSeriesOf(std::move(hand), axes, 0), std::move(storage)),
            {},
            {},
            {},
            std::move(damage_)};
  }

  ForeignChunks chunks_;
  McapChannels channels_;
  std::string damage_;
  const Progress& progress_;
  std::map<std::uint16_t, std::optional<std::uint16_t>> series_;  // by channel
  std::vector<ForeignTopic> topics_;
  std::optional<std::uint16_t> joints_;
  std::vector<ForeignPlace> places_;
  std::vector<std::size_t> order_;  // topics of images
  std::size_t numAngles_ = 0;
  std::vector<std::string> jointNames_;
  std::vector<float> pixels_;
  float largest_ = 0.0F;
  bool allCounts_ = true;
};

}  // namespace

McapRecording readForeignMcap(McapFile file,
                              McapStructure structure,
                              const Progress& progress,
                              bool salvage) {
  return ForeignReader(std::move(file), std::move(structure), progress, salvage).read();
}

}  // namespace palpate
