// Where an export goes: a name with its ending, and a folder.
#pragma once

#include <QString>
#include <QWidget>
#include <functional>

class QLabel;
class QLineEdit;

namespace palpate::gui {

class ExportPlace : public QWidget {
  Q_OBJECT
 public:
  explicit ExportPlace(int labelWidth, QWidget* parent = nullptr);

  void setName(const QString& name, bool isOwn);
  // Only while the user hasn't chosen a name.
  void suggestName(const QString& name);
  void setFolder(const QString& folder);
  void setEnding(const QString& ending);
  QString name() const;
  bool nameIsOwn() const noexcept { return nameIsOwn_; }  // typed by the user
  QString folder() const;                                 // whole path

  // Asks for a folder, an empty answer changes nothing; tests answer for themselves.
  std::function<QString(const QString& begin)> askForFolder;

 signals:
  void changed();

 private:
  void browse();

  bool nameIsOwn_ = false;
  QLineEdit* name_;
  QLabel* ending_;
  QLineEdit* folder_;
};

}  // namespace palpate::gui
