#include "gui/matrices/matrices_panel.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QResizeEvent>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "gui/appearance/hand_unit.h"
#include "gui/matrices/drawn_taxels.h"
#include "gui/widgets/fitting_row.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kMatricesPanelCompactBelow = 700;  // [px] of width: buttons lose their text
// Parts of full scale that the range of a live hand has at least, so that a first light touch isn't
// shown in the brightest colour, and grows by: 500 and 250 of 4095 counts.
constexpr double kMinLivePart = 500.0 / 4095.0;
constexpr double kLiveStepPart = 250.0 / 4095.0;

// A part of full scale in whole steps of the last decimal.
double liveRangePart(const HandDescription& hand, double part) {
  const double scale = std::pow(10.0, decimalsOf(hand));
  return std::max(1.0, std::round(part * static_cast<double>(hand.maximumCounts) * scale)) / scale;
}

QDoubleSpinBox* rangeField(QWidget* parent, const char* name, const char* tip) {
  auto* field = named(new QDoubleSpinBox(parent), name);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  fitToText(*field, [field] {
    field->setFixedWidth(field->fontMetrics().horizontalAdvance("0000000") + 18);
  });
  field->setDecimals(0);
  field->setRange(0.0, 1e6);
  field->setSingleStep(50.0);
  field->setKeyboardTracking(false);
  field->setFocusPolicy(Qt::ClickFocus);
  field->setToolTip(tip);
  return field;
}

}  // namespace

MatricesPanel::MatricesPanel(QAction* interpolated, QAction* values, QWidget* parent)
    : QWidget(parent) {
  auto* header = named(new FittingRow(this), "ViewHeader");
  header->setAttribute(Qt::WA_StyledBackground);
  auto* title = new QLabel("<b>Matrices</b>", header);
  map_ = named(new QComboBox(header), "mapBox");
  map_->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
  map_->setToolTip("Colour map");
  for (const ColorMapName map : kAllColorMaps) map_->addItem(nameOf(map));
  range_ = named(new QComboBox(header), "rangeBox");
  range_->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
  for (QComboBox* box : {map_, range_}) box->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  range_->setToolTip("Upper end of the colour range");
  for (const RangeMode mode : kAllRangeModes) range_->addItem(nameOf(mode));
  minimum_ = rangeField(header, "rangeMinimum", "Value of the lowest colour");
  maximum_ = rangeField(header, "rangeMaximum", "Value of the highest colour");
  to_ = new QLabel("–", header);
  taxels_ = named(new QComboBox(header), "taxelsBox");
  taxels_->setFocusPolicy(Qt::ClickFocus);
  taxels_->setToolTip("Normal component of the readings, or the length of all components");
  for (const TaxelView view : kAllTaxelViews) taxels_->addItem(nameOf(view));
  arrows_ = rangeField(header,
                       "arrowScale",
                       "Arrows of shear: with 1 a shear as large as the upper end of the colour "
                       "range is one taxel long; 0: none");
  arrows_->setPrefix("↗ ");
  arrows_->setDecimals(1);
  arrows_->setRange(0.0, kLongestArrows);
  arrows_->setSingleStep(0.5);
  arrows_->setSpecialValueText("no arrows");
  fitToText(*arrows_, [this] {
    arrows_->setFixedWidth(arrows_->fontMetrics().horizontalAdvance("no arrows") + 18);
  });
  taxels_->hide();
  arrows_->hide();

  QHBoxLayout& row = header->row();
  row.setContentsMargins(12, 4, 10, 4);
  row.setSpacing(6);
  row.addWidget(title);
  row.addStretch(1);
  looks_ = {makeToolButton(header, interpolated), makeToolButton(header, values)};
  for (QToolButton* button : looks_) row.addWidget(button);
  row.addSpacing(6);
  row.addWidget(taxels_);
  row.addWidget(arrows_);
  row.addWidget(map_);
  row.addWidget(range_);
  row.addWidget(minimum_);
  row.addWidget(to_);
  row.addWidget(maximum_);
  // They are in the menu View, too.
  header->setOptional({map_, looks_[0], looks_[1]});

  view_ = named(new MatricesView(this), "matricesView");
  setLayout(inColumn({header, {view_, 1}}, Space::kNone));

  connect(map_, &QComboBox::activated, this, [this](int index) {
    emit mapChosen(kAllColorMaps[static_cast<std::size_t>(index)]);
  });
  connect(range_, &QComboBox::activated, this, [this](int index) {
    emit rangeChosen(kAllRangeModes[static_cast<std::size_t>(index)]);
  });
  connect(taxels_, &QComboBox::activated, this, [this](int index) {
    emit taxelsChosen(kAllTaxelViews[static_cast<std::size_t>(index)]);
  });
  connect(arrows_, &QDoubleSpinBox::valueChanged, this, &MatricesPanel::arrowsChosen);
  const auto manual = [this] {
    // A maximum that is not above the minimum is raised to minimum + 1.
    const double low = minimum_->value();
    const double step = std::pow(10.0, -minimum_->decimals());
    emit manualRangeChosen(low, std::max(maximum_->value(), low + step));
  };
  connect(minimum_, &QDoubleSpinBox::valueChanged, this, manual);
  connect(maximum_, &QDoubleSpinBox::valueChanged, this, manual);
}

void MatricesPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const bool narrow = event->size().width() < kMatricesPanelCompactBelow;
  for (QToolButton* button : looks_)
    button->setToolButtonStyle(narrow ? Qt::ToolButtonIconOnly : Qt::ToolButtonTextBesideIcon);
}

void MatricesPanel::setRecording(const OpenedRecordingPtr& recording) {
  recording_ = recording;
  largestMagnitude_ = 0.0;
  frame_ = TactileFrame();
  hand_.reset();
  if (!recording_) {
    view_->clear();
    return;
  }
  range_->setItemText(0, nameOf(RangeMode::kRecording));
  hand_ = recording_->profile.hand();
  showUnit();
  view_->setHand(*hand_);
  applyLook();
}

void MatricesPanel::forgetLargest() { largestLive_ = 0.0; }

void MatricesPanel::setHand(const HandDescription& hand) {
  recording_.reset();
  frame_ = TactileFrame();
  // A live source has no whole recording yet.
  range_->setItemText(0, "maximum so far");
  hand_ = hand;
  largestLive_ = std::max(largestLive_, liveRangePart(hand, kMinLivePart));
  showUnit();
  view_->setHand(hand);
  applyLook();
}

void MatricesPanel::showUnit() {
  const bool shears = hasShear(*hand_->layout);
  taxels_->setVisible(shears || hasSign(*hand_->layout));
  arrows_->setVisible(shears);
  const int decimals = decimalsOf(*hand_);
  const QSignalBlocker blockedMin(minimum_), blockedMax(maximum_);
  for (QDoubleSpinBox* field : {minimum_, maximum_}) {
    field->setDecimals(decimals);
    field->setSingleStep(liveRangePart(*hand_, kLiveStepPart / 5.0));
  }
  minimum_->setValue(settings_.manualMin);
  maximum_->setValue(settings_.manualMax);
  minimum_->setToolTip("Value of the lowest colour in " + unitOf(*hand_));
  maximum_->setToolTip("Value of the highest colour in " + unitOf(*hand_));
}

void MatricesPanel::show(const TactileFrame& frame) {
  frame_ = frame;
  const double drawn = largestShown();
  if (settings_.range == RangeMode::kFrame ||
      isDrawnSigned(frame_, settings_.taxels) != view_->look().isSigned) {
    applyLook();
  } else if (recording_ && drawn > largestMagnitude_) {
    // What is known of a recording are its values.
    largestMagnitude_ = drawn;
    renewRange();
  } else if (!recording_) {
    const double largest = std::max(
        drawn, static_cast<double>(*std::max_element(frame_.values.begin(), frame_.values.end())));
    // In steps, so that the colours don't change continuously while the force increases.
    if (largest > largestLive_) {
      const double step = liveRangePart(*hand_, kLiveStepPart);
      largestLive_ = std::ceil(largest / step) * step;
      applyLook();
    }
  }
  view_->setFrame(frame_);
}

void MatricesPanel::setSettings(const ViewSettings& settings) {
  settings_ = settings;
  const QSignalBlocker blockedMin(minimum_), blockedMax(maximum_);
  map_->setCurrentText(nameOf(settings.map));
  range_->setCurrentIndex(
      static_cast<int>(std::find(kAllRangeModes.begin(), kAllRangeModes.end(), settings.range) -
                       kAllRangeModes.begin()));
  const QSignalBlocker blockedArrows(arrows_);
  taxels_->setCurrentText(nameOf(settings.taxels));
  arrows_->setValue(settings.arrows);
  minimum_->setValue(settings.manualMin);
  maximum_->setValue(settings.manualMax);
  const bool manual = settings.range == RangeMode::kManual;
  for (QWidget* part : {static_cast<QWidget*>(minimum_),
                        static_cast<QWidget*>(to_),
                        static_cast<QWidget*>(maximum_)})
    part->setVisible(manual);
  applyLook();
}

double MatricesPanel::largestShown() const {
  return settings_.taxels == TaxelView::kMagnitude ? largestDrawn(frame_, settings_.taxels) : 0.0;
}

ValueRange MatricesPanel::rangeNow() const {
  const bool isSigned = isDrawnSigned(frame_, settings_.taxels);
  const double scale = hand_ ? std::pow(10.0, decimalsOf(*hand_)) : 1.0;
  double maximum = 1.0 / scale;
  switch (settings_.range) {
    case RangeMode::kManual:
      return {isSigned ? -settings_.manualMax : settings_.manualMin, settings_.manualMax};
    case RangeMode::kFullScale:
      if (hand_) maximum = static_cast<double>(hand_->maximumCounts);
      break;
    case RangeMode::kFrame:
      for (const float value : frame_.values)
        maximum = std::max(maximum, static_cast<double>(value));
      maximum = std::max(maximum, largestShown());
      break;
    case RangeMode::kRecording:
      maximum =
          std::max(maximum, recording_ ? recording_->maximumNow().value_or(0.0) : largestLive_);
      if (settings_.taxels == TaxelView::kMagnitude)
        maximum = std::max({maximum, largestMagnitude_, largestShown()});
      break;
  }
  // Filters produce fractions; the scale needs whole steps of the last decimal.
  const double end = std::ceil(maximum * scale) / scale;
  return {isSigned ? -end : 0.0, end};
}

void MatricesPanel::renewRange() {
  if (!(rangeNow() == view_->look().range)) applyLook();
}

void MatricesPanel::applyLook() {
  view_->setLook({.map = settings_.map,
                  .interpolated = settings_.interpolated,
                  .values = settings_.values,
                  .range = rangeNow(),
                  .taxels = settings_.taxels,
                  .isSigned = isDrawnSigned(frame_, settings_.taxels),
                  .arrows = settings_.arrows,
                  .theme = shownTheme()});
  const bool isSigned = view_->look().isSigned;
  map_->setEnabled(!isSigned);
  map_->setToolTip(isSigned ? "Readings with a sign use the diverging colour map" : "Colour map");
  emit lookChanged(view_->look());
}

MatricesPictureOptions MatricesPanel::pictureOptions() const {
  MatricesPictureOptions options;
  options.map = settings_.map;
  options.interpolated = settings_.interpolated;
  options.values = settings_.values;
  const ValueRange range = rangeNow();
  options.rangeMin = range.minimum;
  options.rangeMax = range.maximum;
  options.taxels = settings_.taxels;
  options.isSigned = isDrawnSigned(frame_, settings_.taxels);
  options.arrows = settings_.arrows;
  options.theme = shownTheme();
  options.font = font();
  return options;
}

}  // namespace palpate::gui
