#include "palpate/recording/tactile_sensor_json.h"

#include <cmath>
#include <string_view>
#include <utility>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"

namespace palpate {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::int64_t kNsPerUs = 1000;
constexpr std::size_t kTactileSensorJsonPieceBytes = 1U << 16;

// Whole numbers without a point, so that receivers get integers.
void appendJsonNumber(std::string& out, float value) {
  constexpr float kLargestWhole = 1e9F;
  if (!std::isfinite(value))
    out += "null";
  else if (value == std::floor(value) && std::abs(value) < kLargestWhole)
    appendNumber(out, static_cast<std::int64_t>(value));
  else
    appendNumber(out, value);
}

void appendMatrix(std::string& out, const TactileFrame& frame, std::size_t m) {
  const auto values = frame.matrix(m);
  out += "{\"matrix_id\":" + std::to_string(m) +
         ",\"cells_x\":" + std::to_string(frame.layout->matrix(m).columns) +
         ",\"cells_y\":" + std::to_string(frame.layout->matrix(m).rows) + ",\"tactile_array\":[";
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (k > 0) out += ',';
    appendJsonNumber(out, values.data()[k]);
  }
  out += "]}";
}

// The message up to its matrices.
std::string messageHead(const TactileFrame& frame, std::uint64_t sequence) {
  std::int64_t seconds = frame.hostUs / kSecondUs;
  std::int64_t restUs = frame.hostUs % kSecondUs;
  if (restUs < 0) {  // before 1970: nanoseconds count upwards all the same
    --seconds;
    restUs += kSecondUs;
  }
  Json stamp = Json::object().set("secs", seconds).set("nsecs", restUs * kNsPerUs);
  const Json header = Json::object()
                          .set("seq", static_cast<std::int64_t>(sequence))
                          .set("stamp", std::move(stamp))
                          .set("frame_id", "hand");
  return "{\"header\":" + header.text(-1) + ",\"tactile_matrix\":[";
}

constexpr std::string_view kMessageEnd = "]}";

}  // namespace

void appendTactileSensorJson(std::string& out, const TactileFrame& frame, std::uint64_t sequence) {
  out += messageHead(frame, sequence);
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    if (m > 0) out += ',';
    appendMatrix(out, frame, m);
  }
  out += kMessageEnd;
}

std::vector<std::string> tactileSensorMessages(const TactileFrame& frame,
                                               std::uint64_t sequence,
                                               std::size_t maxBytes) {
  const std::string head = messageHead(frame, sequence);
  std::vector<std::string> messages;
  std::string message = head;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    std::string matrix;
    appendMatrix(matrix, frame, m);
    if (message.size() > head.size() &&
        message.size() + 1 + matrix.size() + kMessageEnd.size() > maxBytes) {
      messages.push_back(message + std::string(kMessageEnd));
      message = head;
    }
    if (message.size() > head.size()) message += ',';
    message += matrix;
  }
  messages.push_back(message + std::string(kMessageEnd));
  return messages;
}

void writeTactileSensorLines(const Profile& profile,
                             const std::filesystem::path& path,
                             Overwrite overwrite,
                             const Progress& progress) {
  OutputFile file(path, overwrite);
  std::string text;
  TactileFrame frame;
  constexpr std::size_t kFramesPerReport = 256;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames(), kFramesPerReport);
    profile.readFrame(i, frame);
    appendTactileSensorJson(text, frame, i);
    text += '\n';
    if (text.size() < kTactileSensorJsonPieceBytes) continue;
    file.write(text);
    text.clear();
  }
  file.write(text);
  file.commit();
}

}  // namespace palpate
