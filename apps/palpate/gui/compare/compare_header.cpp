#include "gui/compare/compare_header.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QResizeEvent>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/appearance/difference_map.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kCompareHeaderControlHeight = 26;  // [px]
constexpr int kCompareHeaderCompactBelow = 760;  // [px] of width; narrower: buttons without text
constexpr double kFurthestS = 1e9;               // [s], 30 years: limit of the offset
constexpr double kOffsetStepS = 0.05;            // [s], of the arrow keys
constexpr int kOffsetDecimals = 3;

}  // namespace

QString titleOf(Alignment alignment) {
  switch (alignment) {
    case Alignment::kStart:
      return "start of both";
    case Alignment::kClock:
      return "clock time";
    case Alignment::kGrasp:
      return "grasps";
    case Alignment::kManual:
      return "by hand";
    case Alignment::kContact:
      break;
  }
  return "first contact";
}

QComboBox* CompareHeader::recordingBox(const char* name, const QString& tip, QLabel*& swatch) {
  auto* box = new QComboBox(this);
  box->setObjectName(name);
  box->setToolTip(tip);
  box->setAccessibleName(tip);
  box->setMinimumHeight(kCompareHeaderControlHeight);
  box->setMinimumContentsLength(10);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  box->setMaximumWidth(380);
  box->setFocusPolicy(Qt::TabFocus);
  swatch = new QLabel(this);
  return box;
}

CompareHeader::CompareHeader(QAction* leave,
                             QAction* interpolated,
                             QAction* values,
                             QWidget* parent)
    : QWidget(parent) {
  setObjectName("ViewHeader");
  setAttribute(Qt::WA_StyledBackground);
  a_ = recordingBox("compareA", "Recording A: it is played", swatchA_);
  b_ = recordingBox("compareB", "Recording B: it is compared with A", swatchB_);
  swap_ = new QToolButton(this);
  swap_->setObjectName("compareSwap");
  swap_->setText("⇄");
  swap_->setToolTip("Swap A and B");
  swap_->setAccessibleName("Swap A and B");
  swap_->setFocusPolicy(Qt::TabFocus);
  alignment_ = new QComboBox(this);
  alignment_->setObjectName("compareAlignment");
  alignment_->setMinimumHeight(kCompareHeaderControlHeight);
  alignment_->setToolTip("How B is aligned with A");
  alignment_->setAccessibleName("Alignment");
  alignment_->setFocusPolicy(Qt::TabFocus);
  for (const Alignment each : kAllAlignments) alignment_->addItem(titleOf(each));
  grasps_ = new QWidget(this);
  const auto graspBox = [this](const char* name, const QString& tip) {
    auto* box = new QComboBox(grasps_);
    box->setObjectName(name);
    box->setToolTip(tip);
    box->setAccessibleName(tip);
    box->setMinimumHeight(kCompareHeaderControlHeight);
    box->setFocusPolicy(Qt::TabFocus);
    connect(box, &QComboBox::activated, this, [this] {
      emit graspsChosen(static_cast<std::size_t>(std::max(0, graspA_->currentIndex())),
                        static_cast<std::size_t>(std::max(0, graspB_->currentIndex())));
    });
    return box;
  };
  graspA_ = graspBox("compareGraspA", "The grasp of A that begins where the one of B begins");
  graspB_ = graspBox("compareGraspB", "The grasp of B that begins where the one of A begins");
  auto* graspRow = new QHBoxLayout(grasps_);
  graspRow->setContentsMargins(0, 0, 0, 0);
  graspRow->setSpacing(6);
  graspRow->addWidget(new QLabel("of A", grasps_));
  graspRow->addWidget(graspA_);
  graspRow->addWidget(new QLabel("of B", grasps_));
  graspRow->addWidget(graspB_);
  grasps_->hide();
  offset_ = new QDoubleSpinBox(this);
  offset_->setObjectName("compareOffset");
  offset_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  offset_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  offset_->setDecimals(kOffsetDecimals);
  offset_->setRange(-kFurthestS, kFurthestS);
  offset_->setSingleStep(kOffsetStepS);
  offset_->setSuffix(" s");
  offset_->setKeyboardTracking(false);
  fitToText(*offset_, [offset = offset_] {
    offset->setFixedWidth(offset->fontMetrics().horizontalAdvance("-00000000.000 s") + 16);
  });
  offset_->setFocusPolicy(Qt::StrongFocus);
  offset_->setToolTip("When B begins, in seconds from A's first frame (or drag B's bar)");
  offset_->setAccessibleName("Offset of B in seconds");

  const auto button = [this](QAction* action) {
    auto* made = new QToolButton(this);
    made->setDefaultAction(action);
    made->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    made->setFocusPolicy(Qt::TabFocus);
    return made;
  };
  withText_ = {button(interpolated), button(values)};
  auto* back = new QToolButton(this);
  back->setObjectName("compareBack");
  back->setText("Back to the matrices");
  back->setToolTip("Back to the matrices (" + leave->shortcut().toString(QKeySequence::NativeText) +
                   ", Esc)");
  back->setFocusPolicy(Qt::TabFocus);
  connect(back, &QToolButton::clicked, leave, &QAction::trigger);

  auto* first = new QHBoxLayout;
  first->setSpacing(6);
  auto* title = new QLabel("<b>Compare</b>", this);
  first->addWidget(title);
  first->addSpacing(10);
  first->addWidget(swatchA_);
  first->addWidget(a_, 1);
  first->addWidget(swap_);
  first->addWidget(swatchB_);
  first->addWidget(b_, 1);
  first->addStretch(0);
  first->addSpacing(6);
  first->addWidget(back);
  auto* second = new QHBoxLayout;
  second->setSpacing(6);
  second->addWidget(new QLabel("Aligned by", this));
  second->addWidget(alignment_);
  second->addWidget(grasps_);
  second->addSpacing(8);
  second->addWidget(new QLabel("B begins at", this));
  second->addWidget(offset_);
  second->addStretch(1);
  for (QToolButton* each : withText_) second->addWidget(each);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(12, 4, 10, 5);
  rows->setSpacing(4);
  rows->addLayout(first);
  rows->addLayout(second);

  connect(a_, &QComboBox::activated, this, [this](int index) { choose(a_, index, true); });
  connect(b_, &QComboBox::activated, this, [this](int index) { choose(b_, index, false); });
  connect(swap_, &QToolButton::clicked, this, &CompareHeader::swapRequested);
  connect(alignment_, &QComboBox::activated, this, [this](int index) {
    emit alignmentChosen(kAllAlignments[static_cast<std::size_t>(index)]);
  });
  connect(offset_, &QDoubleSpinBox::valueChanged, this, &CompareHeader::offsetTyped);
  setOffset(std::nullopt);
  swatchA_->setText("A");
  swatchB_->setText("B");
  fitToTheme(*this, [this] {
    for (const auto& [label, side] :
         {std::pair(swatchA_, CompareSide::kA), {swatchB_, CompareSide::kB}})
      label->setStyleSheet("font-weight: bold; padding: 2px 7px; border-radius: 4px; color: " +
                           colorsOf().window.name() + "; background: " + sideColor(side).name());
  });
}

void CompareHeader::choose(QComboBox* box, int index, bool isA) {
  if (index == box->count() - 1) {
    box->setCurrentIndex(isA ? chosenA_ : chosenB_);
    emit openRequested();
  } else if (isA) {
    emit aChosen(index);
  } else {
    emit bChosen(index);
  }
}

void CompareHeader::setRecordings(const QStringList& names, int a, int b) {
  chosenA_ = a;
  chosenB_ = b;
  for (QComboBox* box : {a_, b_}) {
    box->clear();
    box->addItems(names);
    box->insertSeparator(box->count());
    box->addItem("open another…");
    box->setCurrentIndex(box == a_ ? a : b);
  }
  const bool both = a >= 0 && b >= 0;
  swap_->setEnabled(both && a != b);
  alignment_->setEnabled(both);
}

void CompareHeader::setAlignment(Alignment alignment) {
  alignment_->setCurrentIndex(static_cast<int>(
      std::find(kAllAlignments.begin(), kAllAlignments.end(), alignment) - kAllAlignments.begin()));
  grasps_->setVisible(alignment == Alignment::kGrasp);
}

void CompareHeader::setGrasps(std::size_t countA,
                              std::size_t countB,
                              std::size_t chosenA,
                              std::size_t chosenB) {
  const auto fill = [](QComboBox* box, std::size_t count, std::size_t chosen) {
    if (box->count() != static_cast<int>(count)) {
      box->clear();
      for (std::size_t i = 1; i <= count; ++i) box->addItem("grasp " + QString::number(i));
    }
    box->setEnabled(count > 0);
    box->setCurrentIndex(count == 0 ? -1 : static_cast<int>(std::min(chosen, count - 1)));
  };
  fill(graspA_, countA, chosenA);
  fill(graspB_, countB, chosenB);
}

void CompareHeader::setOffset(std::optional<double> offsetS) {
  const QSignalBlocker blocked(offset_);
  offset_->setEnabled(offsetS.has_value());
  offset_->setValue(offsetS.value_or(0.0));
}

void CompareHeader::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const bool narrow = event->size().width() < kCompareHeaderCompactBelow;
  for (QToolButton* each : withText_)
    each->setToolButtonStyle(narrow ? Qt::ToolButtonIconOnly : Qt::ToolButtonTextBesideIcon);
}

}  // namespace palpate::gui
