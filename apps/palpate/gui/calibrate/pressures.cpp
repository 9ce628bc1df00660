#include "gui/calibrate/pressures.h"

#include <QFileInfo>
#include <stdexcept>
#include <string>
#include <utility>

#include <palpate/core/error.h>

#include "gui/appearance/hand_unit.h"
#include "gui/calibrate/force_page.h"

namespace palpate::gui {
namespace {

QString noCalibration(const HandDescription* hand) {
  return "none: values are " + (hand ? unitOf(*hand) : QString("counts"));
}

}  // namespace

Pressures::Pressures(WindowState& windowState, ForcePage& page)
    : windowState_(windowState), page_(page) {
  connect(&windowState.playback, &PlaybackController::positionChanged, this, &Pressures::showFrame);
  connect(&windowState.currentFrame, &CurrentFrame::resultsReceived, this, &Pressures::showLive);
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
  const DisplayedSource& displayed = windowState_.displayed;
  LiveSource* source = displayed.source();
  // The source is about to be removed.
  if (displayed.isLive() && !source) return of_.reset();
  const std::string hand = displayed.hand() ? displayed.hand()->name : std::string();
  const QString path = hand.empty() ? QString() : appliedCalibration(windowState_.settings, hand);
  Of now{source ? static_cast<const void*>(source->history.get())
                : static_cast<const void*>(displayed.unfilteredRecording().get()),
         path,
         source ? KeptWithRecording{} : kept_};
  if (of_ && *of_ == now) return;
  of_ = std::move(now);
  reader_.reset();
  QString text = path.isEmpty() ? noCalibration(displayed.hand()) : QFileInfo(path).fileName();
  try {
    if (source)
      renewLive(path);
    else if (displayed.isRecording() && !path.isEmpty())
      renewRecording(path);
  } catch (const Error& error) {
    text = QString("can't be used: ") + error.what();
  } catch (const std::invalid_argument& error) {
    text = QString("can't be used: ") + error.what();
  }
  windowState_.derivedResults.setCalibration(text);
  windowState_.derivedResults.setPressure(nullptr);
  if (!source) showFrame();
}

void Pressures::renewLive(const QString& path) {
  LiveSource& source = *windowState_.displayed.source();
  source.pressure->setCalibration(std::nullopt);
  page_.setLiveHand(*windowState_.displayed.hand());
  if (!path.isEmpty()) source.pressure->setCalibration(usableCalibration(path));
}

void Pressures::renewRecording(const QString& path) {
  if (!kept_.problem.isEmpty()) throw Error(kept_.problem.toStdString());
  reader_ = std::make_unique<PressureReader>(windowState_.displayed.unfilteredRecording()->profile,
                                             usableCalibration(path),
                                             pressureOptions(kept_, std::nullopt),
                                             kept_.tare);
}

// Computes the pressures of the recording's frame at the cursor.
void Pressures::showFrame() {
  if (!reader_ || !windowState_.displayed.hasFrames()) return;
  try {
    windowState_.derivedResults.setPressure(
        std::make_shared<const PressureFrame>(reader_->at(windowState_.playback.frame())));
  } catch (const Error&) {
    // The view of the frame reports the error.
    windowState_.derivedResults.setPressure(nullptr);
  }
}

void Pressures::showLive(const LiveResults& results) {
  windowState_.derivedResults.setPressure(results.pressure);
  const LiveSource* source = windowState_.displayed.source();
  if (source && results.pressure && page_.isVisible())
    page_.showLive(*results.pressure, source->pressure->assumptions());
}

}  // namespace palpate::gui
