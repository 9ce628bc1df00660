// Makes alarms of the link heard: once when one comes up, and every ten seconds as long as it
// lasts.
#pragma once

#include <QObject>
#include <QStringList>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include <palpate/capture/link_health.h>

namespace palpate::gui {

class AlarmNotifier : public QObject {
  Q_OBJECT
 public:
  static constexpr std::int64_t kAgainUs = 10'000'000;

  explicit AlarmNotifier(QObject* parent = nullptr);
  // The alarms of now; `monoUs`: monotonic time [us].
  void updateAlarms(const std::vector<Alarm>& alarms, std::int64_t monoUs);
  void setMuted(bool muted) { muted_ = muted; }
  bool muted() const noexcept { return muted_; }
  // How it sounds; the desktop's bell unless a test says otherwise.
  std::function<void()> playSound;

 signals:
  void raised(const QString& text);  // one that wasn't there before
  // What there is now, one line each; empty: no alarm.
  void changed(const QStringList& texts);

 private:
  std::set<AlarmKind> activeAlarms_;
  QStringList texts_;
  std::int64_t lastUs_ = 0;
  bool muted_ = false;
};

}  // namespace palpate::gui
