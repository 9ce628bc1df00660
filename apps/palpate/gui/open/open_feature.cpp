#include "gui/open/open_feature.h"

#include <QComboBox>
#include <QDate>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QLocale>
#include <QMenu>
#include <QMimeData>
#include <QTimer>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/appearance/icons.h"
#include "gui/appearance/window_settings.h"
#include "gui/open/session_storage.h"
#include "gui/open/start_page.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {

OpenActions::OpenActions(ActionRegistry& book) {
  open = book.make("open", "File", "&Open…", {key("Ctrl+O")});
  openDemo = book.make("openDemo", "File", "Open the &demo recording");
  nextRecording = book.make("nextRecording", "File", "&Next open recording", {key("Ctrl+Tab")});
  previousRecording =
      book.make("previousRecording", "File", "&Previous open recording", {key("Ctrl+Shift+Tab")});
  closeRecording = book.make("closeRecording", "File", "&Close recording", {key("Ctrl+W")});
  open->setIconText(" " + plainText(*open));
  open->setIcon(makeIcon(IconShape::kOpen));
}

namespace {

std::vector<std::filesystem::path> localFiles(const QMimeData& data) {
  std::vector<std::filesystem::path> files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files.emplace_back(url.toLocalFile().toStdString());
  return files;
}

QString nameAndDate(const OpenedRecording& recording) {
  if (recording.profile.numFrames() == 0) return fileNameOf(recording) + " · empty";
  // Times that count from the begin of a measurement, as imported ones may do, have no date.
  constexpr std::int64_t kYearUs = 365LL * 86'400'000'000;
  if (recording.profile.frameTimeUs(0) < kYearUs) return fileNameOf(recording);
  const std::string date = utcText(recording.profile.frameTimeUs(0)).substr(0, 10);
  return fileNameOf(recording) + " · " + QString::fromStdString(date);
}

bool hasDemo(const WindowState& windowState) {
  std::error_code ignored;
  return std::filesystem::exists(windowState.demoRecording(), ignored);
}

}  // namespace

OpenFeature::OpenFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      actions_(windowState.actions),
      thumbnails_(cacheFolder(windowState.settings) + "/thumbnails"),
      startPage_(new StartPage(windowState.recent, thumbnails_, hasDemo(windowState), window)),
      strip_(new OpeningStrip(window)) {
  actions_.openDemo->setVisible(hasDemo(windowState));
  actions_.openDemo->setEnabled(hasDemo(windowState));
  windowState.showPlanLeft = [this](const QString& left) { startPage_->setPlan(left); };
  connectOpener();
  connectActions();
  window->installEventFilter(this);
}

void OpenFeature::connectOpener() {
  WindowState& windowState = state();
  RecordingOpener& opener = windowState.opener;
  connect(&opener, &RecordingOpener::started, strip_, &OpeningStrip::begin);
  connect(&opener, &RecordingOpener::progressed, strip_, &OpeningStrip::setProgress);
  connect(&opener, &RecordingOpener::finished, strip_, &OpeningStrip::end);
  connect(
      &opener, &RecordingOpener::failed, this, [&windowState](const QString&, const QString& why) {
        windowState.messages.fail(why);
      });
  connect(&opener, &RecordingOpener::cancelled, this, [&windowState](const QString& path) {
    windowState.messages.flash("opening " + QFileInfo(path).fileName() + " was cancelled");
  });
  connect(strip_, &OpeningStrip::cancelRequested, &opener, &RecordingOpener::cancel);
  connect(&windowState.recordings, &OpenRecordings::arrived, this, &OpenFeature::take);
  connect(&windowState.recordings,
          &OpenRecordings::openAlready,
          this,
          [&windowState](const OpenedRecordingPtr& known, const std::filesystem::path& asked) {
            const QString name = fileNameOf(*known);
            const QString askedName = QFileInfo(pathText(asked)).fileName();
            windowState.messages.flash(askedName + " is open already" +
                                       (askedName == name ? QString() : " as " + name));
          });
  connect(&windowState.recordings,
          &OpenRecordings::gone,
          this,
          [&windowState](const OpenedRecordingPtr& gone) {
            windowState.displayed.replace(gone, windowState.recordings.at(gone->path));
          });
  connect(&windowState.displayed, &DisplayedSource::changed, this, [this, &windowState] {
    listRecordings();
    showLastConnection();
    const OpenedRecordingPtr recording = windowState.displayed.recorded();
    if (recording && recording->profile.numFrames() == 0)
      windowState.messages.fail(fileNameOf(*recording) + ": contains no frames");
  });
  windowState.escapeHandler.add(EscapeHandler::Order::kOpening, [&opener] {
    if (!opener.busy()) return false;
    opener.cancel();
    return true;
  });
}

void OpenFeature::connectActions() {
  WindowState& windowState = state();
  OpenActions& actions = actions_;
  on(actions.open, [&windowState] { windowState.askAndOpen(); });
  on(actions.openDemo, [this] { openDemoRecording(); });
  on(actions.nextRecording, [this] { showNeighbour(1); });
  on(actions.previousRecording, [this] { showNeighbour(-1); });
  on(actions.closeRecording, [this] { closeCurrent(); });
  connect(windowState.menus.recent, &QMenu::aboutToShow, this, [this, &windowState] {
    windowState.recent.look();
    fillRecentMenu();
  });
  connect(&windowState.recent, &RecentFiles::changed, this, [this, &windowState] {
    thumbnails_.keepOnly(windowState.recent.paths());
    if (windowState.menus.recent->isVisible()) fillRecentMenu();
  });
  connect(windowState.menus.recordings, &QComboBox::activated, this, [&windowState](int index) {
    windowState.displayed.show(windowState.recordings.all().at(static_cast<std::size_t>(index)));
  });
  windowState.actionEnabler.add({actions.closeRecording},
                                [&windowState] { return windowState.displayed.isRecording(); });
  windowState.actionEnabler.add({actions.nextRecording, actions.previousRecording},
                                [&windowState] { return windowState.recordings.all().size() > 1; });
}

void OpenFeature::connectStartPage() {
  WindowState& windowState = state();
  connect(startPage_, &StartPage::openRequested, actions_.open, &QAction::trigger);
  connect(startPage_, &StartPage::libraryRequested, this, [&windowState] {
    if (windowState.showLibrary) windowState.showLibrary({});
  });
  connect(startPage_, &StartPage::demoRequested, actions_.openDemo, &QAction::trigger);
  connect(startPage_,
          &StartPage::connectRequested,
          windowState.actions.at("connectHand"),
          &QAction::trigger);
  connect(startPage_,
          &StartPage::emulatedRequested,
          windowState.actions.at("tryEmulated"),
          &QAction::trigger);
  connect(startPage_, &StartPage::againRequested, this, [&windowState] {
    windowState.connectTo(loadConnection(windowState.settings));
  });
  connect(startPage_,
          &StartPage::planRequested,
          windowState.actions.at("recordingPlan"),
          &QAction::trigger);
  connect(startPage_, &StartPage::fileChosen, this, [&windowState](const QString& path) {
    windowState.open({path.toStdString()});
  });
}

// The emulated hand has its own button.
void OpenFeature::showLastConnection() {
  QSettings& settings = state().settings;
  const Connection last = loadConnection(settings);
  if (!hasLastConnection(settings) || !problemOf(last).isEmpty() ||
      last.kind == Connection::Kind::kEmulated)
    return startPage_->setLastConnection({});
  const QDate day = QDate::fromString(settings.value(kLastConnectionDay).toString(), Qt::ISODate);
  const qint64 ago = day.isValid() ? day.daysTo(QDate::currentDate()) : -1;
  startPage_->setLastConnection(describe(last) + (ago == 0   ? ", today"
                                                  : ago == 1 ? ", yesterday"
                                                  : ago > 1 ? QLocale::c().toString(day, ", d MMMM")
                                                            : ""));
}

void OpenFeature::start() {
  connectStartPage();
  showLastConnection();
  fillRecentMenu();
  listRecordings();
}

void OpenFeature::openDemoRecording() {
  state().open({state().demoRecording()}, OpenRequest::Then::kPlayInLoop);
}

void OpenFeature::take(const OpenedRecordingPtr& recording, const OpenArrival& arrival) {
  using Then = OpenRequest::Then;
  WindowState& windowState = state();
  DisplayedSource& displayed = windowState.displayed;
  if (recording->path != windowState.demoRecording())
    windowState.recent.add(pathText(recording->path));
  keepThumbnail(recording);
  listRecordings();
  const bool compared = arrival.then == Then::kCompare;
  const bool first = arrival.place == 0 && arrival.then != Then::kList;
  // When a shown file was read again, it is shown again, unless a live source is shown.
  const bool again = arrival.replaced && !displayed.isLive() && !displayed.unfilteredRecording();
  const bool shown = again || (first && (!compared || !displayed.isRecording()));
  if (shown)
    displayed.show(recording);
  else
    windowState.actionEnabler.refresh();
  // When there is nothing to compare with yet, the first recording becomes A, and the next is
  // compared with it.
  if (compared && shown && windowState.recordings.all().size() > 1)
    windowState.comparison.set(true);
  if (compared && !shown && displayed.isRecording() &&
      (first || (arrival.place == 1 && !windowState.comparison.on())))
    windowState.comparison.with(recording);
  if (arrival.then != Then::kPlayInLoop || !first) return;
  if (!windowState.playback.loop()) windowState.playback.setLoop(true);
  windowState.playback.play();
}

void OpenFeature::keepThumbnail(const OpenedRecordingPtr& recording) {
  constexpr int kAfterMs = 300;  // it is seen first
  if (recording->path == state().demoRecording()) return;
  QTimer::singleShot(kAfterMs, this, [this, weak = std::weak_ptr(recording)] {
    if (const OpenedRecordingPtr alive = weak.lock())
      thumbnails_.keep(pathText(alive->path), thumbnailOf(alive, window()->devicePixelRatioF()));
  });
}

void OpenFeature::listRecordings() {
  QComboBox* box = state().menus.recordings;
  box->clear();
  const auto& all = state().recordings.all();
  for (const auto& each : all) box->addItem(nameAndDate(*each));
  const auto at = std::find(all.begin(), all.end(), state().displayed.unfilteredRecording());
  // While a hand is shown live, none of them is.
  box->setCurrentIndex(at == all.end() ? -1 : static_cast<int>(at - all.begin()));
  state().menus.recordingsShown->setVisible(!all.empty());
}

void OpenFeature::fillRecentMenu() {
  WindowState& windowState = state();
  QMenu* menu = windowState.menus.recent;
  menu->clear();
  bool anyMissing = false;
  for (const QString& path : windowState.recent.paths()) {
    const bool exists = !windowState.recent.isMissing(path);
    anyMissing = anyMissing || !exists;
    QString text = QFileInfo(path).fileName();
    text.replace('&', "&&");
    QAction* entry = menu->addAction(exists ? text : text + " (missing)");
    entry->setToolTip(path);
    entry->setEnabled(exists);
    connect(entry, &QAction::triggered, this, [&windowState, path] {
      windowState.open({path.toStdString()});
    });
  }
  if (windowState.recent.paths().isEmpty()) menu->addAction("nothing yet")->setEnabled(false);
  menu->addSeparator();
  QAction* forget = menu->addAction("Forget missing files");
  forget->setEnabled(anyMissing);
  connect(forget, &QAction::triggered, &windowState.recent, &RecentFiles::removeMissing);
  QAction* clear = menu->addAction("Forget all");
  clear->setEnabled(!windowState.recent.paths().isEmpty());
  connect(clear, &QAction::triggered, this, [&windowState] {
    if (windowState.ask.confirmed("Forget all recent recordings? The files stay.", "Forget all"))
      windowState.recent.clear();
  });
}

void OpenFeature::showNeighbour(int step) {
  if (const auto next = state().recordings.neighbour(state().displayed.unfilteredRecording(), step))
    state().displayed.show(next);
}

void OpenFeature::closeCurrent() {
  const OpenedRecordingPtr current = state().displayed.recorded();
  if (current && state().events.settle({current}))
    state().displayed.show(state().recordings.close(current));
}

bool OpenFeature::eventFilter(QObject* watched, QEvent* event) {
  if (watched != window()) return Feature::eventFilter(watched, event);
  if (event->type() == QEvent::DragEnter) {
    auto* drag = static_cast<QDragEnterEvent*>(event);
    if (localFiles(*drag->mimeData()).empty()) return false;
    drag->acceptProposedAction();
    startPage_->setDragging(true);
    return true;
  }
  if (event->type() == QEvent::DragLeave) {
    startPage_->setDragging(false);
    return true;
  }
  if (event->type() != QEvent::Drop) return Feature::eventFilter(watched, event);
  startPage_->setDragging(false);
  auto* drop = static_cast<QDropEvent*>(event);
  const auto files = localFiles(*drop->mimeData());
  if (files.empty()) return false;
  drop->acceptProposedAction();
  state().open(files);
  return true;
}

void OpenFeature::remember() { rememberSession(state()); }

std::vector<CentralViewSpec> OpenFeature::centre() {
  return {{CentralViewSpec::Where::kStart, startPage_}};
}

std::vector<BannerSpec> OpenFeature::strips() { return {{BannerSpec::Order::kOpening, strip_}}; }

}  // namespace palpate::gui
