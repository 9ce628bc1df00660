// The page "Emulated hand" of the Connect dialog: which scene is around it, and whether the scene
// acts.
#pragma once

#include <QString>
#include <QWidget>
#include <filesystem>
#include <functional>

#include "gui/appearance/theme.h"

class QCheckBox;
class QLabel;
class QListWidget;

namespace palpate::gui {

class ScenePage : public QWidget {
  Q_OBJECT
 public:
  ScenePage(const std::filesystem::path& folder, Theme theme, QWidget* parent);

  ~ScenePage() override;

  // A name in the folder, or the path of a scene.
  void setScene(const QString& scene);
  QString scene() const;
  void setActs(bool runsScript);
  bool runsScript() const;
  // Why the scene can't be used, one line; empty: it can.
  QString problem() const { return problem_; }

  // Asks for a scene's file; empty: none. Tests hand in their own.
  std::function<QString()> askForScene;

 signals:
  void changed();

 private:
  void addScene(const QString& scene, const QString& title);
  void showChosen();

  std::filesystem::path folder_;
  QListWidget* list_;
  QLabel* none_;
  QCheckBox* acts_;
  QString problem_;
};

}  // namespace palpate::gui
