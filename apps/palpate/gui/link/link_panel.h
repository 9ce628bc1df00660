// The content of the dock Link: is everything ready for a run, how does the line do, what is wrong,
// what happened.
#pragma once

#include <QScrollArea>
#include <optional>
#include <vector>

#include <palpate/capture/link_health.h>
#include <palpate/recording/recording_event.h>

#include "gui/appearance/theme.h"
#include "gui/widgets/facts_view.h"

class QCheckBox;
class QLabel;
class QPlainTextEdit;

namespace palpate::gui {

// The state of a port for a person: "streaming", "silent for 2 s", ..
QString nameOf(PortState state);
// What is known of the link, row by row: for the dock and for tests.
std::vector<Fact> factsOf(const LinkHealth& health);

class LinkPanel : public QWidget {
  Q_OBJECT
 public:
  explicit LinkPanel(QWidget* parent = nullptr);
  // Nothing is connected; what was logged stays.
  void clear();
  void showHealth(const LinkHealth& health, const std::optional<PreflightCheck>& check);
  void showAlarms(const QStringList& alarms);
  // What is open to other programs; empty: nothing, and nothing of it is seen.
  void showOtherPrograms(std::vector<Fact> facts);
  void addEvent(const RecordingEvent& event);
  // A line of the window's own: "connected to ..".
  void log(const QString& line);
  void setMuted(bool muted);
  void setTheme(Theme theme);
  QSize sizeHint() const override { return {455, 420}; }

 signals:
  void logged(const QString& line);
  void mutedChanged(bool muted);

 private:
  void showCheck();

  QLabel* check_;
  QLabel* alarms_;
  QCheckBox* sound_;
  FactsView* facts_;
  QLabel* othersHeading_;
  FactsView* others_;
  QPlainTextEdit* log_;
  std::optional<PreflightCheck> lastCheck_;
  bool recording_ = false;
  bool connected_ = false;
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
