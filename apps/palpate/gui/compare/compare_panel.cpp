#include "gui/compare/compare_panel.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/compare/compare_chart.h"
#include "gui/compare/compare_header.h"
#include "gui/compare/compare_strip.h"
#include "gui/compare/compare_view.h"

namespace palpate::gui {
namespace {

constexpr int kComparePanelControlHeight = 26;  // [px]
constexpr int kViewShare = 5;                   // of the height, to the chart's two
constexpr int kChartShare = 2;

bool contains(const std::vector<OpenedRecordingPtr>& all, const OpenedRecordingPtr& one) {
  return one && std::find(all.begin(), all.end(), one) != all.end();
}

int comparePanelIndexOf(const std::vector<OpenedRecordingPtr>& all, const OpenedRecordingPtr& one) {
  const auto at = std::find(all.begin(), all.end(), one);
  return at == all.end() ? -1 : static_cast<int>(at - all.begin());
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
  notice_ = new QLabel(this);
  notice_->setObjectName("compareNotice");
  notice_->setTextFormat(Qt::PlainText);
  notice_->setWordWrap(true);
  notice_->setContentsMargins(14, 4, 14, 4);
  auto* content = new QWidget(this);
  view_ = new CompareView(content);
  view_->setObjectName("compareView");
  chart_ = new CompareChart(content);
  chart_->setObjectName("compareChart");
  strip_ = new CompareStrip(*chart_, content);
  strip_->setObjectName("compareStrip");
  auto* parts = new QVBoxLayout(content);
  parts->setContentsMargins(0, 0, 0, 0);
  parts->setSpacing(0);
  parts->addWidget(notice_);
  parts->addWidget(view_, kViewShare);
  parts->addWidget(makeCurveHeader());
  parts->addWidget(strip_);
  parts->addWidget(chart_, kChartShare);
  stack_ = new QStackedWidget(this);
  stack_->addWidget(makeEmpty());
  stack_->addWidget(content);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(header_);
  column->addWidget(stack_, 1);
}

QWidget* ComparePanel::makeCurveHeader() {
  auto* header = new QWidget(this);
  header->setObjectName("ViewHeader");
  header->setAttribute(Qt::WA_StyledBackground);
  const auto box = [header](const char* name, const QString& tip) {
    auto* made = new QComboBox(header);
    made->setObjectName(name);
    made->setToolTip(tip);
    made->setAccessibleName(tip);
    made->setMinimumHeight(kComparePanelControlHeight);
    made->setFocusPolicy(Qt::TabFocus);
    return made;
  };
  signal_ = box("compareSignal", "What is plotted (S)");
  for (const PlottedSignal signal : kAllPlottedSignals) signal_->addItem(gui::nameOf(signal));
  matrix_ = box("compareMatrix", "Of which matrix");
  figures_ = new QLabel(header);
  figures_->setObjectName("compareFigures");
  figures_->setTextFormat(Qt::PlainText);
  figures_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  figures_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* row = new QHBoxLayout(header);
  row->setContentsMargins(12, 3, 10, 3);
  row->setSpacing(6);
  row->addWidget(signal_);
  row->addWidget(matrix_);
  row->addSpacing(10);
  row->addWidget(figures_, 1);
  return header;
}

QWidget* ComparePanel::makeEmpty() {
  auto* page = new QWidget(this);
  emptyText_ = new QLabel(page);
  emptyText_->setObjectName("compareEmpty");
  emptyText_->setAlignment(Qt::AlignCenter);
  emptyText_->setTextFormat(Qt::PlainText);
  emptyText_->setWordWrap(true);
  emptyOpen_ = new QPushButton("Open another…", page);
  emptyOpen_->setObjectName("compareOpen");
  emptyOpen_->setProperty("primary", true);
  emptyItself_ = new QPushButton("Compare it with itself", page);
  emptyItself_->setObjectName("compareItself");
  emptyItself_->setToolTip("Two grasps of the same recording: B can be shifted");
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  buttons->addWidget(emptyOpen_);
  buttons->addWidget(emptyItself_);
  buttons->addStretch(1);
  auto* column = new QVBoxLayout(page);
  column->setSpacing(14);
  column->addStretch(1);
  column->addWidget(emptyText_);
  column->addLayout(buttons);
  column->addStretch(1);
  return page;
}

void ComparePanel::connectParts() {
  connect(header_, &CompareHeader::openAsked, this, &ComparePanel::askForAnother);
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
  connect(header_, &CompareHeader::swapAsked, this, &ComparePanel::swap);
  connect(header_, &CompareHeader::alignmentChosen, this, &ComparePanel::setAlignment);
  connect(header_, &CompareHeader::offsetTyped, this, &ComparePanel::setOffset);
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
  connect(chart_, &CompareChart::sought, this, [this](double seconds) {
    const TimeSpan all = chart_->whole();
    emit sought(std::clamp(seconds, all.fromS, all.toS));
  });
  connect(signal_, &QComboBox::activated, this, [this](int index) {
    emit signalChosen(kAllPlottedSignals[static_cast<std::size_t>(index)]);
  });
  connect(matrix_, &QComboBox::activated, this, [this] { ask(); });
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
  // The recording that was A goes on as B, where B became A.
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
  if (a_ != beforeA || b_ != beforeB) pairChanged();
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
  emit openAsked();
}

std::optional<TimeSpan> ComparePanel::common() const {
  if (!answer_.a || !answer_.b) return std::nullopt;
  return commonSpan(*answer_.a, *answer_.b, answer_.offsetS);
}

void ComparePanel::pairChanged() {
  worker_.giveUp();
  answer_ = {};
  comparison_.reset();
  asked_ = false;
  // An offset by hand is of two recordings: of others it means nothing.
  if (alignment_ == Alignment::kByHand) alignment_ = Alignment::kContact;
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
  matrix_->setCurrentIndex(std::max(0, matrix_->findText(before)));
}

void ComparePanel::setActive(bool on) {
  active_ = on;
  if (!on) return worker_.giveUp();
  if (!answer_.complete) asked_ = false;
  if (!asked_) ask();
  showFrames();
}

void ComparePanel::ask() {
  asked_ = active_ && hasPair();
  if (!asked_) return;
  // Figures of another curve are not to be taken for those of this one.
  answer_.complete = false;
  answer_.figures.reset();
  answer_.done = 0.0;
  showNotice();
  worker_.ask({.a = a_,
               .b = b_,
               .alignment = alignment_,
               .handOffsetS = handOffsetS_,
               .choice = {.kind = SeriesChoice::Kind::kMatrix,
                          .index = matrix_->currentData().toULongLong(),
                          .signal = settings_.signal}});
}

void ComparePanel::take(const CompareAnswer& answer) {
  const bool first = !answer_.a || !answer_.b;
  const auto largest = answer_.largestDifference;
  const double largestValue = answer_.largestValue;
  answer_ = answer;
  if (!answer_.complete && !first && !answer_.largestDifference) {
    // Colours and curves don't flicker while the same two are looked at anew.
    answer_.largestDifference = largest;
    answer_.largestValue = largestValue;
  }
  if (answer_.a && answer_.b) {
    header_->setOffset(answer_.offsetS);
    showCurves();
    if (first) chart_->fit();
  }
  showFrames();
}

std::optional<double> ComparePanel::offsetS() const {
  if (!answer_.a || !answer_.b) return std::nullopt;
  return answer_.offsetS;
}

void ComparePanel::setAlignment(Alignment alignment) {
  if (alignment == Alignment::kByHand) handOffsetS_ = answer_.offsetS;
  alignment_ = alignment;
  header_->setAlignment(alignment);
  if (answer_.a && answer_.b) {
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

// Cheap: it is called for every movement of the mouse. Figures follow once it stands.
void ComparePanel::moveTo(double offsetS, bool keepSeen) {
  if (!answer_.a || !answer_.b) return;
  const bool changed = alignment_ != Alignment::kByHand;
  worker_.giveUp();
  handOffsetS_ = offsetS;
  alignment_ = Alignment::kByHand;
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
  const bool byHand = alignment_ == Alignment::kByHand;
  const double offsetS = -answer_.offsetS;
  emit swapAsked(b_, timeS);
  if (!byHand) return;
  handOffsetS_ = offsetS;
  alignment_ = Alignment::kByHand;
  header_->setAlignment(alignment_);
  ask();
}

void ComparePanel::setTime(double seconds) {
  timeS_ = seconds;
  chart_->setPosition(seconds);
  if (active_) showFrames();
}

void ComparePanel::setSettings(const ViewSettings& settings, Theme theme) {
  const bool otherSignal = settings.signal != settings_.signal;
  const bool otherTheme = theme != theme_;
  settings_ = settings;
  theme_ = theme;
  signal_->setCurrentText(gui::nameOf(settings.signal));
  if (otherTheme || chart_->graphCount() == 0) {
    header_->setTheme(theme);
    chart_->setTheme(theme);
    strip_->setTheme(theme);
  }
  if (otherSignal) {
    asked_ = false;
    ask();
  }
  showFrames();
}

}  // namespace palpate::gui
