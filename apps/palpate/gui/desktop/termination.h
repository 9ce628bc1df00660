// Turns SIGINT, SIGTERM and SIGHUP (Ctrl-C, a closed terminal, a shutdown) into a signal on which
// the window closes normally, so that a moving hand is stopped and a recording finished.
#pragma once

#include <QObject>

#include "palpate/core/interruption.h"

namespace palpate::gui {

// Only one object at a time, and no other Interruption beside it.
class Termination : public QObject {
  Q_OBJECT
 public:
  explicit Termination(QObject* parent = nullptr);

 signals:
  // SIGINT, SIGTERM or SIGHUP has arrived; emitted in the thread of this object.
  void asked();

 private:
  Interruption interruption_;
};

}  // namespace palpate::gui
