#include "gui/compare/compare_header.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QResizeEvent>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>

#include "gui/appearance/difference_map.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

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
  auto* box = named(new QComboBox(this), name, tip, tip);
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
  a_ = recordingBox("compareA", "Recording A: the one that plays", swatchA_);
  b_ = recordingBox("compareB", "Recording B: compared with A", swatchB_);
  swap_ = makeToolButton(this, "compareSwap", "⇄", "Swap A and B");
  swap_->setAccessibleName("Swap A and B");
  alignment_ =
      named(new QComboBox(this), "compareAlignment", "How B is aligned with A", "Alignment");
  alignment_->setFocusPolicy(Qt::TabFocus);
  for (const Alignment each : kAllAlignments) alignment_->addItem(titleOf(each));
  grasps_ = new QWidget(this);
  const auto graspBox = [this](const char* name, const QString& tip) {
    auto* box = named(new QComboBox(grasps_), name, tip, tip);
    box->setFocusPolicy(Qt::TabFocus);
    connect(box, &QComboBox::activated, this, [this] {
      emit graspsChosen(static_cast<std::size_t>(std::max(0, graspA_->currentIndex())),
                        static_cast<std::size_t>(std::max(0, graspB_->currentIndex())));
    });
    return box;
  };
  graspA_ = graspBox("compareGraspA", "Grasp of A whose start is aligned with that of B");
  graspB_ = graspBox("compareGraspB", "Grasp of B whose start is aligned with that of A");
  grasps_->setLayout(inRow({"of A", graspA_, "of B", graspB_}));
  grasps_->hide();
  offset_ = named(new QDoubleSpinBox(this), "compareOffset");
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

  withText_ = {makeToolButton(this, interpolated), makeToolButton(this, values)};
  auto* back = makeToolButton(this, "compareBack", "Back to the matrices");
  back->setToolTip("Back to the matrices (" + leave->shortcut().toString(QKeySequence::NativeText) +
                   ", Esc)");
  connect(back, &QToolButton::clicked, leave, &QAction::trigger);

  auto* title = new QLabel("<b>Compare</b>", this);
  auto* first = inRow({title,
                       Space::kWide,
                       swatchA_,
                       {a_, 1},
                       swap_,
                       swatchB_,
                       {b_, 1},
                       Stretch{0},
                       Space::kUsual,
                       back});
  auto* second =
      inRow({"Aligned by", alignment_, grasps_, Space::kUsual, "B begins at", offset_, Stretch{}});
  for (QToolButton* each : withText_) second->addWidget(each);
  setLayout(inColumn({first, second}, Space::kNarrow, kBarEdges));

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
