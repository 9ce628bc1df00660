// Whether two recordings are compared instead of one being looked at. A is the recording that is
// shown.
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
  // With this one as B.
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
