// Applies a calibration to a whole recording: pressure and force of every matrix in every frame. A
// tare that is stored with the recording is subtracted first, and creep of lasting contacts is
// removed, as in pressure_map.h. The command `calibrate apply` and the force chart use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/pressure_map.h>
#include <palpate/calibration/tare.h>
#include <palpate/core/json.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

// The fields of MatrixPressure in less memory, since a series may be hours long.
struct MatrixForce {
  float staticResponseCounts = 0.0F;
  float kpa = 0.0F, sdKpa = 0.0F;
  float forceN = 0.0F, sdForceN = 0.0F;
  std::uint16_t active = 0;  // taxels above 0
  bool inRange = true;
  bool temperatureKnown = true;
  bool saturated = false;
  bool compensated = false;
  bool startUnknown = false;
};

// Converts the result for one matrix to the smaller type.
MatrixForce matrixForce(const MatrixPressure& of);

// Pressures and forces of all frames of a recording.
struct ForceSeries {
  std::size_t numMatrices = 0;
  std::vector<double> timeS;      // from the first frame [s]
  std::vector<MatrixForce> rows;  // frame after frame, matrix after matrix
  std::size_t contacts = 0;       // rows with an active taxel
  std::size_t beyond = 0;         // rows of these that are outside of the measured range
  bool areaKnown = true;          // as in PressureFrame
  std::vector<std::string> assumptions;

  const MatrixForce& at(std::size_t frame, std::size_t matrix) const {
    return rows.at(frame * numMatrices + matrix);
  }
  // Force of the whole hand [N]: the sum over the matrices. The standard deviations are added as
  // well, since all matrices share one calibration.
  double forceN(std::size_t frame) const;
  double sdForceN(std::size_t frame) const;
  // Index of the last frame at or before a time [s]; 0 when there is none.
  std::size_t frameAt(double seconds) const;
};

// Throws Error (the recording has filtered values, not counts), std::invalid_argument (a
// calibration without P(K, T); settings or tare of another hand), Cancelled.
ForceSeries forceSeries(const Profile& profile,
                        const Calibration& calibration,
                        const PressureMapOptions& options = {},
                        const std::optional<Tare>& tare = std::nullopt,
                        const Progress& progress = {});

// JSON of the settings that a user entered for a recording, as its event of kind "sensor_settings"
// stores them.
Json jsonOf(const SensorSettings& settings);
// Reads the settings that the controller reported, from a recording's meta "settings" or from an
// event of kind "settings": an array of such settings, or one in "matrices". Throws Error.
std::vector<SensorSettings> reportedSettingsFrom(const Json& json);

// JSON of an event of kind "settings", and the time from which it holds [us since 1970].
struct ReportedChange {
  std::int64_t fromUs = 0;
  std::string json;
};
// Sets the settings and changes that a recording contains: its meta "settings" (empty when it has
// none) and its events. Changes without JSON (older recordings) are left out. Throws Error that
// says what cannot be used.
void useReportedSettings(PressureMapOptions& options,
                         const std::string& metaSettings,
                         std::vector<ReportedChange> changes);
// Reads the JSON of an event of kind "sensor_settings". Throws Error when it is no such JSON.
SensorSettings sensorSettingsFrom(const Json& json);

}  // namespace palpate
