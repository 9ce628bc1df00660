// Ctrl-C, a closed terminal, a machine that is shut down: the window hears of it and ends as if it
// was closed, so that a hand that moves is stopped and a recording finished.
#pragma once

#include <QObject>

#include "palpate/core/interruption.h"

namespace palpate::gui {

// One at a time, and no other Interruption beside it.
class Termination : public QObject {
  Q_OBJECT
 public:
  explicit Termination(QObject* parent = nullptr);

 signals:
  void asked();  // SIGINT, SIGTERM, SIGHUP; in the thread of this object

 private:
  Interruption interruption_;
};

}  // namespace palpate::gui
