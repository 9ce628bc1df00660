// Reads a file that the user named, and what it holds, in a thread that nobody waits for.
#pragma once

#include "gui/source/abandonable.h"

namespace palpate::gui {

class FileReading : public Abandonable {
  Q_OBJECT
 public:
  using Work = std::function<Take()>;

  using Abandonable::Abandonable;
  // As Abandonable::start().
  void start(Work work, Failed failed);
  // Waits for all answers of readings below `root`, with events.
  static void settleAll(const QObject& root);
  // Is called in the thread before each work; for tests, which hold it there. Null: nothing is.
  static void setGate(std::function<void()> gate);
};

}  // namespace palpate::gui
