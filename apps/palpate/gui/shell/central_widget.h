// The centre of the main window: banners on top; below them the start page, or the views of the
// displayed source with the playback bar.
#pragma once

#include <QColor>
#include <QSettings>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <QWidget>
#include <vector>

#include "gui/shell/view_splitter.h"
#include "gui/window_state/displayed_source.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class CentralWidget : public QWidget {
  Q_OBJECT
 public:
  // Loads the sizes of the views from the settings, which must outlive this object.
  explicit CentralWidget(QSettings& settings, QWidget* parent = nullptr);

  void add(const CentralViewSpec& offer);
  // Adds all banners, in their order.
  void add(std::vector<BannerSpec> strips);
  // To be called once all views have been added.
  void begin();

  void setPlace(DisplayedSource::Kind place);
  void setComparing(bool on);
  // The colour of the border around views and comparison; an invalid one: no border.
  void setBorder(const QColor& color);
  void remember();
  // The width at which the views fit side by side [px].
  int comfortableWidth() const { return views_->widthSideBySide(); }

 private:
  QSettings& settings_;
  QVBoxLayout* lines_;
  class BorderedPage;
  BorderedPage* page_;
  // Start page, or page_.
  QStackedWidget* pages_;
  // Views, or the comparison of two recordings.
  QStackedWidget* work_;
  ViewSplitter* views_;
  QVBoxLayout* column_;
  std::vector<QWidget*> below_;
};

}  // namespace palpate::gui
