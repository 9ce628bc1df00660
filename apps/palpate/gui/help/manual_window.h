// The window of the manual: contents, pages with pictures and links, and a search over all pages.
// It stays open next to the window of the program.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QStackedWidget>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>
#include <QUrl>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/help/manual_pages.h"

namespace palpate::gui {

// Shows a page; its pictures are made no wider than itself.
class ManualBrowser : public QTextBrowser {
  Q_OBJECT
 public:
  ManualBrowser(const ManualPages& pages, QWidget* parent);
  void showPage(const QString& name);
  // Scrolls so that a place of the page is at the top; `position` [characters].
  void scrollTo(int position);

 protected:
  QVariant loadResource(int type, const QUrl& name) override;

 private:
  const ManualPages& pages_;
  QString page_;
};

class ManualWindow : public QDialog {
  Q_OBJECT
 public:
  // `folder`: that of the documentation.
  ManualWindow(const std::filesystem::path& folder, QWidget* parent);

  // Follows a link as the pages write it: "docks.md#hand", "../notes/slip.md", "#hand",
  // "https://..".
  void follow(const QString& link);
  // The page that is shown: "manual/docks.md".
  const QString& page() const noexcept { return page_; }

 public slots:
  void back();
  void forward();
  void nextHit();
  void previousHit();

 private:
  struct Place {
    QString page;
    int scroll = 0;  // of the vertical scroll bar
  };

  void buildContents();
  QWidget* makeTop();
  void addKeys();
  void show(const QString& page);
  void goTo(const QString& page, const QString& anchor);
  void goBackTo(const Place& place);
  Place here() const;
  void search();
  void showHit(int row);
  void markHits();
  void updateButtons();
  void say(const QString& text);

  ManualPages pages_;
  QString page_;
  std::vector<Place> before_;
  std::vector<Place> after_;
  std::vector<ManualHit> hits_;
  // For each row of the results its first hit; a row has all hits that its excerpt shows.
  std::vector<std::size_t> rowHits_;
  ManualBrowser* browser_;
  QTreeWidget* contents_;
  QListWidget* results_;
  QStackedWidget* left_;
  QLineEdit* words_ = nullptr;
  QLabel* status_ = nullptr;
  QToolButton* back_ = nullptr;
  QToolButton* forward_ = nullptr;
};

}  // namespace palpate::gui
