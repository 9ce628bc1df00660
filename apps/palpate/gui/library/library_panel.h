// The content of the dock Library: lists the recordings of a folder and its subfolders, which can
// be searched, sorted and opened.
#pragma once

#include <QFileSystemWatcher>
#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/library/library_model.h"
#include "gui/library/library_scanner.h"
#include "gui/widgets/rows_table.h"

class QLabel;
class QLayout;
class QLineEdit;
class QProgressBar;
class QStackedWidget;
class QToolButton;

namespace palpate::gui {

class Ask;
class EmptyPage;

class LibraryPanel : public QWidget {
  Q_OBJECT
 public:
  // `settings` stores folder, columns and sort order; it must outlive this.
  LibraryPanel(QSettings& settings,
               Ask& ask,
               const QString& cacheFolder,
               LibraryScanner::Catalog catalog = catalogRecordings,
               QWidget* parent = nullptr);
  ~LibraryPanel() override;

  // The folder is scanned as soon as the panel is visible.
  void setFolder(const QString& folder);
  const QString& folder() const noexcept { return folder_; }
  // As LibraryModel::setDamaged().
  void setDamaged(const std::filesystem::path& path, const std::string& message);
  // Scans the folder again.
  void refresh();
  void startSearch();
  // Paths of the chosen rows.
  QStringList chosen() const;
  bool scanning() const noexcept { return scanner_.busy(); }

  // Whether a recording is shown that another can be compared with.
  std::function<bool()> comparable;
  // Shows a file in the file manager.
  std::function<void(const QString& path)> reveal;
  QSize sizeHint() const override { return {460, 500}; }

 signals:
  void openRequested(const QStringList& paths);
  void compareRequested(const QString& path);
  // A file is to be made of each of the chosen recordings.
  void batchRequested();
  // A warning for the log: what could not be read.
  void said(const QString& message);
  // A scan has ended.
  void settled();

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QLayout* makeTop();
  void buildTable();
  void buildEmpty();
  void buildBottom();
  void connectScanner();
  void chooseFolder();
  void showMenu(const QPoint& at);
  void scanEnded(const CatalogReport* report);
  void showState();
  void showExample();
  QString stoppedText() const;
  void showSummary();
  void showFolder();
  void rememberColumns();
  void openChosen();
  void compareChosen();
  // Copies the chosen rows with the headings of the visible columns, for a spreadsheet.
  void copyRows() const;

  QSettings& settings_;
  Ask& ask_;
  LibraryScanner scanner_;
  LibraryModel* model_;
  LibraryFilter* filter_;
  QFileSystemWatcher watcher_;
  // Restarted by every change in the folder; scans when no change came for a while.
  QTimer changed_;
  QString folder_;
  QStringList problems_;
  int numListed_ = 0;
  // Number of recordings found by the running scan.
  int numFound_ = 0;
  // The folder must be scanned again.
  bool stale_ = true;
  // A scan of this folder has ended.
  bool looked_ = false;
  // The user stopped the last scan of this folder: the list is not complete.
  bool stopped_ = false;

  QToolButton* folderButton_ = nullptr;
  QToolButton* refreshButton_ = nullptr;
  QLineEdit* search_ = nullptr;
  QStackedWidget* pages_ = nullptr;
  RowsTable* table_ = nullptr;
  EmptyPage* empty_ = nullptr;
  QLabel* summary_ = nullptr;
  QProgressBar* bar_ = nullptr;
  QToolButton* stop_ = nullptr;
};

}  // namespace palpate::gui
