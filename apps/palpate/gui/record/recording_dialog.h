// Asks what the next recording is of: operator, object, notes, its name and folder, labels of the
// digit keys. Says at once what the file will be called, and what stands in its way.
#pragma once

#include <QDialog>
#include <QString>
#include <functional>

#include <palpate/core/time.h>

#include "gui/source/recording_settings.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QMenu;
class QPlainTextEdit;
class QPushButton;

namespace palpate::gui {

class KeyLabels;

class RecordingDialog : public QDialog {
  Q_OBJECT
 public:
  // `okText` is what is done with the answer: "Start recording", "Keep". The clock tells date and
  // time in the name of the file; it must outlive the dialog.
  RecordingDialog(const RecordingSettings& settings,
                  const QString& okText,
                  QWidget* parent = nullptr,
                  const Clock& clock = systemClock());

  // What the fields say, without blanks around it.
  RecordingSettings settings() const;

  // Asks for a folder, an empty answer changes nothing; tests answer for themselves.
  std::function<QString(const QString& begin)> askForFolder;

 public slots:
  // Only when recordings can be made like this.
  void accept() override;

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* makeFields();
  QWidget* makePreview();
  QWidget* makeFoot(const QString& okText);
  QMenu* makePlaceholders();
  QLineEdit* makeField(const char* name, int maxLetters);
  void fill(const RecordingSettings& settings);
  void insert(const QString& placeholder);
  void browse();
  void fitMarks();
  void refresh();
  void showTexts();

  const Clock& clock_;
  QLineEdit* operator_ = nullptr;
  QLineEdit* object_ = nullptr;
  QPlainTextEdit* notes_ = nullptr;
  QLineEdit* template_ = nullptr;
  QMenu* placeholders_ = nullptr;
  QLineEdit* folder_ = nullptr;
  QLabel* caption_ = nullptr;
  QLabel* name_ = nullptr;
  QLabel* place_ = nullptr;
  QLabel* problem_ = nullptr;
  KeyLabels* marks_ = nullptr;
  QCheckBox* ask_ = nullptr;
  QPushButton* ok_ = nullptr;
  NextRecording next_;
};

}  // namespace palpate::gui
