#include "palpate/recording/tactile_sensor_json.h"

#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "palpate/core/json.h"
#include "palpate/core/progress.h"

namespace palpate {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::int64_t kNsPerUs = 1000;
constexpr std::size_t kTactileSensorJsonPieceBytes = 1U << 16;

// As int16[] has it.
std::int64_t wholeCounts(float value) {
  if (!(value > 0.0F)) return 0;
  return value >= static_cast<float>(INT16_MAX) ? INT16_MAX : std::lround(value);
}

Json matrixJson(const TactileFrame& frame, std::size_t m) {
  const auto values = frame.matrix(m);
  return Json::object()
      .set("matrix_id", m)
      .set("cells_x", frame.layout->matrix(m).columns)
      .set("cells_y", frame.layout->matrix(m).rows)
      .set(
          "tactile_array",
          jsonList(std::span(values.data(), static_cast<std::size_t>(values.size())), wholeCounts));
}

Json messageJson(const TactileFrame& frame, std::uint64_t sequence, Json matrices) {
  std::int64_t seconds = frame.hostUs / kSecondUs;
  std::int64_t restUs = frame.hostUs % kSecondUs;
  if (restUs < 0) {  // before 1970: nanoseconds count upwards all the same
    --seconds;
    restUs += kSecondUs;
  }
  Json stamp = Json::object().set("secs", seconds).set("nsecs", restUs * kNsPerUs);
  Json header = Json::object()
                    .set("seq", static_cast<std::int64_t>(sequence))
                    .set("stamp", std::move(stamp))
                    .set("frame_id", "sdh");
  return Json::object().set("header", std::move(header)).set("tactile_matrix", std::move(matrices));
}

}  // namespace

void appendTactileSensorJson(std::string& out, const TactileFrame& frame, std::uint64_t sequence) {
  Json matrices = Json::array();
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) matrices.push(matrixJson(frame, m));
  out += messageJson(frame, sequence, std::move(matrices)).text(-1);
}

std::vector<std::string> tactileSensorMessages(const TactileFrame& frame,
                                               std::uint64_t sequence,
                                               std::size_t maxBytes) {
  constexpr std::string_view kEnd = "]}";
  std::string head = messageJson(frame, sequence, Json::array()).text(-1);
  head.resize(head.size() - kEnd.size());
  std::vector<std::string> messages;
  std::string message = head;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const std::string matrix = matrixJson(frame, m).text(-1);
    if (message.size() > head.size() &&
        message.size() + 1 + matrix.size() + kEnd.size() > maxBytes) {
      messages.push_back(message + std::string(kEnd));
      message = head;
    }
    if (message.size() > head.size()) message += ',';
    message += matrix;
  }
  messages.push_back(message + std::string(kEnd));
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
