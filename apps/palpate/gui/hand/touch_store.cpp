#include "gui/hand/touch_store.h"

#include <system_error>

#include <palpate/core/error.h>

namespace palpate::gui {

TouchStore::TouchStore(QObject* parent) : QObject(parent) {
  file = [] { return std::filesystem::path(); };
  connect(&job_, &BackgroundJob::failed, this, [this](const QString& why) {
    fail("Where grasps touched an object is not stored: " + why);
  });
}

void TouchStore::setControl(GraspControl* control) {
  if (control_) follow(control_->status());
  control_ = control;
  touches_ = {};
  isDamaged_ = false;
  if (control) {
    path_ = file();
    learnt_ = control->status().touchesLearnt;
    try {
      if (!path_.empty()) {
        touches_ = loadTouches(path_);
        recover();
      }
    } catch (const Error& error) {
      isDamaged_ = true;
      fail("Where grasps touched objects isn't known: " + QString(error.what()) +
           ". The file stays as it is, and nothing is stored, until it is deleted, or repaired and "
           "the hand connected again");
    }
    control->setTouches(touches_);
  }
  emit changed();
}

void TouchStore::follow(const GraspStatus& status) {
  if (!control_ || status.touchesLearnt == learnt_) return;
  learnt_ = status.touchesLearnt;
  touches_ = control_->touches();
  save();
  emit changed();
}

void TouchStore::forget(const std::string& preshape, const std::string& object) {
  if (!control_) return;
  TouchMemory touches = control_->touches();
  if (!touches.forget(preshape, object)) return;
  control_->setTouches(touches);
  touches_ = std::move(touches);
  save();
  emit changed();
}

// In a thread of its own: a disk that is slow must not delay Stop.
void TouchStore::save() {
  if (path_.empty()) return;
  std::error_code failure;
  if (isDamaged_ && std::filesystem::exists(path_, failure)) return;
  isDamaged_ = false;
  job_.start(
      "Storing where grasps touched",
      [touches = touches_, path = path_](const Progress&) { saveTouches(touches, path); },
      [this] { recover(); });
}

void TouchStore::fail(const QString& why) {
  if (std::exchange(said_, why) != why) emit failed(why);
}

void TouchStore::recover() {
  if (!std::exchange(said_, QString()).isEmpty()) emit recovered();
}

}  // namespace palpate::gui
