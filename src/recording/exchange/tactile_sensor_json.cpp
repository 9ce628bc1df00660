#include "palpate/recording/tactile_sensor_json.h"

#include <cmath>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::int64_t kNsPerUs = 1000;
constexpr std::size_t kTactileSensorJsonPieceBytes = 1U << 16;
constexpr std::size_t kFramesPerReport = 256;

// As int16[] has it.
std::int64_t wholeCounts(float value) {
  if (!(value > 0.0F)) return 0;
  return value >= static_cast<float>(INT16_MAX) ? INT16_MAX : std::lround(value);
}

void appendKey(std::string& out, const char* key, std::int64_t value) {
  out += key;
  appendNumber(out, value);
}

}  // namespace

void appendTactileSensorJson(std::string& out, const TactileFrame& frame, std::uint64_t sequence) {
  std::int64_t seconds = frame.hostUs / kSecondUs;
  std::int64_t restUs = frame.hostUs % kSecondUs;
  if (restUs < 0) {  // before 1970: nanoseconds count upwards all the same
    --seconds;
    restUs += kSecondUs;
  }
  appendKey(out, R"({"header":{"seq":)", static_cast<std::int64_t>(sequence));
  appendKey(out, R"(,"stamp":{"secs":)", seconds);
  appendKey(out, R"(,"nsecs":)", restUs * kNsPerUs);
  out += R"(},"frame_id":"sdh"},"tactile_matrix":[)";
  const SensorLayout& layout = *frame.layout;
  const float* value = frame.values.data();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    if (m > 0) out += ',';
    appendKey(out, R"({"matrix_id":)", static_cast<std::int64_t>(m));
    appendKey(out, R"(,"cells_x":)", matrix.columns);
    appendKey(out, R"(,"cells_y":)", matrix.rows);
    out += R"(,"tactile_array":[)";
    for (std::size_t place = 0; place < matrix.numCells(); ++place) {
      if (place > 0) out += ',';
      appendNumber(out, wholeCounts(*value++));
    }
    out += "]}";
  }
  out += "]}";
}

void writeTactileSensorLines(const Profile& profile,
                             const std::filesystem::path& path,
                             Overwrite overwrite,
                             const Progress& progress) {
  OutputFile file(path, overwrite);
  std::string text;
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    if (progress && i % kFramesPerReport == 0 &&
        !progress(static_cast<double>(i) / static_cast<double>(profile.numFrames())))
      throw Cancelled();
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
