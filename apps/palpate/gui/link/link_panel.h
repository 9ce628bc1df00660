// The content of the dock Link: whether everything is ready for a recording, the health of the
// connection, alarms, and a log of events.
#pragma once

#include <QScrollArea>
#include <optional>
#include <vector>

#include <palpate/capture/link_health.h>
#include <palpate/device/stream_device.h>
#include <palpate/model/event.h>

#include "gui/appearance/theme.h"
#include "gui/widgets/facts_view.h"

class QCheckBox;
class QLabel;
class QPlainTextEdit;

namespace palpate::gui {

// The state of a port in words: "streaming", "silent for 2 s", ..
QString nameOf(PortState state);
// What is known about the link, one row for each fact; for the dock and for tests.
std::vector<Fact> factsOf(const LinkHealth& health);
// Where senders of a stream are awaited and from which machines, who sends, and what was refused
// last.
std::vector<Fact> factsOf(const StreamDevice& stream);
// Of an added sensor: its state, rate and senders, and what it sends that can't be read.
std::vector<Fact> factsOf(const SeriesSource& sensor);

class LinkPanel : public QWidget {
  Q_OBJECT
 public:
  explicit LinkPanel(QWidget* parent = nullptr);
  // Shows that nothing is connected; the log is kept.
  void clear();
  // `stream`: what factsOf() tells of the stream that is received and of added sensors.
  void showHealth(const LinkHealth& health,
                  const std::optional<PreflightCheck>& check,
                  const std::vector<Fact>& stream = {});
  // `why`: as DerivedResults::unmeasurable(). A link that is ready is doubtful then: it can be
  // recorded, but these matrices stop no grasp.
  void setUnmeasurable(const std::vector<QString>& why);
  void showAlarms(const QStringList& alarms);
  // Shows which interfaces are open to other programs; an empty list hides this part.
  void showOtherPrograms(std::vector<Fact> facts);
  void addEvent(const Event& event);
  // Adds a message of the window itself: "connected to ..".
  void log(const QString& line);
  void setMuted(bool muted);
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
  std::size_t numUnmeasurable_ = 0;
  bool recording_ = false;
  bool connected_ = false;
};

}  // namespace palpate::gui
