// Remembers in the settings what is applied to each hand: the calibration that pressures and forces
// are computed with, and the noise floor that the high-sensitivity mode uses. Both are stored under
// the hand's name; by default none is applied. Also collects the sensor settings and the tare that
// a recording contains.
#pragma once

#include <QSettings>
#include <optional>
#include <string>
#include <vector>

#include <palpate/calibration/force_series.h>
#include <palpate/calibration/noise_floor.h>
#include <palpate/calibration/tare.h>
#include <palpate/model/event.h>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

// Path of the calibration file; empty when none is applied.
QString appliedCalibration(const QSettings& settings, const std::string& hand);
// Applies the calibration file at `path`; an empty path removes the applied calibration.
void applyCalibration(QSettings& settings, const std::string& hand, const QString& path);
// The noise floor applied to that hand; nothing when none is applied or the stored one cannot be
// read.
std::optional<NoiseFloor> appliedNoise(const QSettings& settings, const std::string& hand);
void applyNoise(QSettings& settings, const std::string& hand, const NoiseFloor& floor);
// Reads a noise floor from a file: JSON as the page Noise saves it, or the XML of the prior program
// (.xml). Throws Error.
NoiseFloor noiseFromFile(const QString& path);

// What a recording contains about its sensor: settings and tare from its events (the last event of
// each kind counts), and the settings that the controller reported.
struct KeptWithRecording {
  std::optional<SensorSettings> settings = {};
  std::optional<Tare> tare = {};
  // Why an event cannot be used; empty when all can.
  QString problem = {};
  std::string reportedSettings = {};
  std::vector<ReportedChange> reportedChanges = {};
  bool operator==(const KeptWithRecording& other) const;
};
// Collects the above from the recording and its `events`.
KeptWithRecording keptWith(const OpenedRecording& recording, const std::vector<Event>& events);
// Sensor settings for the pressures of a recording: those that the user typed, else those kept as
// an event, else those that the controller reported. Throws Error when the report cannot be used.
PressureMapOptions pressureOptions(const KeptWithRecording& kept,
                                   const std::optional<SensorSettings>& typed);

// Loads a calibration file. Throws Error when it cannot be read or contains no pressure surface
// P(K, T).
Calibration usableCalibration(const QString& path);

}  // namespace palpate::gui
