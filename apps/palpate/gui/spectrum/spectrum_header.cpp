#include "gui/spectrum/spectrum_header.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <algorithm>

#include <palpate/signals/welch.h>

#include "gui/widgets/eliding_box.h"
#include "gui/widgets/make.h"
#include "gui/widgets/number_field.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kShortest = static_cast<int>(SpectrumOptions::kWindow.minimum);  // [samples]
constexpr int kLongest = static_cast<int>(SpectrumOptions::kWindow.maximum);
constexpr const char* kSignalTip =
    "Choose the signal: the chosen taxels, a curve by a formula, or a column of a series";
constexpr const char* kTimesTip =
    "Use the times of the sender's clock, fitted to the times of arrival: for senders whose "
    "frames arrive in bursts";

}  // namespace

QString nameOf(SpectrumView view) {
  switch (view) {
    case SpectrumView::kMap:
      return "over time";
    case SpectrumView::kLine:
      return "mean line";
    case SpectrumView::kCoherence:
      break;
  }
  return "coherence";
}

SpectrumOptions usualOptions(SpectrumView view) {
  return view == SpectrumView::kMap ? SpectrumOptions{} : welchOptions();
}

SpectrumHeader::SpectrumHeader(QWidget* parent) : QWidget(parent) {
  name_ = makeLabel(this, "spectrumName");
  name_->setMinimumWidth(30);
  name_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  const auto field = [this](const char* name, const QString& tip) {
    auto* made = named(new FrameField(this), name, tip, tip.section('\n', 0, 0));
    fitToText(*made,
              [made] { made->setFixedWidth(made->fontMetrics().horizontalAdvance("65536") + 18); });
    made->setFocusPolicy(Qt::StrongFocus);
    return made;
  };
  window_ = field("spectrumWindow",
                  "Samples of a segment, 2 to 65536\nLonger: finer frequencies, coarser in time.");
  window_->setRange(kShortest, kLongest);
  overlap_ =
      field("spectrumOverlap", "Samples that a segment shares with the next, 0 to window - 1");
  overlap_->setRange(0, kLongest - 1);
  view_ = named(new QComboBox(this), "spectrumView", {}, "Kind of spectrum");
  view_->setToolTip(
      "Spectra over time, their mean with its peaks, or the coherence with another signal.\nMean "
      "and coherence are of the selected range; without one, of the visible part.");
  view_->setFocusPolicy(Qt::TabFocus);
  for (const SpectrumView each : kAllSpectrumViews) view_->addItem(nameOf(each));
  signal_ = named(new ElidingBox(this), "spectrumSignal", kSignalTip, "Of which signal");
  signal_->setFocusPolicy(Qt::TabFocus);
  signal_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  signal_->setMinimumContentsLength(12);
  signal_->addItem("chosen taxels");
  signal_->hide();
  connect(signal_, &QComboBox::currentTextChanged, this, [this](const QString& chosen) {
    signal_->setToolTip(kSignalTip + ("\nNow: " + chosen));
  });
  connect(signal_, &QComboBox::activated, this, &SpectrumHeader::changed);
  scale_ = named(new QComboBox(this),
                 "spectrumScale",
                 "Power spectral density in dB, or the amplitude of a sine",
                 "Quantity shown as colour");
  scale_->setFocusPolicy(Qt::TabFocus);
  for (const SpectrumScale each : kAllSpectrumScales) scale_->addItem(nameOf(each));
  times_ = named(new QCheckBox("Sender's clock", this),
                 "spectrumTimes",
                 kTimesTip,
                 "Times of the sender's clock");
  times_->setFocusPolicy(Qt::TabFocus);
  setLayout(inRow({{name_, 1},
                   Space::kNarrow,
                   signal_,
                   view_,
                   Space::kNarrow,
                   "Window",
                   window_,
                   Space::kNarrow,
                   "Overlap",
                   overlap_,
                   Space::kNarrow,
                   scale_,
                   Space::kNarrow,
                   times_}));
  show(setting_);
  connect(window_, &QSpinBox::valueChanged, this, [this](int window) {
    SpectrumSetting setting = setting_;
    // An overlap of all samples but one stays so.
    const bool most = setting.overlap == setting.window - 1;
    setting.window = window;
    setting.overlap = most ? window - 1 : std::min(setting.overlap, window - 1);
    take(setting);
  });
  connect(overlap_, &QSpinBox::valueChanged, this, [this](int overlap) {
    SpectrumSetting setting = setting_;
    setting.overlap = overlap;
    take(setting);
  });
  connect(view_, &QComboBox::activated, this, [this](int index) {
    SpectrumSetting setting = setting_;
    setting.view = kAllSpectrumViews[static_cast<std::size_t>(index)];
    const SpectrumOptions before = usualOptions(setting_.view), now = usualOptions(setting.view);
    if (setting.window == before.window && setting.overlap == before.overlap) {
      setting.window = now.window;
      setting.overlap = now.overlap;
    }
    take(setting);
  });
  connect(times_, &QCheckBox::toggled, this, [this](bool on) {
    SpectrumSetting setting = setting_;
    setting.fitsTimes = on;
    take(setting);
  });
  connect(scale_, &QComboBox::activated, this, [this](int index) {
    SpectrumSetting setting = setting_;
    setting.scale = kAllSpectrumScales[static_cast<std::size_t>(index)];
    take(setting);
  });
}

void SpectrumHeader::show(const SpectrumSetting& setting) {
  setting_ = setting;
  const QSignalBlocker window(window_), overlap(overlap_), scale(scale_), view(view_),
      times(times_);
  window_->setValue(setting.window);
  overlap_->setRange(0, setting.window - 1);
  overlap_->setValue(setting.overlap);
  scale_->setCurrentText(nameOf(setting.scale));
  scale_->setEnabled(setting.view != SpectrumView::kCoherence);
  view_->setCurrentText(nameOf(setting.view));
  times_->setChecked(setting.fitsTimes);
}

void SpectrumHeader::setSetting(const SpectrumSetting& setting) {
  SpectrumSetting good = setting;
  good.window = std::clamp(good.window, kShortest, kLongest);
  good.overlap = std::clamp(good.overlap, 0, good.window - 1);
  take(good);
}

void SpectrumHeader::take(SpectrumSetting setting) {
  const bool another = setting != setting_;
  show(setting);
  if (another) emit changed();
}

void SpectrumHeader::setName(const QString& name) {
  whole_ = name;
  name_->setToolTip(name);
  elide();
}

void SpectrumHeader::setClock(const QString& clock) {
  times_->setToolTip(clock.isEmpty() ? QString(kTimesTip) : kTimesTip + ("\n" + clock));
}

void SpectrumHeader::setFormulas(const QStringList& names) {
  const QString before = formula();
  while (signal_->count() > 1) signal_->removeItem(1);
  signal_->addItems(names);
  signal_->setVisible(!names.isEmpty());
  signal_->setCurrentIndex(
      before.isEmpty() ? 0 : std::max(0, static_cast<int>(names.indexOf(before)) + 1));
}

QString SpectrumHeader::formula() const {
  return signal_->currentIndex() > 0 ? signal_->currentText() : QString();
}

void SpectrumHeader::elide() {
  name_->setText(name_->fontMetrics().elidedText(whole_, Qt::ElideRight, name_->width()));
}

void SpectrumHeader::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  elide();
}

}  // namespace palpate::gui
