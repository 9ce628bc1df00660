// Holds whether the window compares two recordings, A and B, instead of showing one. A is the
// displayed recording.
#pragma once

#include <QObject>

#include "gui/source/opened_recording.h"

namespace palpate::gui {

class ComparisonMode : public QObject {
  Q_OBJECT
 public:
  explicit ComparisonMode(QObject* parent = nullptr) : QObject(parent) {}

  bool on() const noexcept { return on_; }
  void set(bool on) {
    if (on == on_) return;
    on_ = on;
    emit changed(on);
  }
  // Starts the comparison with `b` as recording B.
  void with(const OpenedRecordingPtr& b) {
    emit bChosen(b);
    set(true);
  }

 signals:
  void changed(bool on);
  void bChosen(const palpate::gui::OpenedRecordingPtr& b);

 private:
  bool on_ = false;
};

}  // namespace palpate::gui
