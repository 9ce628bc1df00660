// The calibrations that are applied to hands, as they were read from their files in the background.
#pragma once

#include <QObject>
#include <QString>
#include <map>
#include <memory>
#include <optional>

#include <palpate/calibration/calibration.h>

#include "gui/source/file_reading.h"

namespace palpate::gui {

class CalibrationCache : public QObject {
  Q_OBJECT
 public:
  struct Known {
    std::optional<Calibration> calibration;
    QString problem;  // why there is none, one line
  };

  explicit CalibrationCache(QObject* parent = nullptr) : QObject(parent) {}

  // Reads the file, also if it has been read before: its content may have changed, and what was
  // read is forgotten at once.
  void renew(const QString& path);
  // What was read. Null: it is being read; changed() follows.
  const Known* find(const QString& path);

 signals:
  // What find() returns was forgotten, or is known now.
  void changed(const QString& path);

 private:
  std::map<QString, Known> known_;
  std::map<QString, std::unique_ptr<FileReading>> readings_;
};

}  // namespace palpate::gui
