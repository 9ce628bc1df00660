// The page "Emulated hand" of the Connect dialog: the user chooses the scene around the hand, and
// whether the script of the scene runs.
#pragma once

#include <QString>
#include <QWidget>
#include <filesystem>

#include "gui/appearance/theme.h"

class QCheckBox;
class QLabel;
class QListWidget;

namespace palpate::gui {

class Ask;

class ScenePage : public QWidget {
  Q_OBJECT
 public:
  ScenePage(const std::filesystem::path& folder, Ask& ask, QWidget* parent);

  ~ScenePage() override;

  // `scene`: a name in the folder, or the path of a scene.
  void setScene(const QString& scene);
  QString scene() const;
  void setRunsScript(bool runsScript);
  bool runsScript() const;
  // Whether something moves by itself once the hand is connected.
  bool actsByItself() const;
  // Why the scene cannot be used, in one line; empty when it can.
  QString problem() const { return problem_; }

 signals:
  void changed();

 private:
  void addScene(const QString& scene, const QString& title);
  void showChosen();
  void showNote();

  std::filesystem::path folder_;
  QListWidget* list_;
  QLabel* none_;
  QCheckBox* acts_;
  // What a scene doesn't do whose script doesn't run.
  QLabel* note_;
  QString problem_;
};

}  // namespace palpate::gui
