#include "gui/link/alarm_notifier.h"

#include <QApplication>
#include <utility>

namespace palpate::gui {

AlarmNotifier::AlarmNotifier(QObject* parent)
    : QObject(parent), playSound([] { QApplication::beep(); }) {}

void AlarmNotifier::updateAlarms(const std::vector<Alarm>& alarms,
                                 std::int64_t monoUs,
                                 const QString& hand) {
  std::set<AlarmKind> now;
  QStringList texts;
  bool isNew = false;
  for (const Alarm& alarm : alarms) {
    now.insert(alarm.kind);
    texts.append(QString::fromStdString(alarm.text));
    if (activeAlarms_.contains(alarm.kind)) continue;
    isNew = true;
    emit raised(texts.back());
  }
  if (!hand.isEmpty()) texts.prepend(hand);
  if (std::exchange(hand_, hand) != hand && !hand.isEmpty()) {
    isNew = true;
    emit raised(hand);
  }
  if (isNew || (!texts.isEmpty() && monoUs - lastUs_ >= kAgainUs)) {
    lastUs_ = monoUs;
    if (!muted_) playSound();
  }
  activeAlarms_ = std::move(now);
  if (texts == texts_) return;
  texts_ = texts;
  emit changed(texts_);
}

}  // namespace palpate::gui
