// The content of a dock that shows one page at a time. The chooser of pages stands in the dock's
// title row; the page that was seen last is shown again.
#pragma once

#include <QSettings>
#include <QStringList>
#include <QWidget>

class QButtonGroup;
class QStackedWidget;

namespace palpate::gui {

class PagedPanel : public QWidget {
  Q_OBJECT
 public:
  // `key`: of its settings and the chooser's buttons, lower case.
  PagedPanel(QSettings& settings, QString key, QWidget* parent = nullptr);
  QWidget& header() noexcept { return *header_; }
  QStringList pageNames() const;
  void showPage(const QString& name);  // one of pageNames(); another is ignored
  QString pageName() const;            // of the page that is seen

 protected:
  void addPage(QWidget* page, const QString& name, const QString& tip);
  void showLastPage();  // once all are there
  // For the layout, and as parent of the pages.
  QStackedWidget& pages() const noexcept { return *pages_; }

 private:
  QSettings& settings_;
  const QString key_;
  QWidget* header_;
  QButtonGroup* chooser_;
  QStackedWidget* pages_;
};

}  // namespace palpate::gui
