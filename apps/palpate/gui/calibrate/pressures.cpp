#include "gui/calibrate/pressures.h"

#include <QFileInfo>
#include <stdexcept>
#include <string>
#include <utility>

#include <palpate/core/error.h>

#include "gui/calibrate/force_page.h"

namespace palpate::gui {
namespace {

constexpr const char* kNone = "none: values are counts";

}  // namespace

Pressures::Pressures(Bench& bench, ForcePage& page) : bench_(bench), page_(page) {
  connect(&bench.playback, &PlaybackController::positionChanged, this, &Pressures::showFrame);
  connect(&bench.moment, &Moment::resultsCame, this, &Pressures::showLive);
}

void Pressures::setKept(const KeptWithRecording& kept) {
  kept_ = kept;
  renew();
}

void Pressures::reload() {
  of_.reset();
  renew();
}

void Pressures::renew() {
  const Subject& subject = bench_.subject;
  LiveSource* source = subject.source();
  if (subject.isLive() && !source) return of_.reset();  // it is about to go
  const std::string hand = subject.hand() ? subject.hand()->name : std::string();
  const QString path = hand.empty() ? QString() : appliedCalibration(bench_.settings, hand);
  Of now{source ? static_cast<const void*>(source->history.get())
                : static_cast<const void*>(subject.behind().get()),
         path,
         source ? KeptWithRecording{} : kept_};
  if (of_ && *of_ == now) return;
  of_ = std::move(now);
  reader_.reset();
  QString text = path.isEmpty() ? QString(kNone) : QFileInfo(path).fileName();
  try {
    if (source)
      renewLive(path);
    else if (subject.isRecording() && !path.isEmpty())
      renewRecording(path);
  } catch (const Error& error) {
    text = QString("can't be used: ") + error.what();
  } catch (const std::invalid_argument& error) {
    text = QString("can't be used: ") + error.what();
  }
  bench_.overlays.setCalibration(text);
  bench_.overlays.setPressure(nullptr);
  if (!source) showFrame();
}

void Pressures::renewLive(const QString& path) {
  LiveSource& source = *bench_.subject.source();
  source.pressure->setCalibration(std::nullopt);
  page_.setLiveHand(*bench_.subject.hand());
  if (!path.isEmpty()) source.pressure->setCalibration(usableCalibration(path));
}

void Pressures::renewRecording(const QString& path) {
  if (!kept_.trouble.isEmpty()) throw Error(kept_.trouble.toStdString());
  reader_ = std::make_unique<PressureReader>(bench_.subject.behind()->profile,
                                             usableCalibration(path),
                                             pressureOptions(kept_, std::nullopt),
                                             kept_.tare);
}

// The frame of the recording at which the cursor stands.
void Pressures::showFrame() {
  if (!reader_ || !bench_.subject.hasFrames()) return;
  try {
    bench_.overlays.setPressure(
        std::make_shared<const PressureFrame>(reader_->at(bench_.playback.frame())));
  } catch (const Error&) {
    bench_.overlays.setPressure(nullptr);  // said where the frame would be
  }
}

void Pressures::showLive(const LiveResults& results) {
  bench_.overlays.setPressure(results.pressure);
  const LiveSource* source = bench_.subject.source();
  if (source && results.pressure && page_.isVisible())
    page_.showLive(*results.pressure, source->pressure->assumptions());
}

}  // namespace palpate::gui
