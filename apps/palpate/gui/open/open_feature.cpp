#include "gui/open/open_feature.h"

#include <QComboBox>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <algorithm>

#include "gui/look/path_text.h"
#include "gui/open/session_keeper.h"
#include "gui/open/start_page.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

std::vector<std::filesystem::path> localFiles(const QMimeData& data) {
  std::vector<std::filesystem::path> files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files.emplace_back(url.toLocalFile().toStdString());
  return files;
}

QString nameAndDate(const OpenedRecording& recording) {
  if (recording.profile.numFrames() == 0) return fileNameOf(recording) + " · empty";
  const std::string date = utcText(recording.profile.frameTimeUs(0)).substr(0, 10);
  return fileNameOf(recording) + " · " + QString::fromStdString(date);
}

bool hasDemo(const Bench& bench) {
  std::error_code ignored;
  return std::filesystem::exists(bench.demoRecording(), ignored);
}

}  // namespace

OpenFeature::OpenFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      actions_(bench.actions),
      startPage_(new StartPage(bench.recent, hasDemo(bench), window)),
      strip_(new OpeningStrip(window)) {
  followTheme(startPage_);
  actions_.openDemo->setVisible(hasDemo(bench));
  actions_.openDemo->setEnabled(hasDemo(bench));
  bench.questions.recordings = [&bench, window] {
    return QFileDialog::getOpenFileNames(window,
                                         "Open recordings",
                                         bench.recent.lastFolder(),
                                         "Recordings (*.dsa *.palpate *.xml);;All files (*)");
  };
  connectOpener();
  connectActions();
  window->installEventFilter(this);
}

void OpenFeature::connectOpener() {
  Bench& bench = this->bench();
  RecordingOpener& opener = bench.opener;
  connect(&opener, &RecordingOpener::started, strip_, &OpeningStrip::begin);
  connect(&opener, &RecordingOpener::progressed, strip_, &OpeningStrip::setProgress);
  connect(&opener, &RecordingOpener::finished, strip_, &OpeningStrip::end);
  connect(&opener, &RecordingOpener::failed, this, [&bench](const QString&, const QString& why) {
    bench.messages.fail(why);
  });
  connect(&opener, &RecordingOpener::cancelled, this, [&bench](const QString& path) {
    bench.messages.flash("opening " + QFileInfo(path).fileName() + " was cancelled");
  });
  connect(strip_, &OpeningStrip::cancelRequested, &opener, &RecordingOpener::cancel);
  connect(&bench.recordings, &OpenRecordings::arrived, this, &OpenFeature::take);
  connect(&bench.recordings, &OpenRecordings::gone, this, [&bench](const OpenedRecordingPtr& gone) {
    bench.subject.replace(gone, bench.recordings.at(gone->path));
  });
  connect(&bench.subject, &Subject::changed, this, [this, &bench] {
    listRecordings();
    const OpenedRecordingPtr recording = bench.subject.recorded();
    if (recording && recording->profile.numFrames() == 0)
      bench.messages.fail(fileNameOf(*recording) + ": holds no frame; there is nothing to show");
  });
  bench.escape.add(Escape::Order::kOpening, [&opener] {
    if (!opener.busy()) return false;
    opener.cancel();
    return true;
  });
}

void OpenFeature::connectActions() {
  Bench& bench = this->bench();
  OpenActions& actions = actions_;
  on(actions.open, [&bench] { bench.askAndOpen(); });
  on(actions.openDemo, [this] { openDemoRecording(); });
  on(actions.nextRecording, [this] { showNeighbour(1); });
  on(actions.previousRecording, [this] { showNeighbour(-1); });
  on(actions.closeRecording, [this] { closeCurrent(); });
  connect(bench.menus.recent, &QMenu::aboutToShow, this, &OpenFeature::fillRecentMenu);
  connect(bench.menus.recordings, &QComboBox::activated, this, [&bench](int index) {
    bench.subject.show(bench.recordings.all().at(static_cast<std::size_t>(index)));
  });
  bench.enabling.add({actions.closeRecording}, [&bench] { return bench.subject.isRecording(); });
  bench.enabling.add({actions.nextRecording, actions.previousRecording},
                     [&bench] { return bench.recordings.all().size() > 1; });
}

void OpenFeature::connectStartPage() {
  Bench& bench = this->bench();
  connect(startPage_, &StartPage::openAsked, actions_.open, &QAction::trigger);
  connect(startPage_, &StartPage::demoAsked, actions_.openDemo, &QAction::trigger);
  connect(startPage_, &StartPage::connectAsked, bench.actions.at("connectHand"), &QAction::trigger);
  connect(
      startPage_, &StartPage::emulatedAsked, bench.actions.at("tryEmulated"), &QAction::trigger);
  connect(startPage_, &StartPage::fileChosen, this, [&bench](const QString& path) {
    bench.open({path.toStdString()});
  });
}

void OpenFeature::start() {
  connectStartPage();
  fillRecentMenu();
  listRecordings();
}

void OpenFeature::openDemoRecording() {
  bench().open({bench().demoRecording()}, OpenRequest::Then::kPlayInLoop);
}

void OpenFeature::take(const OpenedRecordingPtr& recording, const OpenArrival& arrival) {
  using Then = OpenRequest::Then;
  Bench& bench = this->bench();
  Subject& subject = bench.subject;
  if (recording->path != bench.demoRecording()) bench.recent.add(pathText(recording->path));
  listRecordings();
  const bool compared = arrival.then == Then::kCompare;
  const bool first = arrival.place == 0 && arrival.then != Then::kList;
  // A file that was open and looked at, and was read anew, is looked at again; not behind what is
  // live.
  const bool again = arrival.replaced && !subject.isLive() && !subject.behind();
  const bool shown = again || (first && (!compared || !subject.isRecording()));
  if (shown)
    subject.show(recording);
  else
    bench.enabling.refresh();
  // With nothing to compare yet the first is A, and the next is compared with it.
  if (compared && shown && bench.recordings.all().size() > 1) bench.comparing.set(true);
  if (compared && !shown && subject.isRecording() &&
      (first || (arrival.place == 1 && !bench.comparing.on())))
    bench.comparing.with(recording);
  if (arrival.then != Then::kPlayInLoop || !first) return;
  if (!bench.playback.loop()) bench.playback.setLoop(true);
  bench.playback.play();
}

void OpenFeature::listRecordings() {
  QComboBox* box = bench().menus.recordings;
  box->clear();
  const auto& all = bench().recordings.all();
  for (const auto& each : all) box->addItem(nameAndDate(*each));
  const auto at = std::find(all.begin(), all.end(), bench().subject.behind());
  if (at != all.end()) box->setCurrentIndex(static_cast<int>(at - all.begin()));
  bench().menus.recordingsShown->setVisible(!all.empty());
}

void OpenFeature::fillRecentMenu() {
  Bench& bench = this->bench();
  QMenu* menu = bench.menus.recent;
  menu->clear();
  bool anyMissing = false;
  for (const QString& path : bench.recent.paths()) {
    const bool exists = RecentFiles::exists(path);
    anyMissing = anyMissing || !exists;
    QString text = QFileInfo(path).fileName();
    text.replace('&', "&&");
    QAction* entry = menu->addAction(exists ? text : text + " (missing)");
    entry->setToolTip(path);
    entry->setEnabled(exists);
    connect(entry, &QAction::triggered, this, [&bench, path] { bench.open({path.toStdString()}); });
  }
  if (bench.recent.paths().isEmpty()) menu->addAction("nothing yet")->setEnabled(false);
  menu->addSeparator();
  QAction* forget = menu->addAction("Forget missing files");
  forget->setEnabled(anyMissing);
  connect(forget, &QAction::triggered, &bench.recent, &RecentFiles::removeMissing);
  QAction* clear = menu->addAction("Forget all");
  clear->setEnabled(!bench.recent.paths().isEmpty());
  connect(clear, &QAction::triggered, &bench.recent, &RecentFiles::clear);
}

void OpenFeature::showNeighbour(int step) {
  if (const auto next = bench().recordings.neighbour(bench().subject.behind(), step))
    bench().subject.show(next);
}

void OpenFeature::closeCurrent() {
  const OpenedRecordingPtr current = bench().subject.recorded();
  if (current && bench().events.settle({current}))
    bench().subject.show(bench().recordings.close(current));
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
  bench().open(files);
  return true;
}

void OpenFeature::remember() { rememberSession(bench()); }

std::vector<CentreOffer> OpenFeature::centre() {
  return {{CentreOffer::Where::kStart, startPage_}};
}

std::vector<StripOffer> OpenFeature::strips() { return {{StripOffer::Order::kOpening, strip_}}; }

}  // namespace palpate::gui
