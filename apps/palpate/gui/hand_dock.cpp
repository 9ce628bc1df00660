#include "gui/hand_dock.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <algorithm>

#include <palpate/capture/link_health.h>

#include "gui/captions.h"
#include "gui/facts_view.h"
#include "gui/grasp_panel.h"
#include "gui/sensitivity_modes.h"
#include "gui/stop_key.h"
#include "gui/tactile_settings_panel.h"

namespace palpate::gui {
namespace {

constexpr int kHandDockRefreshMs = 50;
constexpr int kHandDockMargin = 12;
constexpr const char* kHandDockNothing = "–";

FeedOptions smallFeed() {
  FeedOptions options;
  options.tactileItems = 256;
  options.motionItems = 256;
  options.eventItems = 64;
  return options;
}

}  // namespace

HandDock::HandDock(QSettings& settings, QWidget* parent) : QWidget(parent) {
  stopKey_ = new StopKey(this);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(makeHead());
  column->addWidget(makeBody(settings), 1);
  connect(stop_, &QPushButton::clicked, this, [this] {
    if (control_) control_->stop();
    emit stopPressed();
    refresh();
  });
  connect(stopKey_, &StopKey::pressed, this, &HandDock::stopPressed);
  const auto refused = [this](const QString& why) { said_ = why; };
  connect(grasp_, &GraspPanel::refused, this, refused);
  connect(grasp_, &GraspPanel::asked, this, &HandDock::refresh);
  connect(tactile_, &TactileSettingsPanel::refused, this, refused);
  connect(sensitivity_, &SensitivityModes::refused, this, refused);
  connect(tactile_, &TactileSettingsPanel::changedByHand, sensitivity_, &SensitivityModes::letGo);
  timer_.setInterval(kHandDockRefreshMs);
  connect(&timer_, &QTimer::timeout, this, &HandDock::refresh);
  setHand(nullptr, nullptr);
}

HandDock::~HandDock() = default;

QWidget* HandDock::makeHead() {
  auto* head = new QWidget(this);
  state_ = new QLabel(head);
  state_->setObjectName("handState");
  state_->setWordWrap(true);
  state_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  state_->setMinimumHeight(2 * fontMetrics().lineSpacing());
  stop_ = new QPushButton("Stop  (Esc)", head);
  stop_->setObjectName("stopHand");
  stop_->setProperty("danger", true);
  stop_->setToolTip(
      "Stops the hand now; the motors stay on and hold (Esc, wherever the keyboard is)");
  stop_->setFocusPolicy(Qt::TabFocus);
  stop_->setMinimumHeight(40);
  stop_->setMinimumWidth(120);
  heat_ = new QLabel(head);
  heat_->setObjectName("handHeat");
  heat_->setWordWrap(true);
  auto* row = new QHBoxLayout;
  row->setSpacing(12);
  row->addWidget(state_, 1);
  row->addWidget(stop_);
  auto* column = new QVBoxLayout(head);
  column->setContentsMargins(kHandDockMargin, 10, kHandDockMargin, 8);
  column->setSpacing(6);
  column->addLayout(row);
  column->addWidget(heat_);
  return head;
}

QWidget* HandDock::makeBody(QSettings& settings) {
  auto* area = new QScrollArea(this);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setFocusPolicy(Qt::NoFocus);
  auto* content = new QWidget(area);
  grasp_ = new GraspPanel(settings, content);
  sensitivity_ = new SensitivityModes(content);
  tactile_ = new TactileSettingsPanel(settings, content);
  angles_ = new FactsView(content);
  angles_->setObjectName("liveAngles");
  temperatures_ = new FactsView(content);
  temperatures_->setObjectName("liveTemperatures");
  auto* left = new QVBoxLayout;
  left->setSpacing(4);
  left->addWidget(sectionHeading("Joint angles", content));
  left->addWidget(angles_);
  left->addStretch(1);
  auto* right = new QVBoxLayout;
  right->setSpacing(4);
  right->addWidget(sectionHeading("Temperatures", content));
  right->addWidget(temperatures_);
  right->addStretch(1);
  auto* measured = new QHBoxLayout;
  measured->setSpacing(20);
  measured->addLayout(left, 1);
  measured->addLayout(right, 1);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(kHandDockMargin, 4, kHandDockMargin, 10);
  column->setSpacing(8);
  column->addWidget(sectionHeading("Grasp", content));
  column->addWidget(grasp_);
  column->addSpacing(8);
  column->addWidget(sectionHeading("Matrices", content));
  column->addWidget(sensitivity_);
  column->addWidget(tactile_);
  column->addSpacing(8);
  column->addLayout(measured);
  column->addStretch(1);
  area->setWidget(content);
  body_ = area;
  return area;
}

// Nothing is cut off at the side, where it can't be scrolled: only what is shown knows how wide it is.
void HandDock::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  body_->setMinimumWidth(body_->widget()->minimumSizeHint().width() +
                         body_->verticalScrollBar()->sizeHint().width());
}

void HandDock::setHand(CaptureSession* session, GraspControl* control) {
  session_ = session;
  control_ = control;
  said_.clear();
  feed_ = session ? session->subscribe("the dock Hand", smallFeed()) : nullptr;
  grasp_->setControl(control);
  sensitivity_->setHand(session, control);
  tactile_->setHand(session, control);
  stopKey_->setControl(control);
  stop_->setEnabled(control != nullptr);
  const HandDescription hand = session ? session->device().hand() : sdh2();
  std::vector<Fact> facts;
  for (const AxisDescription& axis : hand.axes)
    facts.push_back({QString::fromStdString(axis.name), kHandDockNothing});
  angles_->setFacts(std::move(facts));
  facts.clear();
  for (const TemperatureSensorDescription& sensor : hand.temperatureSensors)
    facts.push_back({QString::fromStdString(sensor.name), kHandDockNothing});
  temperatures_->setFacts(std::move(facts));
  heat_->hide();
  if (session)
    timer_.start();
  else
    timer_.stop();
  refresh();
}

void HandDock::refresh() {
  const GraspStatus status = control_ ? control_->status() : GraspStatus{};
  grasp_->showStatus(status);
  sensitivity_->refresh();
  tactile_->refresh(status);
  showState(status);
  showSamples();
}

void HandDock::say(const QString& text, bool bad) {
  if (state_->text() != text) state_->setText(text);
  const QColor color = bad ? colorsOf(theme_).danger : colorsOf(theme_).text;
  const QString style = "color: " + color.name() + ";";
  if (state_->styleSheet() != style) state_->setStyleSheet(style);
}

void HandDock::showState(const GraspStatus& status) {
  if (!session_) return say("No hand is connected.", false);
  if (!control_) return say("A recording is replayed: there is nothing to move.", false);
  if (status.phase != GraspPhase::kIdle) {
    said_.clear();
    const std::string_view phase = nameOf(status.phase);
    return say(QString::fromUtf8(phase.data(), static_cast<qsizetype>(phase.size())) + " · " +
                   QString::fromStdString(status.request ? describe(*status.request) : ""),
               false);
  }
  if (!status.cannotMove.empty())
    return say("The hand can't move: " + QString::fromStdString(status.cannotMove), true);
  if (!said_.isEmpty()) return say(said_, true);
  if (!status.last) return say("Ready.", false);
  switch (status.last->outcome) {
    case GraspOutcome::kFinished:
    case GraspOutcome::kLimitReached:
    case GraspOutcome::kStopped:
    case GraspOutcome::kRelaxed:
      return say(QString::fromStdString(status.last->text), false);
    default:
      return say(QString::fromStdString(status.last->text), true);
  }
}

void HandDock::showSamples() {
  if (!feed_) return;
  items_.clear();
  feed_->take(items_);
  const JointAngles* angles = nullptr;
  const Temperatures* temperatures = nullptr;
  for (const CaptureItem& item : items_) {
    if (const auto* sample = std::get_if<JointAngles>(&item)) angles = sample;
    if (const auto* sample = std::get_if<Temperatures>(&item)) temperatures = sample;
  }
  if (angles)
    for (std::size_t i = 0; i < std::min(angles->deg.size(), angles_->facts().size()); ++i)
      angles_->setValue(i, figure(angles->deg[i], 1) + "°");
  if (temperatures) showTemperatures(*temperatures);
  items_.clear();
}

void HandDock::showTemperatures(const Temperatures& temperatures) {
  const double hottest = HealthOptions{}.hottestDegC;
  std::vector<Fact> facts = temperatures_->facts();
  QString hot;
  for (std::size_t i = 0; i < std::min(temperatures.degC.size(), facts.size()); ++i) {
    const double value = temperatures.degC[i];
    facts[i].value = value == 0.0 ? QString(kHandDockNothing) : figure(value, 1) + " °C";
    facts[i].warning = value > hottest;
    if (facts[i].warning) hot += (hot.isEmpty() ? "" : ", ") + facts[i].name + " " + facts[i].value;
  }
  temperatures_->setFacts(std::move(facts));
  heat_->setVisible(!hot.isEmpty());
  heat_->setText("Too hot: " + hot + ". Relax the hand and let it cool below " +
                 figure(hottest, 0) + " °C.");
}

void HandDock::setTheme(Theme theme) {
  theme_ = theme;
  tactile_->setTheme(theme);
  angles_->setTheme(theme);
  temperatures_->setTheme(theme);
  heat_->setStyleSheet("color: " + colorsOf(theme).warning.name() + "; font-weight: bold;");
  state_->setStyleSheet({});
  refresh();
}

}  // namespace palpate::gui
