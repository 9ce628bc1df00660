#include "gui/open/recovery_feature.h"

#include <QFileInfo>
#include <QPushButton>
#include <QToolButton>
#include <memory>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/library/unfinished_recordings.h>
#include <palpate/recording/recording.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/opening_strip.h"

namespace palpate::gui {
namespace {

constexpr const char* kRecoverTitle = "Recover a recording";

// What is missing, as a sentence.
QString damageSentence(const OpenedRecording& recording) {
  QString text = inWindowWords(QString::fromStdString(recording.damage));
  for (const QString& begin : {QString("damaged; "), pathText(recording.path) + ": "})
    if (text.startsWith(begin)) text = text.mid(begin.size());
  return text.isEmpty() ? QString() : text.left(1).toUpper() + text.mid(1) + ".";
}

}  // namespace

RecoveryFeature::RecoveryFeature(WindowState& windowState, QWidget* window)
    : Feature(windowState, window),
      recover_(windowState.actions.make("recover", "File", "Reco&ver…")),
      offer_(new OfferStrip(window)),
      strip_(new OpeningStrip(window, "Recovering", "recovering")) {
  recover_->setToolTip(
      "Save what can be read of a damaged or unfinished recording as a new recording");
  offer_->findChild<QPushButton*>("offerAccept")->setObjectName("recoverAccept");
  offer_->findChild<QToolButton*>("offerClose")->setObjectName("recoverClose");
  on(recover_, [this] { recoverChosen(); });
  connect(&windowState.displayed, &DisplayedSource::shown, this, &RecoveryFeature::offer);
  connect(&windowState.displayed, &DisplayedSource::moreKnown, this, &RecoveryFeature::offer);
  connect(
      &windowState.currentFrame, &CurrentFrame::staleNoticeChanged, this, &RecoveryFeature::offer);
  connect(&job_, &BackgroundJob::started, strip_, &OpeningStrip::begin);
  connect(&job_, &BackgroundJob::progressed, strip_, &OpeningStrip::setProgress);
  connect(&job_, &BackgroundJob::finished, strip_, &OpeningStrip::end);
  connect(&job_, &BackgroundJob::finished, this, &RecoveryFeature::offer);
  connect(strip_, &OpeningStrip::cancelRequested, &job_, &BackgroundJob::cancel);
  connect(&job_, &BackgroundJob::failed, &windowState.messages, &Messages::fail);
  connect(&job_, &BackgroundJob::cancelled, this, [&windowState](const QString& path) {
    windowState.messages.flash(QFileInfo(path).fileName() +
                               ": recovering was cancelled, nothing was written");
  });
  windowState.escapeHandler.add(EscapeHandler::Order::kWork, [this] {
    if (!job_.busy()) return false;
    job_.cancel();
    return true;
  });
}

QString RecoveryFeature::damageOfDisplayed() const {
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (!recording) return {};
  const QString name = fileNameOf(*recording);
  const QString how = " Recovering saves what can be read as a new recording; the file is kept.";
  if (!recording->damage.empty())
    return name + " is damaged; only its readable part is shown. " + damageSentence(*recording) +
           how;
  if (isUnfinished(*recording))
    return name + " was never finished: the program that recorded it ended too early." + how;
  if (const std::size_t count = recording->unreadableNow().count; count > 0)
    return name + " is damaged: " + QString::fromStdString(counted(count, "frame")) +
           " can't be read." + how;
  // Of angles and temperatures, and of a long recording until all of it has been read, damage shows
  // when it is come to.
  if (!state().currentFrame.old().notice.isEmpty())
    return name + " is damaged: a part of it can't be read." + how;
  return {};
}

void RecoveryFeature::offer() {
  const OpenedRecordingPtr recording = state().displayed.recorded();
  const QString text = damageOfDisplayed();
  if (!recording || job_.busy() || declined_.contains(recording->path)) return offer_->dismiss();
  // Damage that was come to once stays said.
  if (text.isEmpty() && offer_->property("path").toString() == pathText(recording->path)) return;
  if (text.isEmpty()) return offer_->dismiss();
  offer_->setProperty("path", pathText(recording->path));
  offer_->offer(
      text,
      "Recover…",
      [this, path = recording->path] { recover(path); },
      [this, path = recording->path] { declined_.insert(path); });
}

void RecoveryFeature::recoverChosen() {
  const OpenedRecordingPtr recording = state().displayed.recorded();
  if (recording && !damageOfDisplayed().isEmpty()) return recover(recording->path);
  const QString path = state().ask.file(kRecoverTitle,
                                        state().recent.lastFolder(),
                                        "Recordings (*.dsa *.palpate *.mcap);;All files (*)");
  if (!path.isEmpty()) recover(path.toStdString());
}

void RecoveryFeature::recover(const std::filesystem::path& path) {
  QString saved =
      state().ask.newFile("Save what can be read",
                          pathText(recoveredPathOf(path)),
                          "Palpate recording (*.palpate);;MCAP (*.mcap);;DSA recording (*.dsa)");
  if (saved.isEmpty()) return offer();
  if (QFileInfo(saved).suffix().isEmpty()) saved += ".palpate";
  // The file is recovered: labels that aren't in it yet would be missing in the new one.
  if (const OpenedRecordingPtr open = state().recordings.at(path);
      open && state().events.hasUnsaved(open))
    state().events.save(open);
  auto report = std::make_shared<RecoverReport>();
  job_.start(
      pathText(path),
      [path, saved, report](const Progress& progress) {
        const std::filesystem::path out = saved.toStdString();
        requireOther(path, out);
        // The dialogue has already asked whether an existing file may be replaced.
        *report = recoverRecording(path, out, Overwrite::kReplace, progress);
        if (report->state == RecoverReport::State::kNothing)
          throw Error(path.string() + ": " + report->message);
      },
      [this, path, saved, report] {
        declined_.insert(path);
        state().messages.flash(QFileInfo(saved).fileName() + ": " +
                               QString::fromStdString(report->message));
        state().open({saved.toStdString()});
      });
}

std::vector<BannerSpec> RecoveryFeature::strips() {
  return {{BannerSpec::Order::kOffer, offer_}, {BannerSpec::Order::kWork, strip_}};
}

}  // namespace palpate::gui
