// A sensor added to the hand, whose rows become a further series: what the dialog asks for and the
// settings remember.
#pragma once

#include <QSettings>
#include <QString>
#include <vector>

#include <palpate/device/series_source.h>

namespace palpate::gui {

struct Sensor {
  // As SeriesDescription::name.
  QString name = {};
  // As SeriesSourceOptions::source, but never standard input.
  QString source = {};
  // Of a serial port [baud].
  int baud = 115'200;
  // As columnsOf() takes them; empty: a header line says it, or they are "1", "2", ..
  QString columns = {};
  bool operator==(const Sensor&) const = default;
};

// Throws std::invalid_argument that names what is wrong.
SeriesSourceOptions optionsOf(const Sensor& sensor);
// What is wrong or missing, one line; empty: nothing.
QString problemOf(const Sensor& sensor);

// The sensors that the next connection gets too, by their names.
std::vector<Sensor> rememberedSensors(QSettings& settings);
// Replaces one of the same name.
void rememberSensor(const Sensor& sensor, QSettings& settings);
void forgetSensor(const QString& name, QSettings& settings);

}  // namespace palpate::gui
