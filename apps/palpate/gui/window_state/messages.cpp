#include "gui/window_state/messages.h"

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

constexpr int kFlashMs = 5000;

}  // namespace

Messages::Messages(ActivityLog& log, QObject* parent) : QObject(parent), log_(log) {
  flashTimer_.setSingleShot(true);
  flashTimer_.setInterval(kFlashMs);
  connect(&flashTimer_, &QTimer::timeout, this, [this] {
    flashed_.clear();
    emit changed();
  });
}

void Messages::flash(const QString& notice) {
  flashed_ = inWindowWords(notice);
  log_.add(LogLine::Severity::kInfo, flashed_);
  flashTimer_.start();
  emit changed();
}

void Messages::takeBack(const QString& notice) {
  if (flashed_.isEmpty() || flashed_ != inWindowWords(notice)) return;
  flashTimer_.stop();
  flashed_.clear();
  emit changed();
}

void Messages::hover(const QString& text) {
  hovered_ = text;
  emit changed();
}

void Messages::failAbout(const QString& topic, const QString& message) {
  const QString text = inWindowWords(message);
  log_.add(LogLine::Severity::kError, text);
  emit failed(topic, text);
}

void Messages::withdraw(const QString& topic) { emit withdrawn(topic); }

void Messages::dismissFailures() { emit failuresDismissed(); }

void Messages::logLink(const QString& line) { emit linkLogged(line); }

void Messages::announce(const QString& text) { emit announced(text); }

}  // namespace palpate::gui
