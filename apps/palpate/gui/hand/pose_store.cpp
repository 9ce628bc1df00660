#include "gui/hand/pose_store.h"

#include <QUrl>

#include <palpate/core/error.h>

namespace palpate::gui {
namespace {

// A settings key must not contain a slash.
QString poseKeyPart(const QString& text) {
  return QString::fromLatin1(QUrl::toPercentEncoding(text));
}
QString poseGroup(const std::string& hand) {
  return "poses/" + poseKeyPart(QString::fromStdString(hand));
}

}  // namespace

QStringList PoseStore::names(const std::string& hand) const {
  settings_.beginGroup(poseGroup(hand));
  QStringList names;
  for (const QString& key : settings_.childKeys())
    names.append(QUrl::fromPercentEncoding(key.toLatin1()));
  settings_.endGroup();
  names.sort(Qt::CaseInsensitive);
  return names;
}

void PoseStore::save(const SavedPose& pose) {
  settings_.setValue(poseGroup(pose.hand) + "/" + poseKeyPart(QString::fromStdString(pose.name)),
                     QString::fromStdString(posesText({pose})));
}

std::optional<SavedPose> PoseStore::load(const std::string& hand, const QString& name) const {
  try {
    const auto poses = parsePoses(
        settings_.value(poseGroup(hand) + "/" + poseKeyPart(name)).toString().toStdString(),
        "settings");
    if (poses.size() == 1) return poses[0];
  } catch (const Error&) {
  }
  return std::nullopt;
}

void PoseStore::remove(const std::string& hand, const QString& name) {
  settings_.remove(poseGroup(hand) + "/" + poseKeyPart(name));
}

}  // namespace palpate::gui
