#include "recording/mcap/mcap_foreign.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <numbers>
#include <optional>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/mcap/mcap_format.h"
#include "recording/mcap/mcap_messages.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostForeignMessages = 50'000'000;
constexpr std::uint64_t kMostForeignBytes = std::uint64_t{4} << 30;  // of all values as floats

// Where a message is.
struct ForeignPlace {
  std::int64_t timeUs = 0;
  std::uint32_t piece = 0;
  std::uint16_t series = 0;
  std::uint64_t offset = 0;  // of its data in the records of the piece
  std::uint32_t size = 0;
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
  ForeignReader(const McapFile& file,
                const McapStructure& structure,
                const Progress& progress,
                bool salvage)
      : file_(file), structure_(structure), progress_(progress), salvage_(salvage) {
    bad_.resize(structure.pieces.size());
  }

  McapRecording read() {
    channels_ = structure_.channels;
    for (std::size_t i = 0; i < structure_.pieces.size(); ++i) {
      reportProgress(progress_, i, 2 * structure_.pieces.size());
      findIn(i);
    }
    requireImages();
    sortTopics();
    return built();
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const { throw FormatError(file_.path(), fault); }

  // Records of a piece; nothing of a damaged one in a salvage.
  std::shared_ptr<const std::string> recordsOf(std::size_t piece) {
    for (auto it = cache_.begin(); it != cache_.end(); ++it)
      if (it->first == piece) {
        cache_.splice(cache_.begin(), cache_, it);
        return cache_.front().second;
      }
    if (bad_[piece]) return nullptr;
    try {
      cache_.emplace_front(piece,
                           std::make_shared<const std::string>(
                               readMcapPiece(file_, structure_.pieces[piece], piece)));
    } catch (const FormatError&) {
      if (!salvage_) throw;
      bad_[piece] = true;
      ++numBad_;
      return nullptr;
    }
    constexpr std::size_t kCached = 4;
    if (cache_.size() > kCached) cache_.pop_back();
    return cache_.front().second;
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
    const auto records = recordsOf(piece);
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
    if (joints_ == series) {
      CdrReader reader(message.data);
      timeUs = reader.time();
      reader.text();
      const std::vector<std::string> names = reader.texts(kMaxSampleValues);
      const std::vector<double> positions = reader.doubles(kMaxSampleValues);
      if (!reader.ok()) fail("the topic " + inQuotes(topic.topic) + " has a damaged message");
      if (topic.messages == 0) {
        numAngles_ = positions.size();
        jointNames_ = names;
      }
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
    if (places_.size() == kMostForeignMessages) fail("has too many messages");
    places_.push_back({timeUs,
                       static_cast<std::uint32_t>(piece),
                       series,
                       static_cast<std::uint64_t>(message.data.data() - records.data()),
                       static_cast<std::uint32_t>(message.data.size())});
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
    for (const float value : pixels_)
      if (value > largest_) largest_ = value;
  }

  void requireImages() const {
    for (std::size_t i = 0; i < topics_.size(); ++i)
      if (topics_[i].messages > 0 && joints_ != i) return;
    fail((structure_.damage.empty() ? "" : structure_.damage + "; before that it ") +
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
    matrixOf_.resize(topics_.size());
    for (std::size_t m = 0; m < order_.size(); ++m) matrixOf_[order_[m]] = m;
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
    if (places_.size() * std::uint64_t{cells} * sizeof(float) > kMostForeignBytes)
      fail("has too many images to be opened at once; take a part of it ('mcap filter')");
    ProfileBuilder builder(handOf(layout));
    TactileFrame frame(layout);
    bool any = false;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      reportProgress(progress_, places_.size() + i, 2 * places_.size(), 1024);
      const ForeignPlace& place = places_[i];
      const auto records = recordsOf(place.piece);
      if (!records) continue;
      const std::string_view data(records->data() + place.offset, place.size);
      if (joints_ == place.series) {
        addAngles(place, data, builder);
        continue;
      }
      const auto image = readRosImage(data);
      if (!image) fail("was changed while it was read");
      const std::size_t matrix = matrixOf_[place.series];
      mcapPixels(*image, frame.values.data() + layout->offset(matrix));
      frame.hostUs = place.timeUs;
      any = true;
      // Images of one stamp are one frame.
      bool last = true;
      for (std::size_t k = i + 1; k < places_.size() && places_[k].timeUs == place.timeUs; ++k)
        last = last && joints_ == places_[k].series;
      if (last) addFrame(frame, builder);
    }
    if (!any) fail("has no images that can be read");
    ProfileInfo info;
    info.format = "mcap";
    std::string damage = structure_.damage;
    if (numBad_ > 0)
      damage += (damage.empty() ? "has " : "; ") + counted(numBad_, "damaged chunk") +
                ", whose messages are lost";
    return {builder.finish(std::move(info)), {}, {}, {}, std::move(damage)};
  }

  void addFrame(const TactileFrame& frame, ProfileBuilder& builder) const {
    if (!std::all_of(
            frame.values.begin(), frame.values.end(), [](float v) { return std::isfinite(v); }))
      fail("has an image with a value that is not a number, " + std::to_string(frame.hostUs) +
           " us after 1970");
    builder.addFrame(frame);
  }

  void addAngles(const ForeignPlace& place, std::string_view data, ProfileBuilder& builder) {
    CdrReader reader(data);
    reader.time();
    reader.text();
    reader.texts(kMaxSampleValues);
    std::vector<double> angles = reader.doubles(kMaxSampleValues);
    if (!reader.ok()) fail("the topic " + inQuotes(topics_[place.series].topic) + " is damaged");
    if (angles.empty() && numAngles_ == 0) return;
    if (angles.size() != numAngles_)
      fail("the number of joints of the topic " + inQuotes(topics_[place.series].topic) +
           " changes");
    for (double& angle : angles) {
      angle *= 180.0 / std::numbers::pi;
      if (!std::isfinite(angle)) return;  // an angle that was not known
    }
    builder.addAngles(place.timeUs, angles);
  }

  const McapFile& file_;
  const McapStructure& structure_;
  const Progress& progress_;
  const bool salvage_;
  McapChannels channels_;
  std::map<std::uint16_t, std::optional<std::uint16_t>> series_;  // by channel
  std::vector<ForeignTopic> topics_;
  std::optional<std::uint16_t> joints_;
  std::vector<ForeignPlace> places_;
  std::vector<std::size_t> order_;     // topics of images
  std::vector<std::size_t> matrixOf_;  // by topic
  std::size_t numAngles_ = 0;
  std::vector<std::string> jointNames_;
  std::vector<float> pixels_;
  float largest_ = 0.0F;
  std::vector<bool> bad_;
  std::size_t numBad_ = 0;
  std::list<std::pair<std::size_t, std::shared_ptr<const std::string>>> cache_;
};

}  // namespace

McapRecording readForeignMcap(const McapFile& file,
                              const McapStructure& structure,
                              const Progress& progress,
                              bool salvage) {
  return ForeignReader(file, structure, progress, salvage).read();
}

}  // namespace palpate
