// What grasps have shown of named objects, kept in a file: read when a hand is connected, written
// when something was learnt or forgotten. A file that can't be read is not overwritten: what is
// learnt meanwhile holds until the hand is disconnected, and is written once the file is gone.
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>

#include <palpate/control/grasp_control.h>

#include "gui/source/background_job.h"

namespace palpate::gui {

class TouchStore : public QObject {
  Q_OBJECT
 public:
  explicit TouchStore(QObject* parent);
  // The file for the hand that is connected; empty: nothing is stored.
  std::function<std::filesystem::path()> file;
  // Reads the file; null when there is no hand. `control` must outlive this, or be replaced by null
  // before it is destroyed.
  void setControl(GraspControl* control);
  // Writes the file when the hand has learnt something.
  void follow(const GraspStatus& status);
  const TouchMemory& touches() const noexcept { return touches_; }
  bool isSaving() const noexcept { return job_.busy(); }
  // Not while a grasp runs, which would learn it again.
  void forget(const std::string& preshape, const std::string& object);

 signals:
  // Of touches().
  void changed();
  // The file can't be read or written: why, and what to do, in one line. Once for each cause.
  void failed(const QString& why);
  // The file was written, or read, after that.
  void recovered();

 private:
  void save();
  void fail(const QString& why);
  void recover();

  GraspControl* control_ = nullptr;
  TouchMemory touches_;
  std::uint64_t learnt_ = 0;
  std::filesystem::path path_;
  // The file is there, and could not be read.
  bool isDamaged_ = false;
  QString said_;
  BackgroundJob job_;
};

}  // namespace palpate::gui
