// The fields of the Export dialog for the destination of an export: a file name with its ending,
// and a folder.
#pragma once

#include <QString>
#include <QWidget>

class QLabel;
class QLineEdit;

namespace palpate::gui {

class Ask;

class ExportPlace : public QWidget {
  Q_OBJECT
 public:
  ExportPlace(int labelWidth, Ask& ask, QWidget* parent = nullptr);

  void setName(const QString& name, bool isOwn);
  // Sets the name, unless the user has typed one.
  void suggestName(const QString& name);
  void setFolder(const QString& folder);
  void setEnding(const QString& ending);
  QString name() const;
  // The user typed the name.
  bool nameIsOwn() const noexcept { return nameIsOwn_; }
  // The absolute path of the folder.
  QString folder() const;

 signals:
  void changed();

 private:
  void browse();

  Ask& ask_;
  bool nameIsOwn_ = false;
  QLineEdit* name_;
  QLabel* ending_;
  QLineEdit* folder_;
};

}  // namespace palpate::gui
