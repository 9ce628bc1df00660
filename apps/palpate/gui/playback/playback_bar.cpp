#include "gui/playback/playback_bar.h"

#include <QLabel>
#include <QSignalBlocker>
#include <algorithm>
#include <limits>

#include <palpate/core/number_text.h>

#include "gui/playback/seek_bar.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kTimeDecimals = 2;

int asInt(std::size_t value) {
  return static_cast<int>(
      std::min(value, static_cast<std::size_t>(std::numeric_limits<int>::max())));
}

// A number field without arrows, which would only repeat the step buttons.
template <class Field>
Field* makeField(QWidget* parent, const char* name, int digits) {
  auto* field = named(new Field(parent), name);
  fitToText(*field, [field, digits] {
    field->setFixedWidth(field->fontMetrics().horizontalAdvance(QString(digits, '0')) + 18);
  });
  return field;
}

}  // namespace

PlaybackBar::PlaybackBar(PlaybackController& playback, QWidget* parent)
    : QWidget(parent), playback_(playback) {
  setObjectName("PlaybackBar");
  setAttribute(Qt::WA_StyledBackground);
  seekBar_ = named(new SeekBar(this), "seekBar");
  frame_ = makeField<FrameField>(this, "frameField", 7);
  frame_->setToolTip("Number of the frame; the first is 0: type one and press Enter (Ctrl+G)");
  frame_->setAccessibleName("Frame");
  ofFrames_ = makeLabel(this, "ofFrames");
  time_ = makeField<SecondsField>(this, "timeField", 8);
  time_->setDecimals(kTimeDecimals);
  time_->setAccessibleName("Time in seconds");
  ofTime_ = makeLabel(this, "ofTime");

  setLayout(inRow(
      {{seekBar_, 1}, Space::kNarrow, "frame", frame_, ofFrames_, Space::kNarrow, time_, ofTime_},
      Space::kNarrow,
      {.left = Space::kUsual,
       .top = Space::kNarrow,
       .right = Space::kUsual,
       .bottom = Space::kNarrow}));

  // The playback is the context: when the window closes, a field may emit a value after the
  // playback is destroyed.
  connect(seekBar_, &SeekBar::seekRequested, &playback_, [this](int frame) {
    playback_.seekFrame(static_cast<std::size_t>(frame));
  });
  connect(frame_, &QSpinBox::valueChanged, &playback_, [this](int frame) {
    playback_.seekFrame(static_cast<std::size_t>(frame));
  });
  connect(time_, &QDoubleSpinBox::valueChanged, &playback_, [this](double seconds) {
    playback_.seekSeconds(seconds);
  });
  // After Enter, keys control the playback again.
  for (QAbstractSpinBox* field :
       {static_cast<QAbstractSpinBox*>(frame_), static_cast<QAbstractSpinBox*>(time_)})
    connect(field, &QAbstractSpinBox::editingFinished, field, &QWidget::clearFocus);
  connect(&playback_, &PlaybackController::frameChanged, this, &PlaybackBar::showFrame);
  connect(&playback_, &PlaybackController::positionChanged, this, &PlaybackBar::showTime);
  connect(&playback_, &PlaybackController::stateChanged, this, &PlaybackBar::takeRecording);
  takeRecording();
}

void PlaybackBar::editFrame() {
  frame_->setFocus(Qt::ShortcutFocusReason);
  frame_->selectAll();
}

void PlaybackBar::takeRecording() {
  const std::size_t frames = playback_.numFrames();
  setEnabled(frames > 0);
  {
    const QSignalBlocker blockedBar(seekBar_), blockedFrame(frame_), blockedTime(time_);
    const int last = asInt(frames == 0 ? 0 : frames - 1);
    seekBar_->setRange(0, last);
    frame_->setRange(0, last);
    time_->setRange(0.0, playback_.durationS());
  }
  const QString ofFrames = "last " + QString::number(frames == 0 ? 0 : frames - 1);
  if (ofFrames_->text() != ofFrames) ofFrames_->setText(ofFrames);
  const QString ofTime =
      "/ " + QString::fromStdString(fixedText(playback_.durationS(), kTimeDecimals)) + " s";
  if (ofTime_->text() != ofTime) ofTime_->setText(ofTime);
  showFrame(playback_.frame());
}

void PlaybackBar::showFrame(std::size_t frame) {
  const QSignalBlocker blockedBar(seekBar_), blockedFrame(frame_);
  seekBar_->setValue(asInt(frame));
  // The playback does not overwrite what the user is typing.
  if (!frame_->hasFocus() || !playback_.playing()) frame_->setValue(asInt(frame));
  const QString stamp =
      QString::fromStdString(fixedText(playback_.frameTimeS(), kTimeDecimals)) + " s";
  time_->setToolTip(
      "Time of the cursor from the first frame in s: type one and press Enter.\n"
      "Frame " +
      QString::number(frame) + " itself was recorded at " + stamp + ".");
  showTime(playback_.positionS());
}

// Called between two frames, too: in a gap the time continues while the frame stays.
void PlaybackBar::showTime(double seconds) {
  const QSignalBlocker blocked(time_);
  if (!time_->hasFocus() || !playback_.playing()) time_->setValue(seconds);
}

}  // namespace palpate::gui
