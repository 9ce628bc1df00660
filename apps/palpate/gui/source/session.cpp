#include "gui/source/session.h"

#include <algorithm>
#include <cmath>

namespace palpate::gui {
namespace {

constexpr const char* kFiles = "session/files";
constexpr const char* kCurrent = "session/current";

std::optional<TimeSpan> spanFrom(const QSettings& settings, const QString& key) {
  const QStringList words = settings.value(key).toStringList();
  if (words.size() != 2) return std::nullopt;
  const TimeSpan span{words[0].toDouble(), words[1].toDouble()};
  if (!std::isfinite(span.fromS) || !std::isfinite(span.toS) || span.fromS > span.toS)
    return std::nullopt;
  return span;
}

void store(QSettings& settings, const QString& key, const std::optional<TimeSpan>& span) {
  if (!span) return;
  constexpr int kDigits = 17;
  settings.setValue(key,
                    QStringList{QString::number(span->fromS, 'g', kDigits),
                                QString::number(span->toS, 'g', kDigits)});
}

}  // namespace

Session loadSession(QSettings& settings) {
  Session session;
  const int wanted = settings.value(kCurrent, -1).toInt();
  const int count = std::min(settings.beginReadArray(kFiles), Session::kMaxFiles);
  for (int i = 0; i < count; ++i) {
    settings.setArrayIndex(i);
    Session::File file;
    file.path = settings.value("path").toString();
    if (file.path.isEmpty()) continue;
    file.viewPosition.frame = settings.value("frame").toULongLong();
    file.viewPosition.seen = spanFrom(settings, "seen");
    file.viewPosition.selection = spanFrom(settings, "selection");
    if (i == wanted) session.current = static_cast<int>(session.files.size());
    session.files.push_back(std::move(file));
  }
  settings.endArray();
  return session;
}

void saveSession(const Session& session, QSettings& settings) {
  settings.remove(kFiles);
  settings.setValue(kCurrent, session.current);
  const auto count = std::min(session.files.size(), static_cast<std::size_t>(Session::kMaxFiles));
  settings.beginWriteArray(kFiles, static_cast<int>(count));
  for (std::size_t i = 0; i < count; ++i) {
    settings.setArrayIndex(static_cast<int>(i));
    const Session::File& file = session.files[i];
    settings.setValue("path", file.path);
    settings.setValue("frame", static_cast<qulonglong>(file.viewPosition.frame));
    store(settings, "seen", file.viewPosition.seen);
    store(settings, "selection", file.viewPosition.selection);
  }
  settings.endArray();
}

}  // namespace palpate::gui
