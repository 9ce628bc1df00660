// Stores tactile settings under names in the program's settings, separately for each hand (serial
// number). Used by TactileSettingsPanel.
#pragma once

#include <QSettings>
#include <QStringList>
#include <optional>

#include <palpate/control/tactile_settings.h>

namespace palpate::gui {

class HandSettingsStore {
 public:
  // `settings` must outlive this.
  explicit HandSettingsStore(QSettings& settings) : settings_(settings) {}
  // In alphabetical order.
  QStringList names(const QString& serial) const;
  void save(const QString& serial, const QString& name, const TactileSettings& values);
  // Nothing when that name does not exist or its stored value is invalid.
  std::optional<TactileSettings> load(const QString& serial, const QString& name) const;
  void remove(const QString& serial, const QString& name);

 private:
  QSettings& settings_;
};

}  // namespace palpate::gui
