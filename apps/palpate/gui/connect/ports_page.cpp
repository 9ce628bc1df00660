#include "gui/connect/ports_page.h"

#include <QFrame>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <filesystem>
#include <system_error>

#include "gui/widgets/make.h"
#include "gui/widgets/state_mark.h"

namespace palpate::gui {
namespace {

using PortsPageState = StateMark::State;

QString portsPageShortName(const QString& port) {
  return port.startsWith('/') ? port.section('/', -1) : port;
}

QString sentence(const std::string& text) {
  QString line = QString::fromStdString(text);
  if (!line.isEmpty()) line[0] = line[0].toUpper();
  return line;
}

}  // namespace

PortsPage::PortsPage(PortScan& scan, QWidget* parent) : QWidget(parent), scan_(scan) {
  tactile_ = new PortField(
      "&Tactile controller", "None: the hand can move, but no pressure is shown.", "tactile", this);
  motion_ = new PortField("&Motion controller",
                          "None: pressure is shown and recorded, but the hand can't be moved.",
                          "motion",
                          this);
  help_ = makeLines(this, "portsHelp");
  help_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  setLayout(
      inColumn({tactile_, motion_, makeSwapRow(), help_, Stretch{}, makeLookRow()}, Space::kWide));
  for (PortField* field : {tactile_, motion_}) {
    connect(field, &PortField::changed, this, &PortsPage::refresh);
    connect(field, &PortField::entered, this, [this, field] {
      if (field->touched()) askTyped(field->port());
    });
  }
  connect(&scan_, &PortScan::listed, this, &PortsPage::takeList);
  connect(&scan_, &PortScan::probed, this, &PortsPage::takeProbe);
  connect(&scan_, &PortScan::finished, this, &PortsPage::refresh);
  refresh();
}

PortsPage::~PortsPage() {
  tactile_->disconnect(this);
  motion_->disconnect(this);
}

QWidget* PortsPage::makeSwapRow() {
  swapRow_ = named(new QFrame(this), "swapRow");
  const ThemeColors& colors = colorsOf();
  swapRow_->setStyleSheet(QString("#swapRow { background: %1; border: 1px solid %2; "
                                  "border-radius: 6px; }")
                              .arg(colors.dangerSoft.name(), colors.danger.name()));
  swapText_ = makeLines(swapRow_, "swapText");
  auto* swap = makeButton(swapRow_, "swapPorts", "&Swap");
  connect(swap, &QPushButton::clicked, this, [this] {
    setPorts(motion_->port(), tactile_->port());
    fill();
  });
  swapRow_->setLayout(inRow({{swapText_, 1}, swap},
                            Space::kWide,
                            {.left = Space::kWide,
                             .top = Space::kUsual,
                             .right = Space::kUsual,
                             .bottom = Space::kUsual}));
  return swapRow_;
}

QWidget* PortsPage::makeLookRow() {
  auto* line = new QWidget(this);
  look_ = makeButton(
      line, "lookAgain", "Search &again", "List the ports again and check the device at each");
  connect(look_, &QPushButton::clicked, this, &PortsPage::look);
  progress_ = named(new QProgressBar(line), "portsProgress");
  progress_->setTextVisible(false);
  progress_->setFixedSize(120, 8);
  QSizePolicy keeps = progress_->sizePolicy();
  keeps.setRetainSizeWhenHidden(true);
  progress_->setSizePolicy(keeps);
  progressText_ = makeLabel(line, "portsProgressText", "muted");
  line->setLayout(inRow({{progressText_, 1}, progress_, look_}, Space::kWide));
  return line;
}

void PortsPage::setPorts(const QString& tactile, const QString& motion) {
  filled_.clear();
  tactile_->setPort(tactile);
  motion_->setPort(motion);
}

QString PortsPage::problem() const {
  // An absent or held port may come or be let go: the window waits for it. A file stays a file.
  for (const PortField* field : {tactile_, motion_}) {
    std::error_code none;
    if (std::filesystem::is_regular_file(field->port().toStdString(), none))
      return field->port() + " is a file, not a port: choose a port of the list.";
  }
  const QString tactile = keyOf(tactile_->port());
  if (!swapText().isEmpty()) return "Swap the ports, or choose others.";
  if (tactile.isEmpty() || tactile != keyOf(motion_->port())) return {};
  return "These are two names of the same port: tactile and motion controller need different ones.";
}

void PortsPage::look() {
  if (scan_.running()) return;
  answers_.clear();
  asking_.clear();
  scan_.scan();
  refresh();
}

void PortsPage::takeList(const QList<ScannedPort>& ports) {
  looked_ = true;
  ports_ = ports;
  tactile_->setChoices(ports);
  motion_->setChoices(ports);
  for (const ScannedPort& port : ports)
    if (port.notAsked.isEmpty()) asking_.insert(QString::fromStdString(port.info.name));
  // The ports of the last connection may not be listed.
  askTyped(tactile_->port());
  askTyped(motion_->port());
  refresh();
}

void PortsPage::askTyped(const QString& port) {
  const QString key = keyOf(port);
  if (key.isEmpty() || !looked_ || listed(key) || asking_.contains(key) || answers_.contains(key))
    return;
  asking_.insert(key);
  scan_.ask(port);
  refresh();
}

void PortsPage::takeProbe(const QString& port, const PortProbe& probe) {
  const QString key = keyOf(port);
  asking_.remove(key);
  answers_.insert(key, probe);
  fill();
  refresh();
}

void PortsPage::fill() {
  fill(*tactile_, *motion_, PortAnswer::kTactile);
  fill(*motion_, *tactile_, PortAnswer::kMotion);
}

void PortsPage::fill(PortField& field, const PortField& other, PortAnswer wanted) {
  if (field.touched()) return;
  // Keeps the port of the last connection, unless it no longer exists.
  const std::optional<PortProbe> present = probeOf(field);
  const bool gone =
      present && present->answer == PortAnswer::kNotFound && !field.port().startsWith("tcp:");
  if (!field.port().isEmpty() && !gone && !filled_.contains(&field)) return;
  const ScannedPort* found = nullptr;
  int count = 0;
  for (const ScannedPort& port : ports_) {
    const QString key = QString::fromStdString(port.info.name);
    const auto answer = answers_.constFind(key);
    if (answer == answers_.constEnd() || answer->answer != wanted || key == keyOf(other.port()))
      continue;
    found = &port;
    ++count;
  }
  if (count == 0) return;
  filled_.insert(&field);
  // With several hands, the user must choose.
  const QString port = count == 1 ? QString::fromStdString(found->info.stableName) : QString();
  if (field.port() != port) field.setPort(port);
}

void PortsPage::refresh() {
  for (qsizetype i = 0; i < ports_.size(); ++i) {
    const ScannedPort& port = ports_[i];
    const QString key = QString::fromStdString(port.info.name);
    QStringList parts;
    if (port.info.stableName != port.info.name) parts.append(portsPageShortName(key));
    if (answers_.contains(key))
      parts.append(QString::fromStdString(answers_[key].message));
    else
      parts.append(asking_.contains(key) ? "asking…" : port.notAsked);
    if (!port.info.description.empty()) parts.append(QString::fromStdString(port.info.description));
    parts.removeAll(QString());
    for (PortField* field : {tactile_, motion_})
      field->setDetail(static_cast<int>(i), parts.join(" · "));
  }
  tactile_->showState(stateOf(*tactile_, PortAnswer::kTactile));
  motion_->showState(stateOf(*motion_, PortAnswer::kMotion));
  swapText_->setText(swapText());
  swapRow_->setVisible(!swapText_->text().isEmpty());
  help_->setText(helpText());
  help_->setVisible(!help_->text().isEmpty());
  const bool running = scan_.running();
  const auto answered = static_cast<int>(answers_.size());
  const auto all = answered + static_cast<int>(asking_.size());
  // A disabled button would pass the keyboard focus on to the choice of another kind of hand.
  if (running && look_->hasFocus()) tactile_->box()->setFocus();
  look_->setEnabled(!running);
  progress_->setVisible(running);
  // With no known port, the bar shows a busy state.
  progress_->setRange(0, all);
  progress_->setValue(answered);
  if (!running)
    progressText_->setText("");
  else if (all == 0)
    progressText_->setText("Searching for ports…");
  else
    progressText_->setText(QString("Checking the ports: %1 of %2…").arg(answered).arg(all));
  emit changed();
}

// The listed name of the port's device; else the name as given.
QString PortsPage::keyOf(const QString& port) const {
  for (const ScannedPort& each : ports_)
    if (port == QString::fromStdString(each.info.name) ||
        port == QString::fromStdString(each.info.stableName))
      return QString::fromStdString(each.info.name);
  const QString device = deviceOf(port);
  for (const ScannedPort& each : ports_)
    if (device == QString::fromStdString(each.info.name)) return device;
  return port;
}

const ScannedPort* PortsPage::listed(const QString& key) const {
  for (const ScannedPort& each : ports_)
    if (key == QString::fromStdString(each.info.name)) return &each;
  return nullptr;
}

std::optional<PortProbe> PortsPage::probeOf(const PortField& field) const {
  const auto answer = answers_.constFind(keyOf(field.port()));
  if (answer == answers_.constEnd()) return std::nullopt;
  return *answer;
}

PortFieldState PortsPage::stateOf(const PortField& field, PortAnswer wanted) const {
  if (field.port().isEmpty())
    return scan_.running() && !field.touched()
               ? PortFieldState{PortsPageState::kAtWork, "Searching…"}
               : PortFieldState{};
  const QString key = keyOf(field.port());
  if (const auto probe = probeOf(field)) {
    const bool other =
        probe->answer == PortAnswer::kMotion || probe->answer == PortAnswer::kTactile;
    const bool ours = probe->answer == PortAnswer::kBusy && scan_.isBusy(field.port());
    const PortsPageState mark = probe->answer == wanted ? PortsPageState::kGood
                                : ours                  ? PortsPageState::kNone
                                : other                 ? PortsPageState::kBad
                                                        : PortsPageState::kWarning;
    return {mark, sentence(probe->message)};
  }
  if (asking_.contains(key)) return {PortsPageState::kAtWork, "Checking…"};
  const ScannedPort* port = listed(key);
  if (port && !port->notAsked.isEmpty())
    return {port->info.writable && port->info.readable ? PortsPageState::kNone
                                                       : PortsPageState::kWarning,
            sentence(port->notAsked.toStdString())};
  return {PortsPageState::kNone, "Not checked yet."};
}

QString PortsPage::swapText() const {
  const auto tactile = probeOf(*tactile_).value_or(PortProbe{});
  const auto motion = probeOf(*motion_).value_or(PortProbe{});
  if (keyOf(tactile_->port()) == keyOf(motion_->port()) || describeSwap(tactile, motion).empty())
    return {};
  const bool motionAtTactile = tactile.answer == PortAnswer::kMotion;
  const bool tactileAtMotion = motion.answer == PortAnswer::kTactile;
  if (motionAtTactile && tactileAtMotion)
    return "The ports are swapped: each belongs to the other controller.";
  if (motionAtTactile) return "The motion controller is on the port chosen for the tactile one.";
  return "The tactile controller is on the port chosen for the motion one.";
}

QString PortsPage::helpText() const {
  if (!looked_ || scan_.running()) return {};
  if (ports_.isEmpty() && tactile_->port().isEmpty() && motion_->port().isEmpty())
    return "No serial port was found. Plug in the adapters of the hand and search again; type a "
           "name "
           "such as tcp:HOST:PORT for a hand on the network; or choose the emulated hand on the "
           "left.\n\nPorts belong to the group dialout: sudo adduser $USER dialout, then log in "
           "again.";
  for (const auto& [answer, what] :
       {std::pair(PortAnswer::kTactile, "tactile"), std::pair(PortAnswer::kMotion, "motion")}) {
    int count = 0;
    for (const PortProbe& probe : answers_) count += probe.answer == answer ? 1 : 0;
    const PortField& field = answer == PortAnswer::kTactile ? *tactile_ : *motion_;
    if (count > 1 && field.port().isEmpty())
      return QString("%1 %2 controllers answer: choose the one of your hand.").arg(count).arg(what);
  }
  return {};
}

}  // namespace palpate::gui
