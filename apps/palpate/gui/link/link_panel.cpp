#include "gui/link/link_panel.h"

#include <QCheckBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QTextCursor>
#include <QTextDocument>
#include <QTime>
#include <algorithm>

#include <palpate/core/escaped_line.h>
#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kLinkPanelMostLines = 1000;  // of the log

QString count(std::uint64_t value) { return QString::number(value); }

QString bytes(double value) {
  constexpr double kMega = 1e6, kGiga = 1e9;
  if (value >= kGiga) return figure(value / kGiga, 1) + " GB";
  return figure(value / kMega, 1) + " MB";
}

QString diskText(const LinkHealth& health) {
  if (!health.freeBytes) return "not known";
  QString text = bytes(static_cast<double>(*health.freeBytes)) + " free";
  if (!health.diskHours) return text;
  return text + ", " + QString::fromStdString(diskTimeText(*health.diskHours));
}

QString portText(const PortStatus& port) {
  return nameOf(port.state) + (port.port.empty() ? "" : " · " + QString::fromStdString(port.port));
}

}  // namespace

QString nameOf(PortState state) {
  switch (state) {
    case PortState::kClosed:
      return "closed";
    case PortState::kConnecting:
      return "searching";
    case PortState::kStreaming:
      return "streaming";
    case PortState::kSilent:
      return "silent";
    case PortState::kLost:
      return "disconnected, searching";
    case PortState::kFault:
      return "failed, trying again";
  }
  return {};
}

std::vector<Fact> factsOf(const LinkHealth& health) {
  std::vector<Fact> facts;
  const PortStatus& tactile = health.device.tactile;
  facts.push_back({"tactile", portText(tactile), tactile.state != PortState::kStreaming});
  if (const auto& motion = health.device.motion)
    facts.push_back({"motion", portText(*motion), motion->state != PortState::kStreaming});
  facts.push_back({"rate",
                   figure(health.frames.rateHz, 1) + " frames/s (mean " +
                       figure(health.frames.meanRateHz, 1) + ")",
                   health.frames.lowRateS > 0.0});
  constexpr double kOldMs = 500.0;
  const auto age = health.frames.ageMs;
  const QString ageText = !age              ? QString("no frame yet")
                          : *age >= kMsPerS ? figure(*age / kMsPerS, 1) + " s"
                                            : figure(*age, 0) + " ms";
  facts.push_back({"frame age", ageText, !age || *age > kOldMs});
  facts.push_back({"frames", count(health.frames.frames)});
  facts.push_back({"lost", count(health.lost), health.lost > 0});
  facts.push_back({"bad checksums", count(health.badChecksums), health.badChecksums > 0});
  facts.push_back({"suspect", count(tactile.suspect), tactile.suspect > 0});
  for (const LinkClock& clock : health.clocks)
    facts.push_back(
        {clock.of == "frames" ? QString("clock") : "clock of " + QString::fromStdString(clock.of),
         QString::fromStdString(clockText(clock.report))});
  facts.push_back({"saturated",
                   numberOf(health.frames.saturatedFrames, "frame") + ", " +
                       figure(health.frames.saturatedFraction * 100.0, 0) + " % now",
                   health.frames.saturatedFraction > 0.0});
  const CaptureQueueStats::Port& queue = health.queues.tactile;
  facts.push_back({"queue",
                   QString::number(queue.depth) + " of " + QString::number(queue.capacity) +
                       ", most " + QString::number(queue.highWater),
                   queue.depth > queue.capacity / 2});
  std::uint64_t reconnects = tactile.reconnects;
  if (health.device.motion) reconnects += health.device.motion->reconnects;
  facts.push_back({"reconnects", count(reconnects), reconnects > 0});
  facts.push_back({"disk", diskText(health)});
  const RecorderStatus& recorder = health.recorder;
  if (recorder.state != RecorderStatus::State::kIdle) {
    facts.push_back({"on disk",
                     QString::number(recorder.framesOnDisk) + " of " +
                         QString::number(recorder.frames) + " frames, " +
                         bytes(static_cast<double>(recorder.bytesOnDisk))});
    facts.push_back({"not recorded",
                     QString::number(recorder.lost + recorder.refused),
                     recorder.lost + recorder.refused > 0});
  }
  return facts;
}

std::vector<Fact> factsOf(const StreamDevice& stream) {
  std::vector<Fact> facts;
  if (const std::string notice = stream.notice(); !notice.empty())
    facts.push_back({"senders", QString::fromStdString(notice), stream.isOpenToOthers()});
  const DeviceInfo info = stream.info();
  QString sender = QString::fromStdString(escapedLine(info.serial));
  if (!info.firmware.empty())
    sender += (sender.isEmpty() ? "firmware " : ", firmware ") +
              QString::fromStdString(escapedLine(info.firmware));
  if (!sender.isEmpty()) facts.push_back({"sender", sender});
  if (const std::string fault = stream.lastFault(); !fault.empty())
    facts.push_back({"last refused",
                     QString::fromStdString(escapedLine(fault)),
                     !stream.status().tactile.message.empty()});
  if (const std::string value = stream.lastOutOfRange(); !value.empty())
    facts.push_back({"out of range",
                     QString::fromStdString(counted(stream.status().tactile.outOfRange, "frame")) +
                         ", the last: " + QString::fromStdString(escapedLine(value)),
                     true});
  return facts;
}

std::vector<Fact> factsOf(const SeriesSource& sensor) {
  const SeriesStatus status = sensor.status();
  const PortStatus& port = status.port;
  const QString name = QString::fromStdString(sensor.name());
  QString state = portText(port);
  if (status.rateHz > 0.0) state += ", " + figure(status.rateHz, 1) + " rows/s";
  if (port.lost > 0) state += ", " + numberOf(port.lost, "row") + " lost";
  std::vector<Fact> facts{{name, state, port.state != PortState::kStreaming}};
  if (port.state != PortState::kStreaming && !port.message.empty())
    facts.push_back({name + ": why", QString::fromStdString(escapedLine(port.message)), true});
  if (port.suspect > 0)
    facts.push_back({name + ": refused",
                     numberOf(port.suspect, "line") +
                         ", the last: " + QString::fromStdString(escapedLine(sensor.lastFault())),
                     true});
  if (sensor.isOpenToOthers())
    facts.push_back({name + ": senders", QString::fromStdString(sensor.notice()), true});
  return facts;
}

LinkPanel::LinkPanel(QWidget* parent) : QWidget(parent) {
  check_ = makeLines(this, "preflight");
  check_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  alarms_ = makeLines(this, "linkAlarms");
  sound_ = named(new QCheckBox("Sound for alarms", this), "alarmSound");
  sound_->setFocusPolicy(Qt::TabFocus);
  sound_->setChecked(true);
  connect(sound_, &QCheckBox::toggled, this, [this](bool on) { emit mutedChanged(!on); });
  facts_ = named(new FactsView(this), "linkFacts", {}, "Link");
  others_ = named(new FactsView(this), "otherPrograms", {}, "Other programs");
  log_ = named(new QPlainTextEdit(this), "linkLog");
  log_->setReadOnly(true);
  log_->setLineWrapMode(QPlainTextEdit::WidgetWidth);
  log_->setFrameShape(QFrame::NoFrame);
  log_->setFocusPolicy(Qt::ClickFocus);
  fitToText(*log_, [log = log_] { log->setMinimumHeight(4 * log->fontMetrics().lineSpacing()); });
  log_->setAccessibleName("What happened");

  auto* content = new QWidget(this);
  othersHeading_ = sectionHeading("Other programs", content);
  content->setLayout(inColumn({sectionHeading("Before a run", content),
                               check_,
                               Space::kNarrow,
                               inRow({{sectionHeading("Alarms", content), 1}, sound_}),
                               alarms_,
                               Space::kNarrow,
                               sectionHeading("Link", content),
                               facts_,
                               Space::kNarrow,
                               othersHeading_,
                               others_,
                               sectionHeading("What happened", content),
                               {log_, 1}},
                              kPageEdges));
  auto* area = new QScrollArea(this);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setFocusPolicy(Qt::NoFocus);
  area->setWidget(content);
  setLayout(inColumn({area}));
  showOtherPrograms({});
  clear();
  fitToTheme(*this, [this] {
    const QString alarms = alarms_->text();
    showAlarms(alarms == "none" ? QStringList() : alarms.split('\n'));
    showCheck();
  });
}

void LinkPanel::clear() {
  connected_ = false;
  lastCheck_.reset();
  facts_->setFacts({{"nothing is connected", ""}});
  showAlarms({});
  showCheck();
}

void LinkPanel::showHealth(const LinkHealth& health,
                           const std::optional<PreflightCheck>& check,
                           const std::vector<Fact>& stream) {
  connected_ = true;
  recording_ = health.recorder.state != RecorderStatus::State::kIdle;
  lastCheck_ = check;
  LinkHealth known = health;
  // The recorder measures the free space only while it records.
  if (!known.freeBytes && check) {
    known.freeBytes = check->freeBytes;
    known.diskHours = check->diskHours;
  }
  std::vector<Fact> facts = factsOf(known);
  // Below the state of the ports.
  facts.insert(facts.begin() + (known.device.motion ? 2 : 1), stream.begin(), stream.end());
  if (facts.size() != facts_->facts().size()) {
    facts_->setFacts(std::move(facts));
  } else {
    bool sameRows = true;
    for (std::size_t i = 0; i < facts.size(); ++i)
      sameRows = sameRows && facts[i].warning == facts_->facts()[i].warning &&
                 facts[i].name == facts_->facts()[i].name;
    if (!sameRows)
      facts_->setFacts(std::move(facts));
    else
      for (std::size_t i = 0; i < facts.size(); ++i) facts_->setValue(i, facts[i].value);
  }
  showCheck();
}

void LinkPanel::showCheck() {
  const ThemeColors& colors = colorsOf();
  QString text = "Connect a hand, the emulated hand or a replay first (Ctrl+K).";
  QColor color = colors.muted;
  if (connected_ && lastCheck_) {
    text = QString::fromStdString(lastCheck_->text);
    const bool unmeasurable = lastCheck_->ready && numUnmeasurable_ > 0;
    if (unmeasurable)
      text += "; " + QString::number(numUnmeasurable_) +
              (numUnmeasurable_ == 1 ? " matrix" : " matrices") +
              " can't measure the limit of a grasp";
    color = !lastCheck_->ready                     ? colors.danger
            : lastCheck_->doubtful || unmeasurable ? colors.warning
                                                   : colors.accent;
  } else if (connected_) {
    text = "checking …";
  }
  if (check_->text() != text) check_->setText(text);
  const QString style = "color: " + color.name() + "; font-weight: bold;";
  if (check_->styleSheet() != style) check_->setStyleSheet(style);
}

void LinkPanel::setUnmeasurable(const std::vector<QString>& why) {
  numUnmeasurable_ = static_cast<std::size_t>(
      std::count_if(why.begin(), why.end(), [](const QString& each) { return !each.isEmpty(); }));
  showCheck();
}

void LinkPanel::showAlarms(const QStringList& alarms) {
  const ThemeColors& colors = colorsOf();
  alarms_->setText(alarms.isEmpty() ? "none" : alarms.join('\n'));
  alarms_->setStyleSheet("color: " + (alarms.isEmpty() ? colors.muted : colors.danger).name() +
                         ";");
}

void LinkPanel::showOtherPrograms(std::vector<Fact> facts) {
  othersHeading_->setVisible(!facts.empty());
  others_->setVisible(!facts.empty());
  if (facts.size() != others_->facts().size())
    others_->setFacts(std::move(facts));
  else
    for (std::size_t i = 0; i < facts.size(); ++i)
      if (facts[i].name == others_->facts()[i].name)
        others_->setValue(i, facts[i].value);
      else
        return others_->setFacts(std::move(facts));
}

void LinkPanel::addEvent(const Event& event) {
  log(QString::fromStdString(event.kind) +
      (event.text.empty() ? QString() : ": " + QString::fromStdString(event.text)));
}

void LinkPanel::log(const QString& line) {
  // The newest line is the first one: the others are below the edge of a low window.
  const QString now = QTime::currentTime().toString("HH:mm:ss") + "  " + line.simplified();
  QTextCursor cursor(log_->document());
  cursor.insertText(log_->document()->isEmpty() ? now : now + "\n");
  while (log_->blockCount() > kLinkPanelMostLines) {
    cursor.movePosition(QTextCursor::End);
    cursor.select(QTextCursor::BlockUnderCursor);
    cursor.removeSelectedText();
  }
  emit logged(line);
}

void LinkPanel::setMuted(bool muted) { sound_->setChecked(!muted); }

}  // namespace palpate::gui
