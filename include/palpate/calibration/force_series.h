// A whole recording through a calibration: pressure and force of every matrix in every frame. A
// tare that is kept with the recording is taken off first, and creep of contacts that last taken
// out, as pressure_map.h does.
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

// MatrixPressure, small: hours are kept of it.
struct MatrixForce {
  float staticResponseCounts = 0.0F;
  float kpa = 0.0F, sdKpa = 0.0F;
  float forceN = 0.0F, sdForceN = 0.0F;
  std::uint16_t active = 0;  // taxels above 0
  bool inRange = true;
  bool temperatureKnown = true;
  bool saturated = false;
  bool compensated = false;
};

MatrixForce matrixForce(const MatrixPressure& of);

struct ForceSeries {
  std::size_t numMatrices = 0;
  std::vector<double> timeS;      // from the first frame [s]
  std::vector<MatrixForce> rows;  // frame after frame, matrix after matrix
  std::size_t contacts = 0;       // rows with an active taxel
  std::size_t beyond = 0;         // of these: not within what was measured
  std::vector<std::string> assumptions;

  const MatrixForce& at(std::size_t frame, std::size_t matrix) const {
    return rows.at(frame * numMatrices + matrix);
  }
  // Of the whole hand [N]: sum over the matrices; standard deviations add up (one calibration).
  double forceN(std::size_t frame) const;
  double sdForceN(std::size_t frame) const;
  std::size_t frameAt(double seconds) const;  // the last one at or before; 0 where there is none
};

// Throws Error (filtered values, not counts), std::invalid_argument (calibration without P(K, T),
// settings or tare of another hand), Cancelled.
ForceSeries forceSeries(const Profile& profile,
                        const Calibration& calibration,
                        const PressureMapOptions& options = {},
                        const std::optional<Tare>& tare = std::nullopt,
                        const Progress& progress = {});

// What a person said that a recording was made with, as its event of kind "sensor_settings" keeps
// it; and back. Throws Error: not such JSON.
Json jsonOf(const SensorSettings& settings);
// What the controller itself reported, as a recording's meta "settings" and its events of kind
// "settings" have it: an array of the above, or one in "matrices". Throws Error.
std::vector<SensorSettings> reportedSettingsFrom(const Json& json);

// JSON of an event "settings", and when it held from [us since 1970].
struct ReportedChange {
  std::int64_t fromUs = 0;
  std::string json;
};
// Fills in settings and changes of a recording that tells them: its meta "settings" (empty: doesn't
// tell), its events. Changes without JSON (older recordings) are left out. Throws Error (what can't
// be used).
void useReportedSettings(PressureMapOptions& options,
                         const std::string& metaSettings,
                         std::vector<ReportedChange> changes);
SensorSettings sensorSettingsFrom(const Json& json);

}  // namespace palpate
