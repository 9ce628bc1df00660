// The dock Library: the recordings of a folder and of all below it, to be searched, sorted and
// opened.
#pragma once

#include <QFileSystemWatcher>
#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/library/library_model.h"
#include "gui/library/library_scanner.h"
#include "gui/library/library_table.h"

class QLabel;
class QLineEdit;
class QProgressBar;
class QStackedWidget;
class QToolButton;

namespace palpate::gui {

class EmptyPage;

class LibraryPanel : public QWidget {
  Q_OBJECT
 public:
  // The settings must outlive it: folder, columns and order are remembered there.
  LibraryPanel(QSettings& settings,
               const QString& cacheFolder,
               LibraryScanner::Catalog catalog = catalogRecordings,
               QWidget* parent = nullptr);
  ~LibraryPanel() override;

  // Looks into it as soon as the panel is seen.
  void setFolder(const QString& folder);
  const QString& folder() const noexcept { return folder_; }
  void setTheme(Theme theme);
  void refresh();  // looks again
  void startSearch();
  bool scanning() const noexcept { return scanner_.busy(); }

  // An empty answer means cancelled.
  std::function<QString(const QString& start)> askForFolder;
  // Whether there is something to compare with.
  std::function<bool()> comparable;
  // Shows a file in the file manager.
  std::function<void(const QString& path)> reveal;
  QSize sizeHint() const override { return {460, 500}; }

 signals:
  void openRequested(const QStringList& paths);
  void compareAsked(const QString& path);
  // A line to be kept: what couldn't be looked into.
  void said(const QString& message);
  void settled();  // a scan has ended

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void buildTop();
  void buildTable();
  void buildEmpty();
  void buildBottom();
  void connectScanner();
  void chooseFolder();
  void showMenu(const QPoint& at);
  void scanEnded(const CatalogReport* report);
  void showState();
  void showSummary();
  void showFolder();
  void rememberColumns();
  QStringList chosen() const;  // paths
  void openChosen();

  QSettings& settings_;
  LibraryScanner scanner_;
  LibraryModel* model_;
  LibraryFilter* filter_;
  QFileSystemWatcher watcher_;
  QTimer changed_;  // something in the folder: looked at when it is calm again
  QString folder_;
  QStringList problems_;
  int numListed_ = 0;
  int numFound_ = 0;     // in the scan that runs
  bool stale_ = true;    // has to be looked into
  bool looked_ = false;  // a scan of this folder has ended

  QToolButton* folderButton_ = nullptr;
  QToolButton* refreshButton_ = nullptr;
  QLineEdit* search_ = nullptr;
  QStackedWidget* pages_ = nullptr;
  LibraryTable* table_ = nullptr;
  EmptyPage* empty_ = nullptr;
  QLabel* summary_ = nullptr;
  QProgressBar* bar_ = nullptr;
  QToolButton* stop_ = nullptr;
};

}  // namespace palpate::gui
