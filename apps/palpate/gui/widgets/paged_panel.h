// The content of a dock that shows one of several pages. The buttons to choose the page are in the
// title row of the dock; the settings store the last page.
#pragma once

#include <QSettings>
#include <QStringList>
#include <QWidget>

class QButtonGroup;
class QStackedWidget;
class QToolButton;

namespace palpate::gui {

class PagedPanel : public QWidget {
  Q_OBJECT
 public:
  // `key`: prefix of its settings and of the names of the buttons, lower case.
  PagedPanel(QSettings& settings, QString key, QWidget* parent = nullptr);
  QWidget& header() noexcept { return *header_; }
  QStringList pageNames() const;
  // `name`: one of pageNames(); any other is ignored.
  void showPage(const QString& name);
  // Name of the visible page.
  QString pageName() const;

 protected:
  void addPage(QWidget* page, const QString& name, const QString& tip);
  // To be called once all pages have been added.
  void showLastPage();
  // For the layout, and as parent widget of the pages.
  QStackedWidget& pages() const noexcept { return *pages_; }

  // Shows a list in place of the buttons where the title row is too narrow for them.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fitHeader();
  void chooseButtons();

  QSettings& settings_;
  const QString key_;
  QWidget* header_;
  QToolButton* list_;
  QButtonGroup* chooser_;
  QStackedWidget* pages_;
};

}  // namespace palpate::gui
