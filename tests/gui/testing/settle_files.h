// Waits until all files that a part of the window reads in the background are read.
#pragma once

#include <QCoreApplication>

#include "gui/source/file_reading.h"

namespace palpate::gui {

inline void settleFiles(const QObject& root) {
  for (FileReading* reading : root.findChildren<FileReading*>()) reading->settle();
}

}  // namespace palpate::gui
