// How the window looks: theme, colours, range, the signal that is plotted. Remembered from one day
// to the next.
#pragma once

#include <QObject>
#include <QSettings>
#include <functional>

#include "gui/appearance/window_settings.h"

namespace palpate::gui {

class ViewAppearance : public QObject {
  Q_OBJECT
 public:
  // The settings must outlive it.
  explicit ViewAppearance(QSettings& settings, QObject* parent = nullptr)
      : QObject(parent), settings_(settings), view_(loadViewSettings(settings)) {}

  const ViewSettings& view() const noexcept { return view_; }
  Theme theme() const { return resolved(view_.theme); }

  void change(const std::function<void(ViewSettings&)>& change) {
    change(view_);
    emit changed();
  }
  void setTheme(ThemeChoice choice) {
    view_.theme = choice;
    emit themeChanged();
    emit changed();
  }
  // Writes it to the settings, with what the playback is set to.
  void remember(double speed, bool loop, bool skipGaps) {
    view_.speed = speed;
    view_.loop = loop;
    view_.skipGaps = skipGaps;
    saveViewSettings(view_, settings_);
  }

 signals:
  void themeChanged();
  void changed();  // anything of view()

 private:
  QSettings& settings_;
  ViewSettings view_;
};

}  // namespace palpate::gui
