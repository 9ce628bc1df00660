// The dialog with the settings of the next recording: operator, object, notes, name, folder,
// when it begins and ends, and labels of the digit keys. It shows the resulting file name, and any
// problem, while the user types.
#pragma once

#include <QDialog>
#include <QString>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include <palpate/capture/recorder.h>
#include <palpate/core/time.h>

#include "gui/source/latest_answer.h"
#include "gui/source/recording_settings.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QMenu;
class QPlainTextEdit;
class QPushButton;

namespace palpate::gui {

class Ask;
class ContentScroll;
class KeyLabels;
class RecordingTiming;

class RecordingDialog : public QDialog {
  Q_OBJECT
 public:
  // `okText` is the label of the OK button: "Start recording", "Keep". `clock` gives the date and
  // time in the file name; it must outlive the dialog.
  RecordingDialog(const RecordingSettings& settings,
                  const QString& okText,
                  Ask& ask,
                  QWidget* parent = nullptr,
                  const Clock& clock = systemClock());

  // The values of the fields without leading and trailing blanks.
  RecordingSettings settings() const;

  // The free space of the folder's disk, said while it is little; empty: not known. Tests replace
  // it.
  std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> freeBytes = freeBytesOf;

  // Waits until the next name is known, with events; for tests.
  void settle() { looking_.settle(); }

 public slots:
  // Closes the dialog once the folder has been looked at, and only when recordings can be made with
  // these settings.
  void accept() override;

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Look {
    RecordingSettings settings;
    std::int64_t nowUs = 0;
    std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> freeBytes;
  };
  struct Next : NextRecording {
    std::optional<std::uint64_t> free = {};
  };

  QWidget* makeFields();
  QWidget* makePreview();
  QWidget* makeFoot(const QString& okText);
  QMenu* makePlaceholders();
  QLineEdit* makeField(const char* name, int maxLetters);
  void fill(const RecordingSettings& settings);
  void insert(const QString& placeholder);
  void browse();
  // Makes the dialog as high as its content, as far as the screen has room for it.
  void fitHeight(int extraPx = 0);
  // Looks for the next name and then shows it: a network folder may take long to answer.
  void refresh();
  void take(const Next& next);
  void showTexts();

  Ask& ask_;
  const Clock& clock_;
  QLineEdit* operator_ = nullptr;
  QLineEdit* object_ = nullptr;
  QPlainTextEdit* notes_ = nullptr;
  // Of a recording of the plan; not to be changed here.
  QString run_;
  QString repetition_;
  QLineEdit* template_ = nullptr;
  QMenu* placeholders_ = nullptr;
  QLineEdit* folder_ = nullptr;
  QLabel* caption_ = nullptr;
  QLabel* name_ = nullptr;
  QLabel* place_ = nullptr;
  QLabel* problem_ = nullptr;
  ContentScroll* scroll_ = nullptr;
  RecordingTiming* timing_ = nullptr;
  KeyLabels* marks_ = nullptr;
  QCheckBox* mcap_ = nullptr;
  QCheckBox* askEachTime_ = nullptr;
  QPushButton* ok_ = nullptr;
  Next next_;
  // It closes when the folder has been looked at and no problem was found.
  bool isAccepting_ = false;
  LatestAnswer<Look, Next> looking_;
};

}  // namespace palpate::gui
