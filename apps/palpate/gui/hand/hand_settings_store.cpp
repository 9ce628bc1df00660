#include "gui/hand/hand_settings_store.h"

#include <QUrl>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

// Encodes a name, because a settings key must not contain a slash.
QString handSettingsStoreEncoded(const QString& text) {
  return QString::fromLatin1(QUrl::toPercentEncoding(text.isEmpty() ? "unknown" : text));
}
QString groupOf(const QString& serial) {
  return "hands/" + handSettingsStoreEncoded(serial) + "/settings";
}

}  // namespace

QStringList HandSettingsStore::names(const QString& serial) const {
  settings_.beginGroup(groupOf(serial));
  QStringList names;
  for (const QString& key : settings_.childKeys())
    names.append(QUrl::fromPercentEncoding(key.toLatin1()));
  settings_.endGroup();
  names.sort(Qt::CaseInsensitive);
  return names;
}

void HandSettingsStore::save(const QString& serial,
                             const QString& name,
                             const TactileSettings& values) {
  settings_.setValue(groupOf(serial) + "/" + handSettingsStoreEncoded(name),
                     QString::fromStdString(toJson(values)));
}

std::optional<TactileSettings> HandSettingsStore::load(const QString& serial,
                                                       const QString& name) const {
  try {
    return parseTactileSettings(
        settings_.value(groupOf(serial) + "/" + handSettingsStoreEncoded(name))
            .toString()
            .toStdString());
  } catch (const Error&) {
    return std::nullopt;
  }
}

void HandSettingsStore::remove(const QString& serial, const QString& name) {
  settings_.remove(groupOf(serial) + "/" + handSettingsStoreEncoded(name));
}

}  // namespace palpate::gui
