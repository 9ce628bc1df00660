#include "gui/compare/compare_panel.h"

#include <QAction>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QResizeEvent>
#include <QStackedWidget>
#include <QStyle>
#include <algorithm>
#include <cmath>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/signals/signal_name.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/difference_map.h"
#include "gui/appearance/hand_unit.h"
#include "gui/chart/chart_picture.h"
#include "gui/compare/compare_chart.h"
#include "gui/compare/compare_header.h"
#include "gui/compare/compare_strip.h"
#include "gui/compare/compare_view.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/make.h"
#include "gui/widgets/signal_box.h"

namespace palpate::gui {
namespace {

constexpr int kViewShare = 5;  // shares of the height: heat maps and chart
constexpr int kChartShare = 2;
constexpr int kMinHeight = 150;   // [px] of heat maps and chart together; they scroll then
constexpr int kBesideBoxes = 16;  // [px] between the boxes above the chart and the figures

bool contains(const std::vector<OpenedRecordingPtr>& all, const OpenedRecordingPtr& one) {
  return one && std::find(all.begin(), all.end(), one) != all.end();
}

int comparePanelIndexOf(const std::vector<OpenedRecordingPtr>& all, const OpenedRecordingPtr& one) {
  const auto at = std::find(all.begin(), all.end(), one);
  return at == all.end() ? -1 : static_cast<int>(at - all.begin());
}

constexpr double kMinRange = 1.0;       // [counts]
constexpr double kHeatMapShare = 0.62;  // of the height of an exported picture

double comparePanelViewLargestOf(const TactileFrame& frame) {
  double largest = 0.0;
  for (const float value : frame.values)
    largest = std::max(largest, std::abs(static_cast<double>(value)));
  return largest;
}

QString durationText(double seconds) {
  constexpr double kMinuteS = 60.0, kHourS = 3600.0, kDayS = 86'400.0;
  if (seconds < 2 * kMinuteS) return figure(seconds, 2) + " s";
  if (seconds < 2 * kHourS) return figure(seconds / kMinuteS, 1) + " min";
  if (seconds < 2 * kDayS) return figure(seconds / kHourS, 1) + " h";
  return figure(seconds / kDayS, 1) + " days";
}

const TimedProfile& sideOf(const CompareAnswer& answer, bool ofB) {
  return ofB ? *answer.b : *answer.a;
}

}  // namespace

ComparePanel::ComparePanel(QAction* leave, QAction* interpolated, QAction* values, QWidget* parent)
    : QWidget(parent) {
  setObjectName("comparePanel");
  build(leave, interpolated, values);
  connectParts();
  fillMatrices();
  showEmpty();
}

ComparePanel::~ComparePanel() = default;

void ComparePanel::build(QAction* leave, QAction* interpolated, QAction* values) {
  header_ = new CompareHeader(leave, interpolated, values, this);
  notice_ = makeLines(this, "compareNotice");
  notice_->setContentsMargins(14, 4, 14, 4);
  auto* content = new QWidget(this);
  view_ = named(new CompareView(content), "compareView");
  chart_ = named(new CompareChart(content), "compareChart");
  strip_ = named(new CompareStrip(*chart_, content), "compareStrip");
  content->setLayout(
      inColumn({notice_, {view_, kViewShare}, makeCurveHeader(), strip_, {chart_, kChartShare}},
               Space::kNone));
  stack_ = new FittingPages(this);
  stack_->addWidget(makeEmpty());
  stack_->addWidget(new ContentScroll(content, {0, kMinHeight}, this));
  setLayout(inColumn({header_, {stack_, 1}}, Space::kNone));
}

QWidget* ComparePanel::makeCurveHeader() {
  auto* header = named(new QWidget(this), "ViewHeader");
  header->setAttribute(Qt::WA_StyledBackground);
  const auto box = [header](const char* name, const QString& tip) {
    auto* made = named(new QComboBox(header), name, tip, tip);
    made->setFocusPolicy(Qt::TabFocus);
    return made;
  };
  signal_ = box("compareSignal", "Plotted signal");
  offerSignals(*signal_, false);
  matrix_ = box("compareMatrix", "Plotted matrix");
  overlayBox_ = box("compareOverlay", "Choose the curves of the chart, all aligned with A");
  for (const CompareOverlay overlay : kAllCompareOverlays)
    overlayBox_->addItem(gui::nameOf(overlay));
  bandBox_ = box("compareBand", "Average the curves of the chart, with a band");
  for (const CompareBand band : kAllCompareBands) bandBox_->addItem(gui::nameOf(band));
  figures_ = makeLines(header, "compareFigures");
  figures_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  figures_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  boxes_ = inRow({signal_, matrix_, Space::kWide, overlayBox_, bandBox_});
  curveHeader_ = new QGridLayout(header);
  curveHeader_->setContentsMargins(12, 3, 10, 3);
  curveHeader_->setHorizontalSpacing(kBesideBoxes);
  curveHeader_->setVerticalSpacing(3);
  curveHeader_->setColumnStretch(1, 1);
  curveHeader_->addLayout(boxes_, 0, 0);
  curveHeader_->addWidget(figures_, 0, 1);
  return header;
}

QWidget* ComparePanel::makeEmpty() {
  auto* page = new QWidget(this);
  emptyText_ = makeLines(page, "compareEmpty");
  emptyText_->setAlignment(Qt::AlignCenter);
  emptyOpen_ = makePrimary(page, "compareOpen", "Open another…");
  emptyItself_ = makeButton(page,
                            "compareItself",
                            "Compare it with itself",
                            "Two grasps of the same recording: B can be shifted");
  page->setLayout(inColumn(
      {Stretch{}, emptyText_, inRow({Stretch{}, emptyOpen_, emptyItself_, Stretch{}}), Stretch{}},
      Space::kWide,
      kPageEdges));
  return page;
}

void ComparePanel::connectParts() {
  connect(header_, &CompareHeader::openRequested, this, &ComparePanel::askForAnother);
  connect(emptyOpen_, &QPushButton::clicked, this, &ComparePanel::askForAnother);
  connect(emptyItself_, &QPushButton::clicked, this, [this] { setB(a_); });
  connect(header_, &CompareHeader::aChosen, this, [this](int index) {
    const OpenedRecordingPtr chosen = recordings_.at(static_cast<std::size_t>(index));
    if (chosen == a_) return;
    if (chosen == b_) return swap();
    emit aChosen(chosen);
  });
  connect(header_, &CompareHeader::bChosen, this, [this](int index) {
    setB(recordings_.at(static_cast<std::size_t>(index)));
  });
  connect(header_, &CompareHeader::swapRequested, this, &ComparePanel::swap);
  connect(header_, &CompareHeader::alignmentChosen, this, &ComparePanel::setAlignment);
  connect(header_, &CompareHeader::offsetTyped, this, &ComparePanel::setOffset);
  connect(header_, &CompareHeader::graspsChosen, this, &ComparePanel::setGrasps);
  connect(overlayBox_, &QComboBox::activated, this, [this](int index) {
    setOverlay(kAllCompareOverlays[static_cast<std::size_t>(index)]);
    emit overlayChanged();
  });
  connect(bandBox_, &QComboBox::activated, this, [this](int index) {
    setBand(kAllCompareBands[static_cast<std::size_t>(index)]);
    emit overlayChanged();
  });
  connect(&worker_, &CompareWorker::answered, this, &ComparePanel::take);
  for (auto* dragged : {static_cast<QObject*>(chart_), static_cast<QObject*>(strip_)}) {
    const auto on = [this](double offsetS) { moveTo(offsetS, true); };
    const auto ended = [this] {
      chart_->settle();
      ask();
    };
    if (dragged == chart_) {
      connect(chart_, &CompareChart::shifted, this, on);
      connect(chart_, &CompareChart::shiftEnded, this, ended);
    } else {
      connect(strip_, &CompareStrip::shifted, this, on);
      connect(strip_, &CompareStrip::shiftEnded, this, ended);
    }
  }
  connect(chart_, &CompareChart::seekRequested, this, [this](double seconds) {
    const TimeSpan all = chart_->whole();
    emit seekRequested(std::clamp(seconds, all.fromS, all.toS));
  });
  connect(signal_, &QComboBox::activated, this, [this](int index) {
    emit signalChosen(kAllPlottedSignals[static_cast<std::size_t>(index)]);
  });
  connect(matrix_, &QComboBox::activated, this, [this] {
    signal_->setEnabled(!column());
    ask();
  });
  connect(view_, &CompareView::hovered, this, &ComparePanel::hovered);
}

bool ComparePanel::hasPair() const { return a_ && b_; }

void ComparePanel::setRecordings(const std::vector<OpenedRecordingPtr>& recordings,
                                 const OpenedRecordingPtr& a) {
  const OpenedRecordingPtr beforeA = a_, beforeB = b_;
  for (const auto& each : recordings) {
    if (!wantsNew_ || contains(recordings_, each)) continue;
    b_ = each;
    wantsNew_ = false;
    withItself_ = false;
  }
  recordings_ = recordings;
  a_ = contains(recordings_, a) ? a : nullptr;
  if (a_ != beforeA) withItself_ = false;
  // When B becomes A, the previous A becomes B.
  if (a_ && a_ == b_ && !withItself_ && contains(recordings_, beforeA)) b_ = beforeA;
  if (!contains(recordings_, b_) || (b_ == a_ && !withItself_)) {
    b_ = nullptr;
    for (const auto& each : recordings_)
      if (a_ && each != a_ && !b_) b_ = each;
  }
  QStringList names;
  for (const auto& each : recordings_) names.append(fileNameOf(*each));
  header_->setRecordings(
      names, comparePanelIndexOf(recordings_, a_), comparePanelIndexOf(recordings_, b_));
  if (a_ != beforeA || b_ != beforeB)
    pairChanged();
  else if (overlay_ == CompareOverlay::kRecordings || overlay_ == CompareOverlay::kAllGrasps)
    ask();
  showEmpty();
}

void ComparePanel::setB(const OpenedRecordingPtr& b) {
  if (!contains(recordings_, b) || b == b_) return;
  b_ = b;
  wantsNew_ = false;
  withItself_ = b_ == a_;
  QStringList names;
  for (const auto& each : recordings_) names.append(fileNameOf(*each));
  header_->setRecordings(
      names, comparePanelIndexOf(recordings_, a_), comparePanelIndexOf(recordings_, b_));
  pairChanged();
  showEmpty();
}

void ComparePanel::askForAnother() {
  wantsNew_ = a_ != nullptr;
  emit openRequested();
}

std::optional<TimeSpan> ComparePanel::common() const {
  if (!answer_.a || !answer_.b) return std::nullopt;
  return commonSpan(*answer_.a, *answer_.b, answer_.offsetS);
}

void ComparePanel::pairChanged() {
  showSignal();
  worker_.abandon();
  answer_ = {};
  comparison_.reset();
  asked_ = false;
  graspA_ = 0;
  // The second grasp of a recording is compared with its first one.
  graspB_ = a_ == b_ ? 1 : 0;
  header_->setGrasps(0, 0, 0, 0);
  // A manual offset belongs to two certain recordings; for others it is reset.
  if (alignment_ == Alignment::kManual) alignment_ = Alignment::kContact;
  header_->setAlignment(alignment_);
  header_->setOffset(std::nullopt);
  fillMatrices();
  if (hasPair()) {
    const HandDescription& handA = a_->profile.hand();
    const HandDescription& handB = b_->profile.hand();
    comparison_.emplace(handA.layout, handB.layout);
    HandDescription difference = handA;
    difference.layout = comparison_->layout();
    view_->setHands({handA, handB, difference});
  } else {
    view_->clear();
  }
  showCurves();
  showFrames();
  ask();
}

void ComparePanel::fillMatrices() {
  const QString before = matrix_->currentText();
  matrix_->clear();
  const std::size_t count = a_ ? a_->numMatrices() : 0;
  matrix_->addItem("all matrices", QVariant::fromValue<qulonglong>(count));
  for (std::size_t m = 0; m < count; ++m)
    matrix_->addItem(QString::fromStdString(a_->profile.hand().matrixName(m)),
                     QVariant::fromValue<qulonglong>(m));
  columns_.clear();
  if (a_)
    for (const SeriesDescription& series : furtherSeriesOf(a_->profile))
      for (std::size_t i = 0; i < series.columns.size(); ++i) {
        PlottedCurve column = columnCurve(series, i, columns_.size());
        if (!hasSeries(a_->profile, column.choice)) continue;
        columns_.push_back(column);
        matrix_->addItem(column.name);
      }
  matrix_->setCurrentIndex(std::max(0, matrix_->findText(before)));
  signal_->setEnabled(!column());
}

bool ComparePanel::givesReadings() const { return a_ && a_->profile.givesReadings(); }

PlottedSignal ComparePanel::plottedSignal() const {
  return plottable(settings_.signal, givesReadings());
}

void ComparePanel::showSignal() {
  offerSignals(*signal_, givesReadings());
  signal_->setCurrentText(gui::nameOf(plottedSignal()));
}

const PlottedCurve* ComparePanel::column() const {
  const int behind = matrix_->count() - matrix_->currentIndex();
  const auto count = static_cast<int>(columns_.size());
  return behind > 0 && behind <= count ? &columns_[static_cast<std::size_t>(count - behind)]
                                       : nullptr;
}

QString ComparePanel::baseUnit() const {
  return column() ? column()->baseUnit : unitOf(plottedSignal(), handUnit());
}

void ComparePanel::setActive(bool on) {
  active_ = on;
  if (!on) return worker_.abandon();
  // Grasps may have been edited meanwhile.
  const bool ofGrasps = alignment_ == Alignment::kGrasp || overlay_ == CompareOverlay::kGraspsOfA ||
                        overlay_ == CompareOverlay::kAllGrasps;
  openAtContact();
  if (!answer_.complete || ofGrasps) asked_ = false;
  if (!asked_) ask();
  showFrames();
}

void ComparePanel::ask() {
  asked_ = active_ && hasPair();
  if (!asked_) return;
  // Removes the figures of the previous curves, so that they are not taken for those of the new
  // ones.
  answer_.complete = false;
  answer_.figures.reset();
  answer_.done = 0.0;
  showNotice();
  std::vector<ComparedRecording> compared;
  for (const OpenedRecordingPtr& each : recordings_)
    compared.push_back({each, events_ ? events_(each) : each->events.events});
  worker_.ask({.a = a_,
               .b = b_,
               .alignment = alignment_,
               .handOffsetS = handOffsetS_,
               .choice = column() ? column()->choice
                                  : SeriesChoice{.kind = SeriesChoice::Kind::kMatrix,
                                                 .index = matrix_->currentData().toULongLong(),
                                                 .signal = plottedSignal()},
               .graspA = graspA_,
               .graspB = graspB_,
               .overlay = overlay_,
               .band = band_,
               .recordings = std::move(compared)});
}

void ComparePanel::openAtContact() {
  if (!active_ || !answer_.a || !answer_.b || timeS_ > 0.0) return;
  const TimedProfile& inA = *answer_.a;
  const auto frame = answer_.alignment == Alignment::kGrasp     ? inA.grasp
                     : answer_.alignment == Alignment::kContact ? inA.contact
                                                                : std::nullopt;
  if (frame && inA.timeS(*frame) > 0.0) emit seekRequested(inA.timeS(*frame));
}

void ComparePanel::setGrasps(std::size_t ofA, std::size_t ofB) {
  graspA_ = ofA;
  graspB_ = ofB;
  ask();
}

void ComparePanel::setOverlay(CompareOverlay overlay) {
  overlay_ = overlay;
  overlayBox_->setCurrentText(gui::nameOf(overlay));
  ask();
}

void ComparePanel::setBand(CompareBand band) {
  band_ = band;
  bandBox_->setCurrentText(gui::nameOf(band));
  ask();
}

void ComparePanel::take(const CompareAnswer& answer) {
  const bool first = !answer_.a || !answer_.b;
  const auto largest = answer_.largestDifference;
  const double largestValue = answer_.largestValue;
  const ComparedCurves overlaid = answer_.overlaid;
  answer_ = answer;
  if (!answer_.complete && !first && !answer_.largestDifference) {
    // Keeps colours and curves until the new ones are computed, so that they don't flicker.
    answer_.largestDifference = largest;
    answer_.largestValue = largestValue;
  }
  if (!answer_.complete && answer_.overlaid.averages.empty() && answer_.overlaid.curves.empty())
    answer_.overlaid = overlaid;
  if (answer_.a && answer_.b) {
    header_->setOffset(answer_.offsetS);
    header_->setGrasps(answer_.graspsA.size(), answer_.graspsB.size(), graspA_, graspB_);
    showCurves();
    if (first) chart_->fit();
    if (first) openAtContact();
  }
  showFrames();
}

std::optional<double> ComparePanel::offsetS() const {
  if (!answer_.a || !answer_.b) return std::nullopt;
  return answer_.offsetS;
}

void ComparePanel::setAlignment(Alignment alignment) {
  if (alignment == Alignment::kManual) handOffsetS_ = answer_.offsetS;
  alignment_ = alignment;
  header_->setAlignment(alignment);
  // The grasps are found by the worker.
  if (answer_.a && answer_.b && alignment != Alignment::kGrasp) {
    const auto [by, offsetS] = chosenOffset(*answer_.a, *answer_.b, alignment, handOffsetS_);
    answer_.alignment = by;
    answer_.offsetS = offsetS;
    answer_.figures.reset();
    answer_.complete = false;
    header_->setOffset(offsetS);
    chart_->setOffset(offsetS);
    chart_->settle();
    showFrames();
  }
  ask();
  emit alignmentChanged();
}

void ComparePanel::setOffset(double offsetS) {
  moveTo(offsetS, false);
  ask();
}

// Must be fast, because every movement of the mouse calls it. The figures are computed after the
// movement ends.
void ComparePanel::moveTo(double offsetS, bool keepSeen) {
  if (!answer_.a || !answer_.b) return;
  const bool changed = alignment_ != Alignment::kManual;
  worker_.abandon();
  handOffsetS_ = offsetS;
  alignment_ = Alignment::kManual;
  answer_.alignment = alignment_;
  answer_.offsetS = offsetS;
  answer_.figures.reset();
  answer_.complete = false;
  header_->setAlignment(alignment_);
  header_->setOffset(offsetS);
  chart_->setOffset(offsetS);
  if (!keepSeen) chart_->settle();
  strip_->update();
  showFrames();
  if (changed) emit alignmentChanged();
}

void ComparePanel::swap() {
  if (!hasPair() || a_ == b_) return;
  const double timeS = timeS_ - answer_.offsetS;
  const bool byHand = alignment_ == Alignment::kManual;
  const double offsetS = -answer_.offsetS;
  const auto graspA = graspB_, graspB = graspA_;
  emit swapRequested(b_, timeS);
  graspA_ = graspA;
  graspB_ = graspB;
  if (byHand) {
    handOffsetS_ = offsetS;
    alignment_ = Alignment::kManual;
    header_->setAlignment(alignment_);
  }
  ask();
}

void ComparePanel::setTime(double seconds) {
  timeS_ = seconds;
  chart_->setPosition(seconds);
  if (active_) showFrames();
}

void ComparePanel::setSettings(const ViewSettings& settings) {
  const bool otherSignal = settings.signal != settings_.signal;
  const bool otherUnits = settings.units != settings_.units;
  settings_ = settings;
  showSignal();
  if (otherSignal) {
    asked_ = false;
    ask();
  }
  if (otherUnits) showCurves();
  showFrames();
}

void ComparePanel::showEmpty() {
  stack_->setCurrentIndex(hasPair() ? 1 : 0);
  if (hasPair()) return;
  emptyItself_->setVisible(a_ != nullptr);
  emptyOpen_->setText(a_ ? "Open another…" : "Open recordings…");
  emptyText_->setText(a_ ? "Only " + fileNameOf(*a_) +
                               " is open. Open a second recording to compare it with."
                         : QString("Open two recordings to compare them."));
}

QString ComparePanel::handUnit() const { return a_ ? unitOf(a_->profile.hand()) : QString(); }

void ComparePanel::showCurves() {
  chart_->setCurves({.a = answer_.a,
                     .b = answer_.b,
                     .curveA = answer_.curveA,
                     .curveB = answer_.curveB,
                     .offsetS = answer_.offsetS,
                     .signal = plottedSignal(),
                     .column = column() ? std::optional(*column()) : std::nullopt,
                     .handUnit = handUnit(),
                     .units = settings_.units,
                     .overlaid = answer_.overlaid});
}

QString ComparePanel::captionOf(bool ofB, const std::optional<std::size_t>& frame) const {
  if (!frame) return "no frame";
  return "frame " + QString::number(*frame) + " · " +
         figure(sideOf(answer_, ofB).timeS(*frame), 2) + " s";
}

QString ComparePanel::absenceOf(bool ofB) const {
  const TimedProfile& timed = sideOf(answer_, ofB);
  const QString name = ofB ? "B" : "A";
  if (timed.profile.numFrames() == 0) return name + " has no frames";
  const double offsetS = ofB ? answer_.offsetS : 0.0;
  const double at = timeS_ - offsetS;
  if (at < 0.0) return name + " begins " + durationText(-at) + " later";
  const double durationS = timed.timing.durationS;
  if (at > durationS) return name + " ended " + durationText(at - durationS) + " ago";
  return name + " has a gap here";
}

void ComparePanel::showFrames() {
  if (!hasPair() || !active_) return;
  ComparedFrames frames;
  auto& [inA, inB, between] = frames;
  inA.name = fileNameOf(*a_);
  inB.name = fileNameOf(*b_);
  between.name = "A − B";
  if (!answer_.a || !answer_.b) {
    inA.notice = inB.notice = answer_.failure.isEmpty() ? "reading …" : answer_.failure;
    view_->setFrames(std::move(frames));
    showLook();
    return showNotice();
  }
  for (const bool ofB : {false, true}) {
    CompareGroupContent& content = ofB ? inB : inA;
    const TimedProfile& timed = sideOf(answer_, ofB);
    const auto frame = timed.frameAt(timeS_ - (ofB ? answer_.offsetS : 0.0));
    content.caption = captionOf(ofB, frame);
    if (!frame) {
      content.notice = absenceOf(ofB);
      continue;
    }
    try {
      timed.profile.readFrame(*frame, content.frame);
    } catch (const Error& error) {
      content.frame = {};
      content.notice = inWindowWords(QString::fromUtf8(error.what()));
    }
  }
  const bool both = !inA.frame.values.empty() && !inB.frame.values.empty();
  if (both) {
    comparison_->difference(inA.frame, inB.frame, between.frame);
    const DifferenceStatistics whole = comparison_->statistics(inA.frame, inB.frame).back();
    between.caption = "both at rest";
    if (whole.touched > 0) {
      const QString place = QString::fromStdString(a_->profile.hand().matrixName(whole.matrix)) +
                            ", x " + QString::number(whole.x) + ", y " + QString::number(whole.y);
      const QString mean = "mean " + signedText(whole.mean, 1);
      const QString rms = " · rms " + figure(whole.rms, 1);
      const QString largest = " · largest " + signedText(whole.largest, 0);
      between.caption = mean + rms + largest + " at " + place;
      between.shorterCaptions = {mean + rms + largest, mean + rms};
    }
  } else {
    between.notice = "needs a frame of A and of B";
  }
  bool any = false;
  for (std::size_t m = 0; m < a_->numMatrices(); ++m) any = any || comparison_->compared(m);
  if (!any) {
    between.caption.clear();
    between.notice = "nothing to compare: other matrices";
  }
  view_->setFrames(std::move(frames));
  showLook();
  showNotice();
}

ComparePictureOptions ComparePanel::pictureOptions() const {
  ComparePictureOptions options;
  options.look.map = settings_.map;
  options.look.interpolated = settings_.interpolated;
  options.look.values = settings_.values;
  options.look.theme = shownTheme();
  options.look.font = font();
  const auto& [inA, inB, between] = view_->frames();
  double& maximum = options.look.rangeMax;
  switch (settings_.range) {
    case RangeMode::kManual:
      options.look.rangeMin = settings_.manualMin;
      maximum = settings_.manualMax;
      options.largestDifference = settings_.manualMax;
      break;
    case RangeMode::kFullScale:
      for (const OpenedRecordingPtr& side : {a_, b_})
        if (side)
          maximum = std::max(maximum, static_cast<double>(side->profile.hand().maximumCounts));
      options.largestDifference = maximum;
      break;
    case RangeMode::kFrame:
      maximum =
          std::max(comparePanelViewLargestOf(inA.frame), comparePanelViewLargestOf(inB.frame));
      options.largestDifference = comparePanelViewLargestOf(between.frame);
      break;
    case RangeMode::kRecording:
      // The largest value of a long recording is known only after all of it has been read.
      maximum = std::max({answer_.largestValue,
                          comparePanelViewLargestOf(inA.frame),
                          comparePanelViewLargestOf(inB.frame)});
      for (const OpenedRecordingPtr& side : {a_, b_})
        if (side) maximum = std::max(maximum, side->maximumNow().value_or(0.0));
      options.largestDifference = answer_.largestDifference.value_or(maximum);
      break;
  }
  maximum = std::max(maximum, options.look.rangeMin + kMinRange);
  options.largestDifference = std::max(options.largestDifference, kMinRange);
  return options;
}

void ComparePanel::showLook() { view_->setOptions(pictureOptions()); }

QString ComparePanel::notice() const {
  if (!hasPair()) return {};
  if (!answer_.failure.isEmpty()) return answer_.failure;
  QStringList lines;
  if (comparison_ && !comparison_->allCompared()) {
    QStringList others;
    for (std::size_t m = 0; m < a_->numMatrices(); ++m)
      if (!comparison_->compared(m))
        others.append(QString::fromStdString(a_->profile.hand().matrixName(m)));
    const std::size_t inA = a_->numMatrices(), inB = b_->numMatrices();
    if (!others.isEmpty())
      lines.append("Not compared, because they have different rows and columns in B: " +
                   others.join(", "));
    if (inB > inA)
      lines.append("B has " + QString::number(inB - inA) +
                   (inB - inA == 1 ? " matrix" : " matrices") + " more than A");
  }
  if (!answer_.a || !answer_.b) return lines.join(". ");
  const TimedProfile &inA = *answer_.a, &inB = *answer_.b;
  if (alignment_ == Alignment::kContact && answer_.alignment != Alignment::kContact) {
    QStringList without;
    if (!inA.contact) without.append("A");
    if (!inB.contact && a_ != b_) without.append("B");
    lines.append("No lasting contact (3 taxels in 3 frames) in " + without.join(" and ") +
                 ": the recordings are aligned at their starts");
  }
  if (alignment_ == Alignment::kGrasp && answer_.alignment != Alignment::kGrasp &&
      answer_.complete) {
    QStringList without;
    if (answer_.graspsA.empty()) without.append("A");
    if (answer_.graspsB.empty() && a_ != b_) without.append("B");
    lines.append("No grasp in " + without.join(" and ") +
                 ": the recordings are aligned at their starts");
  }
  if (!answer_.overlaid.leftOut.isEmpty()) lines.append(answer_.overlaid.leftOut);
  for (const auto& [name, count] :
       {std::pair("A", answer_.unreadableA), std::pair("B", answer_.unreadableB)})
    if (count > 0)
      lines.append(QString(name) + " is damaged: " +
                   QString::fromStdString(counted(count, "frame")) + " can't be read");
  const bool frames = inA.profile.numFrames() > 0 && inB.profile.numFrames() > 0;
  if (frames && !commonSpan(inA, inB, answer_.offsetS)) {
    const double laterS = answer_.offsetS - inA.timing.durationS;
    lines.append(laterS > 0.0
                     ? "No common time: B begins " + durationText(laterS) + " after A ended"
                     : "No common time: B ended " +
                           durationText(-(answer_.offsetS + inB.timing.durationS)) +
                           " before A begins");
  } else if (frames && a_ == b_ && answer_.offsetS == 0.0) {
    lines.append("The same recording twice: drag B's bar to compare another grasp with A");
  }
  return lines.join(". ");
}

// "6 grasps, mean ± sd · "; empty without an overlay.
QString ComparePanel::overlaidText() const {
  const ComparedCurves& overlaid = answer_.overlaid;
  if (overlay_ == CompareOverlay::kPair && band_ == CompareBand::kNone) return {};
  if (!answer_.complete) return {};
  const bool ofGrasps =
      overlay_ == CompareOverlay::kGraspsOfA || overlay_ == CompareOverlay::kAllGrasps;
  const std::size_t count = overlaid.curves.size();
  return QString::fromStdString(counted(count, ofGrasps ? "grasp" : "curve")) +
         (band_ == CompareBand::kNone ? QString() : ", " + gui::nameOf(band_)) +
         (overlaid.averages.size() > 1 ? " of each recording · " : " · ");
}

QString ComparePanel::figures() const {
  if (!answer_.a || !answer_.b || !hasPair()) return {};
  if (!answer_.figures) {
    if (!answer_.complete) return "computing … " + figure(100.0 * answer_.done, 0) + " %";
    return column() ? "the other recording has no such series"
                    : "the other recording has no such matrix";
  }
  const CurveComparison& found = *answer_.figures;
  if (found.samples == 0) return overlaidText() + "no common time";
  const ShownUnit unit = column() ? ShownUnit{column()->unit, {.moreDecimals = 2}}
                                  : shownUnit(plottedSignal(), handUnit(), settings_.units);
  const auto shown = [&unit](double difference) {
    return unit.conversion.ofDifference(difference);
  };
  const int decimals = 1 + unit.conversion.moreDecimals;
  const QString correlation =
      "correlation " + (found.correlation ? figure(*found.correlation, 3) : QString("not defined"));
  // Over which time the figures are.
  const QString over = answer_.figuresOfGrasps
                           ? "over what both grasps have, " + figure(found.fromS, 2) + " to " +
                                 figure(found.toS, 2) + " s"
                           : "over " + figure(found.toS - found.fromS, 2) + " s in common";
  if (overlay_ != CompareOverlay::kPair)
    return overlaidText() + "A and B: " + correlation + " " + over;
  return overlaidText() + correlation + " · A − B: mean " +
         signedText(shown(found.meanDifference), decimals) + ", rms " +
         figure(shown(found.rmsDifference), decimals) + ", largest " +
         signedText(shown(found.largestDifference), decimals) + " " + unit.symbol + " at " +
         figure(found.largestAtS, 2) + " s · " + over;
}

void ComparePanel::showNotice() {
  const QString text = notice();
  notice_->setVisible(!text.isEmpty());
  if (notice_->text() != text) notice_->setText(text);
  const ThemeColors& colors = colorsOf();
  const QString style =
      "color: " + colors.warning.name() + "; background: " + colors.panel.name() + ";";
  if (notice_->styleSheet() != style) notice_->setStyleSheet(style);
  const QString line = figures();
  if (figures_->text() != line) figures_->setText(line);
  placeFigures();
}

// The figures stand beside the boxes if there is room, else below them.
void ComparePanel::placeFigures() {
  if (!curveHeader_) return;
  const QMargins around = curveHeader_->contentsMargins();
  const int room = width() - around.left() - around.right() - boxes_->sizeHint().width() -
                   kBesideBoxes - style()->pixelMetric(QStyle::PM_ScrollBarExtent);
  const bool below = figures_->fontMetrics().horizontalAdvance(figures_->text()) > room;
  if (below == figuresBelow_) return;
  figuresBelow_ = below;
  curveHeader_->removeWidget(figures_);
  if (below)
    curveHeader_->addWidget(figures_, 1, 0, 1, 2);
  else
    curveHeader_->addWidget(figures_, 0, 1);
}

void ComparePanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  placeFigures();
}

void ComparePanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) placeFigures();
}

void ComparePanel::paint(QPainter& painter, const PictureLook& look) const {
  if (!view_->hands()) return;
  ComparePictureOptions options = pictureOptions();
  if (look.forPrint) options.look.theme = Theme::kLight;
  if (look.textUnits > 0) options.look.font.setPixelSize(look.textUnits);
  options.look.pixelRatio = look.pixelRatio;
  // A low chart takes up to half of the height.
  const double height = look.size.height();
  const double chart =
      std::max((1.0 - kHeatMapShare) * height,
               look.onPaper() ? std::min(kChartHeight * look.size.width(), height / 2) : 0.0);
  const double split = std::floor(height - chart);
  paintComparison(
      painter, QRectF(0, 0, look.size.width(), split), *view_->hands(), view_->frames(), options);
  PictureLook below = look;
  below.size.setHeight(height - split);
  below.titled = false;
  painter.save();
  painter.translate(0.0, split);
  paintChart(
      painter, below, *chart_, {.legend = chart_->legendOf(fileNameOf(*a_), fileNameOf(*b_))});
  painter.restore();
}

TextTable ComparePanel::differenceTable() const {
  const auto& [inA, inB, between] = view_->frames();
  std::vector<std::string> names;
  std::vector<DifferenceStatistics> rows;
  if (comparison_ && !between.frame.values.empty()) {
    rows = comparison_->statistics(inA.frame, inB.frame);
    for (std::size_t m = 0; m + 1 < rows.size(); ++m)
      names.push_back(a_->profile.hand().matrixName(m));
    names.emplace_back("all");
  }
  const std::size_t numRows = rows.size();
  const std::string unit = handUnit().toStdString();
  return {.header = {"matrix",
                     "touched",
                     "difference_mean [" + unit + "]",
                     "difference_rms [" + unit + "]",
                     "difference_largest [" + unit + "]",
                     "y",
                     "x"},
          .numRows = numRows,
          .row = [rows = std::move(rows), names = std::move(names)](std::size_t i) {
            const DifferenceStatistics& row = rows[i];
            const bool any = row.touched > 0;
            return std::vector<std::string>{names[i],
                                            std::to_string(row.touched),
                                            numberText(row.mean),
                                            numberText(row.rms),
                                            numberText(row.largest),
                                            any ? std::to_string(row.y) : std::string(),
                                            any ? std::to_string(row.x) : std::string()};
          }};
}

TextTable ComparePanel::averageTable() const {
  return gui::averageTable(answer_.overlaid, baseUnit());
}

// One row for each frame of A, with B's frame at the same moment if there is one; of a column one
// for each sample of A, with B's last one at or before that moment.
TextTable ComparePanel::curveTable() const {
  TextTable table{.header = {"time_s", "frame_a", "a", "frame_b", "b"}};
  if (!answer_.curveA || !answer_.a || !answer_.b) return table;
  const QString name = column() ? column()->name : gui::nameOf(plottedSignal());
  const std::string unit =
      (" " + name + (baseUnit().isEmpty() ? "" : " [" + baseUnit() + "]")).toStdString();
  table.header[2] += unit;
  table.header[4] += unit;
  table.numRows = answer_.curveA->timeS.size();
  if (column()) {
    table.header[1] = "sample_a";
    table.header[3] = "sample_b";
  }
  std::optional<double> longestS;  // of a column
  if (column() && answer_.curveB) longestS = gapOfTimesS(answer_.curveB->timeS);
  table.row = [answer = answer_, longestS, isColumn = column() != nullptr](std::size_t i) {
    const double at = answer.curveA->timeS[i];
    std::vector<std::string> cells = {
        numberText(at), std::to_string(i), numberText(answer.curveA->values[i])};
    const double inB = at - answer.offsetS;
    const auto beside = !isColumn  ? answer.b->frameAt(inB)
                        : longestS ? sampleAt(*answer.curveB, inB, *longestS)
                                   : std::nullopt;
    cells.push_back(beside ? std::to_string(*beside) : std::string());
    cells.push_back(beside && answer.curveB && *beside < answer.curveB->values.size()
                        ? numberText(answer.curveB->values[*beside])
                        : std::string());
    return cells;
  };
  return table;
}

}  // namespace palpate::gui
