// The middle of the window: lines with messages, the start page, or the views of what is looked at
// and what plays it.
#pragma once

#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <QWidget>
#include <vector>

#include "gui/window_state/displayed_source.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class CentralWidget : public QWidget {
  Q_OBJECT
 public:
  // The settings must outlive it: how much room each view has.
  explicit CentralWidget(QSettings& settings, QWidget* parent = nullptr);

  void add(const CentralViewSpec& offer);
  void add(std::vector<BannerSpec> strips);  // all of them, in their order
  // Once all are there.
  void begin();

  void setPlace(DisplayedSource::Kind place);
  void setComparing(bool on);
  void remember();

 private:
  QSettings& settings_;
  QVBoxLayout* lines_;
  QStackedWidget* pages_;  // start page, or work
  QStackedWidget* work_;   // views, or two recordings that are compared
  QSplitter* views_;
  QVBoxLayout* column_;
  std::vector<QWidget*> below_;
};

}  // namespace palpate::gui
