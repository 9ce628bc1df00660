// What is applied to a hand: the calibration that tells its pressures and forces, and the noise
// lines that its high sensitivity goes by. Remembered by the hand's name; none is default.
#pragma once

#include <QSettings>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/force_series.h>
#include <palpate/calibration/noise_floor.h>
#include <palpate/calibration/tare.h>
#include <palpate/recording/recording_event.h>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

// Path of the calibration; empty: none.
QString appliedCalibration(const QSettings& settings, const std::string& hand);
// An empty path applies none.
void applyCalibration(QSettings& settings, const std::string& hand, const QString& path);
// Nothing: none is applied, or it can't be read any more.
std::optional<NoiseFloor> appliedNoise(const QSettings& settings, const std::string& hand);
void applyNoise(QSettings& settings, const std::string& hand, const NoiseFloor& floor);
// Noise lines of a file as the page Noise saves it, or the prior program (.xml). Throws Error.
NoiseFloor noiseFromFile(const QString& path);

// What a recording says of its sensor: what a person noted in it (of the event that was noted
// last), and what the controller reported.
struct KeptWithRecording {
  std::optional<SensorSettings> settings = {};
  std::optional<Tare> tare = {};
  QString problem = {};  // an event that can't be used: why
  std::string reportedSettings = {};
  std::vector<ReportedChange> reportedChanges = {};
  bool operator==(const KeptWithRecording& other) const;
};
KeptWithRecording keptWith(const OpenedRecording& recording,
                           const std::vector<RecordingEvent>& events);
// Settings for its pressures: what was typed, else noted, else reported. Throws Error (a report
// that can't be used).
PressureMapOptions pressureOptions(const KeptWithRecording& kept,
                                   const std::optional<SensorSettings>& typed);

// Of a calibration file with a P(K, T). Throws Error.
Calibration usableCalibration(const QString& path);

}  // namespace palpate::gui
