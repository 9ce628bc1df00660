// What the window says: in passing, in the status line; in the banner, until it is closed; of the
// link, in its dock. All of it is kept in the log.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>

#include "gui/window_state/activity_log.h"

namespace palpate::gui {

class Messages : public QObject {
  Q_OBJECT
 public:
  // The log must outlive it.
  explicit Messages(ActivityLog& log, QObject* parent = nullptr);

  // For some seconds in the status line.
  void flash(const QString& notice);
  const QString& flashed() const noexcept { return flashed_; }
  // What lies under the mouse; empty: nothing.
  void hover(const QString& text);
  const QString& hovered() const noexcept { return hovered_; }

  // A failure, in the banner.
  void fail(const QString& message) { failAbout({}, message); }
  // One that is withdrawn with its topic, when it isn't so any more.
  void failAbout(const QString& topic, const QString& message);
  void withdraw(const QString& topic);
  void dismissFailures();

  // A line of the link: connected, recording begins, an alarm.
  void logLink(const QString& line);
  // Instead of what is offered: something goes on that ends by itself.
  void announce(const QString& text);

  ActivityLog& log() noexcept { return log_; }

 signals:
  void changed();  // flashed() or hovered()
  void failed(const QString& topic, const QString& message);
  void withdrawn(const QString& topic);
  void failuresDismissed();
  void linkLogged(const QString& line);
  void announced(const QString& text);

 private:
  ActivityLog& log_;
  QString flashed_;
  QString hovered_;
  QTimer flashTimer_;
};

}  // namespace palpate::gui
