#include "gui/calibrate/measure_row.h"

#include <QDateTime>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <algorithm>
#include <cmath>
#include <utility>

#include <palpate/core/time.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"

namespace palpate::gui {
namespace {

constexpr int kMeasureLookMs = 50;
constexpr int kMaxMeasureS = 600;
constexpr int kMeasureSteps = 1000;
constexpr int kMeasureBarHeight = 8;  // [px]
// States of an axis (Device::axisStates) in which it moves.
constexpr int kAxisPositions = 1, kAxisMovesAtSpeed = 2;

// A file name for what was measured; it is never a file.
std::filesystem::path measuredName(const Profile& profile) {
  const auto at = QDateTime::fromMSecsSinceEpoch(profile.frameTimeUs(0) / kUsPerMs);
  return ("live_" + at.toString("yyyy-MM-dd_HHmmss")).toStdString();
}

QString counted(std::size_t count, const QString& what) {
  return QString::number(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

bool isMeasured(const OpenedRecording& recording) {
  return recording.profile.info().format == kLiveMeasurementFormat;
}

QString refusal(const std::string& why) {
  return "The hand was " + QString::fromStdString(why) +
         ".\n\nNothing may touch it while it is measured.";
}

MeasureRow::MeasureRow(QSettings& settings, Setup setup, QWidget* parent)
    : QWidget(parent), settings_(settings), setup_(std::move(setup)) {
  setObjectName(setup_.part + "MeasureRow");
  measure_ = makeButton(this, setup_.part + "Measure", "Measure now", setup_.tip);
  seconds_ = named(new FrameField(this),
                   setup_.part + "MeasureSeconds",
                   "Seconds to measure the connected hand",
                   "Seconds to measure");
  seconds_->setRange(1, kMaxMeasureS);
  // A stored value that is no number becomes the usual one.
  bool valid = false;
  const int stored =
      settings_.value("calibrate/" + setup_.part + "_seconds").toString().toInt(&valid);
  seconds_->setValue(valid ? stored : setup_.usualSeconds);
  progress_ = named(new QProgressBar(this), setup_.part + "MeasureProgress");
  progress_->setRange(0, kMeasureSteps);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(kMeasureBarHeight);
  // Its place stays while nothing is measured.
  QSizePolicy policy = progress_->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  progress_->setSizePolicy(policy);
  cancel_ = makeButton(this, setup_.part + "MeasureCancel", "Cancel");
  cancel_->setToolTip("Cancel the measurement (Esc; closes an open message first)");
  text_ = makeLines(this, setup_.part + "MeasureText");
  setLayout(
      inColumn({inRow({measure_, seconds_, "s", {progress_, 1}, cancel_}), text_}, Space::kNarrow));
  timer_.setInterval(kMeasureLookMs);
  connect(&timer_, &QTimer::timeout, this, &MeasureRow::takeItems);
  connect(measure_, &QPushButton::clicked, this, &MeasureRow::begin);
  connect(cancel_, &QPushButton::clicked, this, &MeasureRow::cancel);
  connect(seconds_, &QSpinBox::valueChanged, this, [this](int seconds) {
    settings_.setValue("calibrate/" + setup_.part + "_seconds", seconds);
  });
  connect(&job_, &BackgroundJob::failed, this, [this](const QString& message) {
    endWith("Nothing was measured: " + message);
  });
  showState();
}

void MeasureRow::setSession(CaptureSession* session) {
  if (measurement_) {
    measurement_->fail("the hand was disconnected");
    takeItems();
  }
  if (session) result_.clear();
  session_ = session;
  showState();
}

void MeasureRow::setLive(bool live) {
  // What was said of the connected hand doesn't belong to a recording.
  if (live_ && !live && session_) result_.clear();
  live_ = live;
  showState();
}

QString MeasureRow::obstacle() const {
  const Device& device = session_->device();
  const std::vector<int> states = device.axisStates();
  if (std::any_of(states.begin(), states.end(), [](int state) {
        return state == kAxisPositions || state == kAxisMovesAtSpeed;
      }))
    return "the hand moves: wait until it stands still";
  if (!setup_.needsThreshold0) return {};
  const std::vector<MatrixSettings> matrices = device.info().matrices;
  const auto hides = [](const MatrixSettings& matrix) { return matrix.thresholdCounts > 0; };
  if (std::any_of(matrices.begin(), matrices.end(), hides))
    return "the thresholds hide the noise: set them to 0 in the dock Hand";
  return {};
}

void MeasureRow::begin() {
  if (!session_ || measurement_) return;
  const QString why = obstacle();
  if (!why.isEmpty()) return endWith("Nothing was measured: " + why + ".");
  LiveMeasurementOptions options;
  options.seconds = seconds_->value();
  measurement_ = std::make_unique<LiveMeasurement>(session_->device().hand(), options);
  queue_ = session_->subscribe("the dock Calibrate");
  silence_.start();
  timer_.start();
  showState();
}

void MeasureRow::takeItems() {
  if (!measurement_) return;
  items_.clear();
  queue_->take(items_);
  for (const CaptureItem& item : items_) {
    measurement_->add(item);
    if (streamOf(item) == CaptureStream::kTactile) silence_.restart();
  }
  measurement_->noteSilence(static_cast<double>(silence_.elapsed()) / kMsPerS);
  switch (measurement_->state()) {
    case LiveMeasurement::State::kRunning:
      return showState();
    case LiveMeasurement::State::kComplete:
      return complete();
    case LiveMeasurement::State::kFailed:
      return endWith("Nothing was measured: " + QString::fromStdString(measurement_->failure()) +
                     ".");
  }
}

void MeasureRow::complete() {
  QString text = "Measured: " + counted(measurement_->numFrames(), "frame") + ", " +
                 counted(measurement_->numScanned(), "taxel") + " scanned";
  for (const std::string& warning : measurement_->warnings())
    text += ", " + QString::fromStdString(warning);
  const DeviceInfo device = session_->device().info();
  ProfileInfo info;
  info.serial = device.serial;
  info.firmware = device.firmware;
  Profile profile = measurement_->takeProfile(std::move(info));
  endWith(text + ".");
  // It may be some hundred thousand frames.
  auto made = std::make_shared<OpenedRecordingPtr>();
  job_.start(
      "the measurement",
      [made, profile = std::move(profile)](const Progress& progress) {
        *made = makeOpenedRecording(measuredName(profile), profile, progress);
      },
      [this, made] { emit measured(*made); });
}

bool MeasureRow::cancel() {
  if (!measurement_) return false;
  measurement_->fail("cancelled");
  takeItems();
  return true;
}

void MeasureRow::settle() { job_.settle(); }

void MeasureRow::endWith(const QString& text) {
  timer_.stop();
  queue_.reset();
  measurement_.reset();
  result_ = text;
  showState();
  emit said(text);
}

void MeasureRow::showState() {
  const bool runs = running();
  const bool hadFocus = cancel_->hasFocus();
  setVisible(runs || live_ || !result_.isEmpty());
  measure_->setEnabled(session_ && live_ && !runs);
  seconds_->setEnabled(!runs);
  progress_->setVisible(runs);
  cancel_->setVisible(runs);
  if (!runs && hadFocus && measure_->isEnabled()) measure_->setFocus();
  QString text = result_;
  if (runs) {
    const double share = 1.0 - measurement_->secondsLeft() / seconds_->value();
    progress_->setValue(static_cast<int>(share * kMeasureSteps));
    text = QString::number(std::ceil(measurement_->secondsLeft())) +
           " s left: " + counted(measurement_->numFrames(), "frame") + ", " +
           counted(measurement_->numScanned(), "taxel") + " scanned";
    if (measurement_->numLost() > 0)
      text += ", " + counted(measurement_->numLost(), "frame") + " lost";
  }
  text_->setText(text);
  text_->setVisible(!text.isEmpty());
}

}  // namespace palpate::gui
