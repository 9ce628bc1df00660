// Stores own poses under names in the program's settings, separately for each hand (its name). Used
// by JointPanel.
#pragma once

#include <QSettings>
#include <QStringList>
#include <optional>
#include <string>

#include <palpate/control/saved_pose.h>

namespace palpate::gui {

class PoseStore {
 public:
  // `settings` must outlive this.
  explicit PoseStore(QSettings& settings) : settings_(settings) {}
  // In alphabetical order.
  QStringList names(const std::string& hand) const;
  void save(const SavedPose& pose);
  // Nothing when that name does not exist or its stored value is invalid.
  std::optional<SavedPose> load(const std::string& hand, const QString& name) const;
  void remove(const std::string& hand, const QString& name);

 private:
  QSettings& settings_;
};

}  // namespace palpate::gui
