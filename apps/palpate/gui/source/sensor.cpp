#include "gui/source/sensor.h"

#include <stdexcept>

#include <palpate/device/stream_device.h>

#include "gui/appearance/settings_table.h"

namespace palpate::gui {
namespace {

constexpr const char* kSensors = "sensors";

void sensorFields(SettingsTable& table, Sensor& sensor) {
  table.text("source", sensor.source);
  constexpr OptionRange kBaud = StreamDeviceOptions::kBaud;
  table.number("baud", sensor.baud, kBaud.minimum, kBaud.maximum);
  table.text("columns", sensor.columns);
}

// The name of a series has no character that a key must not have.
QString sensorKey(const QString& name) { return QString(kSensors) + "/" + name; }

}  // namespace

SeriesSourceOptions optionsOf(const Sensor& sensor) {
  SeriesSourceOptions options{.name = sensor.name.toStdString(),
                              .source = sensor.source.toStdString(),
                              .baud = sensor.baud};
  if (options.source == "-") throw std::invalid_argument("The window can't read standard input.");
  if (!sensor.columns.trimmed().isEmpty())
    options.columns = columnsOf(sensor.columns.toStdString());
  options.validate();
  return options;
}

QString problemOf(const Sensor& sensor) {
  if (sensor.name.isEmpty()) return "Give the sensor a name.";
  if (sensor.source.isEmpty()) return "Choose where its lines come from.";
  try {
    optionsOf(sensor);
  } catch (const std::invalid_argument& wrong) {
    return QString::fromUtf8(wrong.what()).simplified();
  }
  return {};
}

std::vector<Sensor> rememberedSensors(QSettings& settings) {
  settings.beginGroup(kSensors);
  const QStringList names = settings.childGroups();
  settings.endGroup();
  std::vector<Sensor> sensors;
  for (const QString& name : names) {
    auto sensor = loadFields<Sensor>(settings, sensorFields, sensorKey(name) + "/");
    sensor.name = name;
    if (problemOf(sensor).isEmpty()) sensors.push_back(std::move(sensor));
  }
  return sensors;
}

void rememberSensor(const Sensor& sensor, QSettings& settings) {
  saveFields(settings, sensor, sensorFields, sensorKey(sensor.name) + "/");
}

void forgetSensor(const QString& name, QSettings& settings) { settings.remove(sensorKey(name)); }

}  // namespace palpate::gui
