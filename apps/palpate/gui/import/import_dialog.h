// The Import dialog: the user chooses a file of another program and a hand; the dialog shows what
// the file holds and what becomes what, and the user corrects it.
#pragma once

#include <QDialog>
#include <QSettings>
#include <filesystem>
#include <vector>

#include "gui/import/import_request.h"
#include "gui/source/latest_answer.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace palpate::gui {

class Ask;
class ImportFields;

class ImportDialog : public QDialog {
  Q_OBJECT
 public:
  // `settings` must outlive the dialog. `folders`: where hands are looked for by name.
  ImportDialog(QSettings& settings,
               std::vector<std::filesystem::path> folders,
               Ask& ask,
               QWidget* parent = nullptr);
  ~ImportDialog() override;

  ImportRequest request() const;
  // Why the request can't be carried out; empty when it can.
  QString problem() const;
  // Whether the preview is being computed.
  bool busy() const { return looking_.busy(); }

  void setData(const QString& path);
  void setHand(const QString& nameOrFolder);

 public slots:
  // Closes the dialog only when the request can be carried out.
  void accept() override;

 private:
  QWidget* makeFile();
  QWidget* makeSeries();
  QWidget* makePreview();
  QWidget* makeFoot();
  void connectFields();
  void showMapping(const ImportMapping& mapping);
  void usePreset();
  void listPresets(const QString& chosen);
  void addSeries(const QString& file);
  std::vector<SeriesFile> series() const;
  // What is wrong with the table of series; empty: nothing.
  QString seriesProblem() const;
  // Beside the table, unless a name was typed already.
  void takeRateOfMapping();
  void proposeOut();
  // Where to save: with folder and ending; empty: nothing was typed.
  QString out() const;
  void look();
  void take(const ImportLook& look);
  void showColumns(const ImportPreview& preview);
  void showProblem();

  QSettings& settings_;
  Ask& ask_;
  std::vector<std::filesystem::path> folders_;
  // The mapping that the fields began with; they show a part of it.
  ImportMapping first_;
  ImportLook looked_;
  bool filling_ = false;
  QLineEdit* data_ = nullptr;
  QComboBox* hand_ = nullptr;
  QComboBox* preset_ = nullptr;
  QPushButton* removePreset_ = nullptr;
  QComboBox* delimiter_ = nullptr;
  QComboBox* decimal_ = nullptr;
  QComboBox* header_ = nullptr;
  QComboBox* components_ = nullptr;
  QLineEdit* time_ = nullptr;
  QComboBox* timeUnit_ = nullptr;
  QDoubleSpinBox* rate_ = nullptr;
  QTableWidget* series_ = nullptr;  // name, rate, file
  QPushButton* removeSeries_ = nullptr;
  QString dataBefore_;
  ImportFields* fields_ = nullptr;
  QLabel* form_ = nullptr;
  QTableWidget* columns_ = nullptr;
  QLabel* choices_ = nullptr;
  QLabel* warnings_ = nullptr;  // what is left out, or doesn't fit the hand
  QString proposed_;
  QLineEdit* out_ = nullptr;
  QCheckBox* strict_ = nullptr;
  QCheckBox* replace_ = nullptr;
  QLabel* problem_ = nullptr;
  QPushButton* ok_ = nullptr;
  LatestAnswer<ImportRequest, ImportLook> looking_;
};

}  // namespace palpate::gui
