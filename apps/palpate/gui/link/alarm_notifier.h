// Sounds the alarms of the link and of the hand: once when an alarm appears, and every ten seconds
// while one lasts.
#pragma once

#include <QObject>
#include <QStringList>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include <palpate/capture/link_health.h>
#include <palpate/control/grasp_control.h>

namespace palpate::gui {

// The alarm of the hand, one line: that it moves and can't be stopped, because its motion port is
// gone; why it is not protected. Empty: neither, or that was acknowledged. `nowUs`: the present
// time by the session's clock [us since 1970].
QString handAlarm(const GraspStatus& status, std::int64_t nowUs);

class AlarmNotifier : public QObject {
  Q_OBJECT
 public:
  static constexpr std::int64_t kAgainUs = 10'000'000;

  explicit AlarmNotifier(QObject* parent = nullptr);
  // Sets the present alarms; `monoUs`: monotonic time [us]; `hand`: see handAlarm().
  void updateAlarms(const std::vector<Alarm>& alarms,
                    std::int64_t monoUs,
                    const QString& hand = {});
  void setMuted(bool muted) { muted_ = muted; }
  bool muted() const noexcept { return muted_; }
  // Plays the sound: the desktop's bell; tests replace it.
  std::function<void()> playSound;

 signals:
  // An alarm appeared that was not there before.
  void raised(const QString& text);
  // The present alarms, one line each; empty when there are none.
  void changed(const QStringList& texts);

 private:
  std::set<AlarmKind> activeAlarms_;
  QString hand_;
  QStringList texts_;
  std::int64_t lastUs_ = 0;
  bool muted_ = false;
};

}  // namespace palpate::gui
