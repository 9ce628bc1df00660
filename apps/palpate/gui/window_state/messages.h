// Distributes the messages of the window: short notices in the status line, failures in the banner
// until it is closed, reports of the connection in the dock Link. All of them are written to the
// log.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>

#include "gui/window_state/activity_log.h"

namespace palpate::gui {

class Messages : public QObject {
  Q_OBJECT
 public:
  // The log must outlive this object.
  explicit Messages(ActivityLog& log, QObject* parent = nullptr);

  // Shows a notice in the status line for some seconds.
  void flash(const QString& notice);
  // Takes a notice away that is no longer true; another one stays.
  void takeBack(const QString& notice);
  const QString& flashed() const noexcept { return flashed_; }
  // Describes what is under the mouse pointer; empty: nothing.
  void hover(const QString& text);
  const QString& hovered() const noexcept { return hovered_; }

  // Shows a failure in the banner.
  void fail(const QString& message) { failAbout({}, message); }
  // Shows a failure that withdraw() removes by its topic once the cause is gone.
  void failAbout(const QString& topic, const QString& message);
  void withdraw(const QString& topic);
  void dismissFailures();

  // Reports an event of the connection: connected, recording begins, an alarm.
  void logLink(const QString& line);
  // Announces work that ends by itself, in place of the offer strip.
  void announce(const QString& text);

  ActivityLog& log() noexcept { return log_; }

 signals:
  // flashed() or hovered() has changed.
  void changed();
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
