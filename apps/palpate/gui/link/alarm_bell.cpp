#include "gui/link/alarm_bell.h"

#include <QApplication>

namespace palpate::gui {

AlarmBell::AlarmBell(QObject* parent) : QObject(parent), ring([] { QApplication::beep(); }) {}

void AlarmBell::hear(const std::vector<Alarm>& alarms, std::int64_t monoUs) {
  std::set<AlarmKind> now;
  QStringList texts;
  bool isNew = false;
  for (const Alarm& alarm : alarms) {
    now.insert(alarm.kind);
    texts.append(QString::fromStdString(alarm.text));
    if (ringing_.contains(alarm.kind)) continue;
    isNew = true;
    emit raised(texts.back());
  }
  if (isNew || (!now.empty() && monoUs - lastUs_ >= kAgainUs)) {
    lastUs_ = monoUs;
    if (!muted_) ring();
  }
  ringing_ = std::move(now);
  if (texts == texts_) return;
  texts_ = texts;
  emit changed(texts_);
}

}  // namespace palpate::gui
