// The Batch dialog: recordings and folders, what is made of each, where the results go and how they
// are named; the progress of the batch, and what failed. It is not modal: the window, and Stop,
// stay usable.
#pragma once

#include <QDialog>
#include <QSettings>
#include <QTimer>

#include "gui/batch/batch_choices.h"
#include "gui/batch/batch_controller.h"
#include "gui/source/background_job.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTabWidget;

namespace palpate::gui {

class Ask;
class BatchFields;
class BatchResults;

class BatchDialog : public QDialog {
  Q_OBJECT
 public:
  // Begins with the choices of the settings. Both must outlive the dialog.
  BatchDialog(QSettings& settings,
              BatchController& controller,
              Ask& ask,
              QWidget* parent = nullptr);
  ~BatchDialog() override;

  BatchChoices choices() const;
  void setChoices(const BatchChoices& choices);
  // Replaces the list of recordings and folders.
  void setPaths(const QStringList& paths);
  void addPaths(const QStringList& paths);
  // Why the batch can't be started; empty when it can.
  QString problem() const;
  // Whether the names of the results are being looked for.
  bool looking() const { return delay_.isActive() || job_.busy(); }
  BatchFields& fields() noexcept { return *fields_; }
  BatchResults& results() noexcept { return *results_; }
  // Starts the batch when nothing speaks against it.
  void start();

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  QWidget* makeChoices();
  QWidget* makeRecordings();
  QWidget* makePlace();
  QWidget* makeFoot();
  void connectFields();
  void connectController();
  void removeChosen();
  void changed();
  void look();
  void showLook();
  void showState();
  void showProgress(const BatchStatus& status);
  void say(const QString& text, bool isProblem);

  QSettings& settings_;
  BatchController& controller_;
  Ask& ask_;
  BatchLook look_;
  // Counts the changes of the choices: a look at earlier ones is not shown.
  std::size_t change_ = 0;
  std::size_t shown_ = 0;
  bool filling_ = false;
  bool eachGrasp_ = false;
  QTabWidget* pages_;
  QListWidget* paths_ = nullptr;
  QLabel* count_ = nullptr;
  QPushButton* remove_ = nullptr;
  BatchFields* fields_ = nullptr;
  QLineEdit* folder_ = nullptr;
  QLineEdit* names_ = nullptr;
  QLabel* ending_ = nullptr;
  QLabel* preview_ = nullptr;
  QCheckBox* resume_ = nullptr;
  QCheckBox* replace_ = nullptr;
  QSpinBox* threads_ = nullptr;
  QWidget* place_ = nullptr;
  QWidget* recordings_ = nullptr;
  BatchResults* results_ = nullptr;
  QProgressBar* bar_ = nullptr;
  QLabel* said_ = nullptr;
  QPushButton* cancel_ = nullptr;
  QPushButton* close_ = nullptr;
  QPushButton* start_ = nullptr;
  QTimer delay_;
  BackgroundJob job_;
};

}  // namespace palpate::gui
