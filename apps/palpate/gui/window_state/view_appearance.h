// Holds how the window looks (theme, colours, range, the plotted signal, units) and stores it in
// the settings for the next start.
#pragma once

#include <QObject>
#include <QSettings>
#include <functional>

#include "gui/appearance/window_settings.h"

namespace palpate::gui {

class ViewAppearance : public QObject {
  Q_OBJECT
 public:
  // The settings must outlive this object.
  explicit ViewAppearance(QSettings& settings, QObject* parent = nullptr)
      : QObject(parent), settings_(settings), view_(loadViewSettings(settings)) {}

  const ViewSettings& view() const noexcept { return view_; }
  Theme theme() const { return resolved(view_.theme); }

  void change(const std::function<void(ViewSettings&)>& change) {
    change(view_);
    emit changed();
  }
  // Written to the settings at once, so that it is there after a crash, too.
  void setTheme(ThemeChoice choice) {
    view_.theme = choice;
    saveViewSettings(view_, settings_);
    emit themeChanged();
    emit changed();
  }
  void setUnits(const DisplayUnits& units) {
    if (units == view_.units) return;
    view_.units = units;
    emit unitsChanged();
    emit changed();
  }
  // The space right of the time axis that the charts in one column leave [px], so that the axes end
  // at the same place; 0: each as it needs.
  int timeAxisRight() const noexcept { return timeAxisRight_; }
  void setTimeAxisRight(int px) {
    if (px == timeAxisRight_) return;
    timeAxisRight_ = px;
    emit timeAxisChanged();
  }
  // Writes the appearance to the settings, together with the settings of the playback.
  void remember(double speed, bool loop, bool skipGaps) {
    view_.speed = speed;
    view_.loop = loop;
    view_.skipGaps = skipGaps;
    saveViewSettings(view_, settings_);
  }

 signals:
  void themeChanged();
  // Values are shown in other units.
  void unitsChanged();
  // Any member of view() has changed.
  void changed();
  void timeAxisChanged();

 private:
  QSettings& settings_;
  ViewSettings view_;
  int timeAxisRight_ = 0;
};

}  // namespace palpate::gui
