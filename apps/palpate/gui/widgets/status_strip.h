// The content of the status bar: state of the source, numbers of the frame, and notices. It paints
// itself in one pass, so that it can change 60 times a second.
#pragma once

#include <QStringList>
#include <QWidget>

#include "gui/appearance/theme.h"

namespace palpate::gui {

struct Status {
  enum class Lamp { kIdle, kGood, kWarning };
  Lamp lamp = Lamp::kIdle;
  QString state;        // "recording · playing 1x"
  QStringList figures;  // "active 61", "max 1013", ..
  // A gap, or what is under the mouse pointer.
  QString notice;
  QString right;  // "frame 2411 of 3289   76.15 s"
  bool operator==(const Status&) const = default;
};

class StatusStrip : public QWidget {
  Q_OBJECT
 public:
  explicit StatusStrip(QWidget* parent = nullptr);
  void setStatus(const Status& status);
  const Status& status() const noexcept { return status_; }
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  // The tool tip has the texts that are shortened.
  bool event(QEvent* event) override;

 private:
  QString shownRight() const;

  Status status_;
  QStringList cut_;  // what was painted shortened, or not at all
};

}  // namespace palpate::gui
