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

Pressures::Pressures(WindowState& windowState, CalibrationCache& calibrations, ForcePage& page)
    : windowState_(windowState), calibrations_(calibrations), page_(page) {
  connect(&calibrations, &CalibrationCache::changed, this, &Pressures::take);
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
  if (of_ && !of_->path.isEmpty()) calibrations_.renew(of_->path);
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
  if (source) page_.setLiveHand(*displayed.hand());
  if (path.isEmpty()) return show({}, noCalibration(displayed.hand()));
  // The calibration of a connected hand is read again only on connecting: looking at a recording
  // meanwhile must not take it away from a hand that moves.
  if (!source) calibrations_.renew(path);
  take(path);
}

void Pressures::take(const QString& path) {
  if (!of_ || of_->path != path) return;
  const QString name = QFileInfo(path).fileName();
  const CalibrationCache::Known* known = calibrations_.find(path);
  if (!known) return show({}, name + " is being read");
  show(known->calibration, known->calibration ? name : "can't be used: " + known->problem);
}

void Pressures::show(const std::optional<Calibration>& calibration, QString text) {
  reader_.reset();
  forces_.reset();
  LiveSource* source = windowState_.displayed.source();
  try {
    if (source)
      source->pressure->setCalibration(calibration);
    else if (calibration && windowState_.displayed.isRecording())
      renewRecording(*calibration);
  } catch (const Error& error) {
    text = QString("can't be used: ") + error.what();
  } catch (const std::invalid_argument& error) {
    text = QString("can't be used: ") + error.what();
  }
  windowState_.derivedResults.setCalibration(text);
  windowState_.derivedResults.setPressure(nullptr);
  windowState_.derivedResults.setForces(forces_,
                                        windowState_.displayed.unfilteredRecording().get());
  if (!source) showFrame();
}

void Pressures::renewRecording(const Calibration& calibration) {
  if (!kept_.problem.isEmpty()) throw Error(kept_.problem.toStdString());
  const Profile& counts = windowState_.displayed.unfilteredRecording()->profile;
  const ComputedOptions forces{.calibration = calibration,
                               .pressure = pressureOptions(kept_, std::nullopt),
                               .tare = kept_.tare,
                               .counts = counts};
  reader_ = std::make_unique<PressureReader>(counts, calibration, forces.pressure, forces.tare);
  forces_ = std::make_shared<const ComputedOptions>(forces);
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
