#include "gui/connect/connect_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QScreen>
#include <QShowEvent>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/connect/ports_page.h"
#include "gui/connect/replay_page.h"
#include "gui/connect/scene_page.h"
#include "gui/connect/stream_page.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/make.h"
#include "gui/widgets/state_mark.h"

namespace palpate::gui {
namespace {

constexpr QSize kConnectDialogUsualSize(840, 500);
constexpr int kKindsWidth = 236;          // [px]
constexpr int kMinKindsHeight = 160;      // [px]
constexpr int kConnectDialogMargin = 20;  // [px]
constexpr QSize kMinimumPage(380, 160);   // [px]

struct KindText {
  const char* name;
  const char* title;
  const char* what;
};

KindText connectDialogTextOf(Connection::Kind kind) {
  switch (kind) {
    case Connection::Kind::kPorts:
      return {"kindPorts", "Hand on &ports", "A real hand: serial adapters or network"};
    case Connection::Kind::kStream:
      return {"kindStream", "Stream of &frames", "Any hand whose values a program sends"};
    case Connection::Kind::kReplay:
      return {"kindReplay", "&Replay of a recording", "Plays a recording as if it were live"};
    case Connection::Kind::kEmulated:
      break;
  }
  return {"kindEmulated", "&Emulated hand", "No hand needed: it grasps simulated objects"};
}

std::size_t connectDialogIndexOf(Connection::Kind kind) {
  std::size_t index = 0;
  while (kAllConnectionKinds[index] != kind) ++index;
  return index;
}

}  // namespace

ConnectDialog::ConnectDialog(const ConnectChoices& choices,
                             PortScan& scan,
                             Ask& ask,
                             QWidget* parent)
    : QDialog(parent),
      scan_(scan),
      ask_(ask),
      last_(choices.last),
      settings_(choices.settings),
      kind_(choices.last.kind) {
  setWindowTitle("Connect");
  ports_ = new PortsPage(scan, this);
  stream_ = new StreamPage(choices.handFolders, scan, ask, this);
  scenes_ = new ScenePage(choices.scenesFolder, ask, this);
  replay_ = new ReplayPage(choices.recentRecordings, ask, this);
  pages_ = new QStackedWidget(this);
  for (const Connection::Kind kind : kAllConnectionKinds)
    pages_->addWidget(kind == Connection::Kind::kPorts      ? static_cast<QWidget*>(ports_)
                      : kind == Connection::Kind::kStream   ? static_cast<QWidget*>(stream_)
                      : kind == Connection::Kind::kEmulated ? static_cast<QWidget*>(scenes_)
                                                            : static_cast<QWidget*>(replay_));
  auto* page = new QWidget(this);
  page->setLayout(inRow({{pages_, 1}}));
  page->layout()->setContentsMargins(
      kConnectDialogMargin, kConnectDialogMargin, kConnectDialogMargin, 16);
  // With large text on a small screen it scrolls; the buttons below stay in sight.
  auto* scroll = new ContentScroll(page, kMinimumPage, this);
  setLayout(
      inColumn({{inRow({makeKinds(), {scroll, 1}}, Space::kNone), 1}, makeFoot()}, Space::kNone));
  connect(ports_, &PortsPage::changed, this, &ConnectDialog::refresh);
  connect(stream_, &StreamPage::changed, this, &ConnectDialog::refresh);
  connect(scenes_, &ScenePage::changed, this, &ConnectDialog::refresh);
  connect(replay_, &ReplayPage::changed, this, &ConnectDialog::refresh);
  fill(last_);
  pages_->setCurrentIndex(static_cast<int>(connectDialogIndexOf(kind_)));
  refresh();
  resize(kConnectDialogUsualSize.expandedTo(sizeHint()).boundedTo(screen()->availableSize()));
}

ConnectDialog::~ConnectDialog() {
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
}

QWidget* ConnectDialog::makeKinds() {
  auto* side = named(new QFrame(this), "connectKinds");
  const ThemeColors& colors = colorsOf();
  side->setStyleSheet(QString("#connectKinds { background: %1; border-right: 1px solid %2; }")
                          .arg(colors.window.name(), colors.border.name()));
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(16, kConnectDialogMargin, 16, 14);
  column->setSpacing(3);
  for (const Connection::Kind kind : kAllConnectionKinds) {
    const KindText text = connectDialogTextOf(kind);
    auto* button = named(new QRadioButton(text.title, side), text.name);
    QFont bold = button->font();
    bold.setBold(true);
    button->setFont(bold);
    connect(button, &QRadioButton::toggled, this, [this, kind](bool on) {
      if (on) choose(kind);
    });
    auto* what = makeLines(side, {}, "muted", text.what);
    what->setContentsMargins(22, 0, 0, 14);
    column->addWidget(button);
    column->addWidget(what);
    kinds_[connectDialogIndexOf(kind)] = button;
  }
  column->addStretch(1);
  if (settings_) column->addWidget(makeSaved());
  calm_ = makeLines(side, "connectIsCalm", "muted");
  column->addWidget(calm_);
  // Names are never cut, however large the text is; with little height the column scrolls.
  side->setMinimumWidth(std::max(kKindsWidth, column->minimumSize().width()));
  auto* scroll = new ContentScroll(side, QSize(0, kMinKindsHeight), this);
  scroll->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
  return scroll;
}

QWidget* ConnectDialog::makeSaved() {
  auto* part = new QWidget(this);
  saved_ = named(
      new QComboBox(part), "savedConnections", "Choose a saved connection to fill in the fields");
  saved_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  auto* save =
      makeButton(part, "saveConnection", "Save &under…", "Save these settings under a name");
  forget_ = makeButton(part, "forgetConnection", "Forget");
  part->setLayout(
      inColumn({makeTitle("Sa&ved connections", saved_), saved_, inRow({save, forget_, Stretch{}})},
               {.bottom = Space::kWide}));
  listSaved(last_.name);
  connect(saved_, &QComboBox::activated, this, [this] {
    const QString name = saved_->currentData().toString();
    forget_->setEnabled(!name.isEmpty());
    if (const auto connection = namedConnection(*settings_, name)) fill(*connection);
  });
  connect(save, &QPushButton::clicked, this, &ConnectDialog::saveUnderName);
  connect(forget_, &QPushButton::clicked, this, [this] {
    removeNamedConnection(*settings_, saved_->currentData().toString());
    listSaved({});
  });
  return part;
}

void ConnectDialog::listSaved(const QString& chosen) {
  saved_->clear();
  const QStringList names = connectionNames(*settings_);
  saved_->addItem(names.isEmpty() ? "none yet" : "choose one", QString());
  for (const QString& name : names) saved_->addItem(name, name);
  saved_->setCurrentIndex(std::max(0, saved_->findData(chosen)));
  saved_->setEnabled(!names.isEmpty());
  forget_->setEnabled(saved_->currentIndex() > 0);
}

void ConnectDialog::saveUnderName() {
  const QString now = saved_->currentData().toString();
  const auto name = ask_.text("Save the connection",
                              "Name of the connection (one of the same name is replaced)",
                              now.isEmpty() ? describe(connection()) : now);
  if (!name || name->isEmpty()) return;
  saveNamedConnection(*settings_, *name, connection());
  listSaved(*name);
}

void ConnectDialog::fill(const Connection& connection) {
  ports_->setPorts(connection.dsaPort, connection.sdhPort);
  stream_->setStream(connection.stream);
  scenes_->setScene(connection.scene);
  scenes_->setRunsScript(connection.sceneScriptRuns);
  replay_->setRecording(connection.recording);
  kinds_[connectDialogIndexOf(connection.kind)]->setChecked(true);
  refresh();
}

QWidget* ConnectDialog::makeFoot() {
  mark_ = new StateMark(this);
  problem_ = makeLines(this, "connectProblem");
  auto* cancel = makeCancel(this, "connectCancel");
  connect_ = makeOk(this, "connectNow", "&Connect");
  connect(connect_, &QPushButton::clicked, this, &QDialog::accept);
  return makeDialogFoot(inRow({mark_, {problem_, 1}, cancel, connect_}, kFootEdges));
}

void ConnectDialog::choose(Connection::Kind kind) {
  kind_ = kind;
  pages_->setCurrentIndex(static_cast<int>(connectDialogIndexOf(kind)));
  if (isVisible() && kind == Connection::Kind::kPorts && !looked_) {
    looked_ = true;
    ports_->look();
  }
  if (isVisible() && kind == Connection::Kind::kStream && !listed_) {
    listed_ = true;
    stream_->look();
  }
  refresh();
}

void ConnectDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  kinds_[connectDialogIndexOf(kind_)]->setFocus();
  choose(kind_);
}

Connection ConnectDialog::connection() const {
  Connection connection = last_;
  connection.kind = kind_;
  connection.dsaPort = ports_->tactilePort();
  connection.sdhPort = ports_->motionPort();
  connection.stream = stream_->stream();
  connection.scene = scenes_->scene();
  connection.sceneScriptRuns = scenes_->runsScript();
  connection.recording = replay_->recording();
  // The chosen saved connection, unless its fields were changed.
  connection.name.clear();
  if (saved_ && saved_->currentIndex() > 0) {
    const QString name = saved_->currentData().toString();
    const auto saved = namedConnection(*settings_, name);
    if (saved && isSameSource(*saved, connection)) connection.name = name;
  }
  return connection;
}

QString ConnectDialog::problem() const {
  const QString missing = problemOf(connection());
  if (!missing.isEmpty()) return missing;
  switch (kind_) {
    case Connection::Kind::kEmulated:
      return scenes_->problem();
    case Connection::Kind::kReplay:
      return replay_->problem();
    case Connection::Kind::kStream:
      return stream_->problem();
    case Connection::Kind::kPorts:
      return ports_->problem();
  }
  return {};
}

void ConnectDialog::refresh() {
  // The dialog is still being built.
  if (!connect_) return;
  calm_->setText(kind_ == Connection::Kind::kEmulated && scenes_->actsByItself()
                     ? "The scene starts as soon as it is connected."
                     : "Connecting never moves the hand.");
  const QString missing = problem();
  problem_->setText(missing);
  mark_->setState(missing.isEmpty() ? StateMark::State::kNone : StateMark::State::kWarning);
  connect_->setEnabled(missing.isEmpty());
  connect_->setToolTip(missing);
}

void ConnectDialog::done(int result) {
  scan_.cancel();
  QDialog::done(result);
}

}  // namespace palpate::gui
