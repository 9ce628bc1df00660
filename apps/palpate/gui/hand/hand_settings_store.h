// Tactile settings kept by name, for each hand (serial number) its own.
#pragma once

#include <QSettings>
#include <QStringList>
#include <optional>

#include <palpate/control/tactile_settings.h>

namespace palpate::gui {

class HandSettingsStore {
 public:
  // The settings must outlive it.
  explicit HandSettingsStore(QSettings& settings) : settings_(settings) {}
  QStringList names(const QString& serial) const;  // in order of the alphabet
  void save(const QString& serial, const QString& name, const TactileSettings& values);
  // Nothing when there is none of this name, or what is there is no settings.
  std::optional<TactileSettings> load(const QString& serial, const QString& name) const;
  void remove(const QString& serial, const QString& name);

 private:
  QSettings& settings_;
};

}  // namespace palpate::gui
