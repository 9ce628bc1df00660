#include "gui/inspect/matrix_table.h"

#include <QHeaderView>
#include <QItemDelegate>
#include <QPainter>
#include <QResizeEvent>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/appearance/hand_unit.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

// The last column that is always visible.
constexpr int kLastAlways = MatrixTableModel::kMaximum;
// The first column with a number.
constexpr int kFirstNumber = 1;
// With more matrices the table scrolls.
constexpr int kMatrixTableMostRowsSeen = 13;
constexpr int kMatrixTablePadding = 14;  // [px]

bool sameText(const CharacteristicSignals& a, const CharacteristicSignals& b) {
  return a.active == b.active && a.sum == b.sum && a.maximum == b.maximum && a.minimum == b.minimum;
}

QString forceNumber(const MatrixTableModel::Force& force, int decimals) {
  const bool isLimit = !force.areaKnown && force.newtons > 0.0;
  return (isLimit ? "≤ " : "") + figure(force.newtons, decimals);
}

}  // namespace

// Draws check boxes in the colours of the theme, so that an empty box is visible, too.
class TickDelegate : public QItemDelegate {
 public:
  using QItemDelegate::QItemDelegate;

 protected:
  void drawCheck(QPainter* painter,
                 const QStyleOptionViewItem& /*option*/,
                 const QRect& rect,
                 Qt::CheckState state) const override {
    if (!rect.isValid()) return;
    const ThemeColors& colors = colorsOf();
    constexpr double kSide = 13.0;
    QRectF box(0, 0, kSide, kSide);
    box.moveCenter(QRectF(rect).center());
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(QPen(state == Qt::Checked ? colors.accent : colors.muted, 1.0));
    painter->setBrush(state == Qt::Checked ? colors.accentSoft : colors.window);
    painter->drawRoundedRect(box, 2.5, 2.5);
    if (state == Qt::Checked) {
      painter->setPen(QPen(colors.accent, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter->setBrush(Qt::NoBrush);
      const QPointF corner = box.topLeft();
      painter->drawPolyline(QPolygonF(
          {corner + QPointF(3.2, 6.8), corner + QPointF(5.6, 9.4), corner + QPointF(9.9, 3.9)}));
    }
    painter->restore();
  }
  void drawFocus(QPainter*, const QStyleOptionViewItem&, const QRect&) const override {}

 private:
};

void MatrixTableModel::setRecording(const OpenedRecordingPtr& recording) {
  beginResetModel();
  stale_ = false;
  recording_ = recording;
  shown_.clear();
  plotted_.clear();
  forces_.clear();
  if (recording_) {
    hand_ = recording_->profile.hand();
    decimals_ = decimalsOf(hand_);
    shown_.resize(recording_->numMatrices() + 1);
    // Matrices that were never touched aren't plotted, nor is the sum of all until the user asks
    // for it.
    plotted_ = recording_->touched;
    plotted_.push_back(false);
  }
  endResetModel();
  emit plottedChanged();
}

void MatrixTableModel::setHand(const HandDescription& hand) {
  beginResetModel();
  recording_.reset();
  hand_ = hand;
  decimals_ = decimalsOf(hand);
  shown_.assign(hand.layout->numMatrices() + 1, {});
  forces_.clear();
  plotted_.assign(hand.layout->numMatrices(), true);
  plotted_.push_back(false);
  endResetModel();
  emit plottedChanged();
}

void MatrixTableModel::renewHand(const HandDescription& hand) {
  if (recording_ || hand.layout->numMatrices() != numMatrices()) return setHand(hand);
  hand_ = hand;
  decimals_ = decimalsOf(hand);
  emit dataChanged(index(0, 0), index(rowCount() - 1, kNumColumns - 1));
}

void MatrixTableModel::showRow(std::size_t row, const CharacteristicSignals& now) {
  if (sameText(now, shown_[row])) return;
  shown_[row] = now;
  const int at = static_cast<int>(row);
  emit dataChanged(index(at, kActive), index(at, kArea), {Qt::DisplayRole});
}

void MatrixTableModel::showFrame(std::size_t frame) {
  if (!recording_ || frame >= recording_->profile.numFrames()) return;
  for (std::size_t row = 0; row < shown_.size(); ++row) showRow(row, recording_->at(frame, row));
}

void MatrixTableModel::showSignals(const std::vector<CharacteristicSignals>& rows) {
  if (rows.size() != shown_.size()) return;
  for (std::size_t row = 0; row < shown_.size(); ++row) showRow(row, rows[row]);
}

void MatrixTableModel::showForces(const std::vector<Force>& forces, const QString& why) {
  const auto& fitting = forces.size() == shown_.size() ? forces : std::vector<Force>();
  if (fitting == forces_ && why == forceTip_) return;
  forces_ = fitting;
  forceTip_ = why;
  if (rowCount() > 0) emit dataChanged(index(0, kForce), index(rowCount() - 1, kForce));
}

void MatrixTableModel::setStale(bool old) {
  if (old == stale_) return;
  stale_ = old;
  if (rowCount() > 0)
    emit dataChanged(index(0, kActive), index(rowCount() - 1, kArea), {Qt::ForegroundRole});
}

void MatrixTableModel::setUnits(const DisplayUnits& units) {
  area_ = shownUnit(units.area);
  emit headerDataChanged(Qt::Horizontal, kArea, kArea);
  if (rowCount() > 0)
    emit dataChanged(index(0, kArea), index(rowCount() - 1, kArea), {Qt::DisplayRole});
}

void MatrixTableModel::setPlotted(std::size_t row, bool on) {
  if (row >= plotted_.size() || plotted_[row] == on) return;
  plotted_[row] = on;
  const QModelIndex at = index(static_cast<int>(row), kName);
  emit dataChanged(at, at, {Qt::CheckStateRole});
  emit plottedChanged();
}

int MatrixTableModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(shown_.size());
}

int MatrixTableModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : kNumColumns;
}

QString MatrixTableModel::text(std::size_t row, int column) const {
  const CharacteristicSignals& now = shown_[row];
  const bool whole = row + 1 == shown_.size();
  switch (column) {
    case kName: {
      if (whole) return "all";
      return QString::fromStdString(hand_.matrices[row].shortName);
    }
    case kActive:
      return QString::number(now.active);
    case kMean:
      return now.active == 0 ? "–" : QString::number(now.mean, 'f', decimals_);
    case kMaximum:
      return now.active == 0 ? "–" : QString::number(now.maximum, 'f', decimals_);
    case kForce:
      return row < forces_.size() ? forceNumber(forces_[row], 2) : QString("–");
    case kMinimum:
      return now.active == 0 ? "–" : QString::number(now.minimum, 'f', decimals_);
    case kSum:
      return QString::number(now.sum, 'f', decimals_);
    case kArea:
      return area_.number(now.areaMm2, 0);
    default:
      return {};
  }
}

QString MatrixTableModel::forceText(std::size_t row) const {
  if (row >= forces_.size()) return forceTip_;
  constexpr double kQuantile = 1.96;
  const Force& force = forces_[row];
  return forceNumber(force, 3) + " ± " + figure(kQuantile * force.sd, 3) + " N (95 %)" +
         (force.inRange ? "" : "\noutside the calibrated range") +
         (force.areaKnown ? "" : "\nupper limit: the area of the indenter is not known");
}

QVariant MatrixTableModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const auto row = static_cast<std::size_t>(index.row());
  const bool whole = row + 1 == shown_.size();
  switch (role) {
    case Qt::DisplayRole:
      return text(row, index.column());
    case Qt::TextAlignmentRole:
      return QVariant::fromValue(Qt::Alignment(index.column() == kName
                                                   ? Qt::AlignLeft | Qt::AlignVCenter
                                                   : Qt::AlignRight | Qt::AlignVCenter));
    case Qt::CheckStateRole:
      if (index.column() == kName) return plotted_[row] ? Qt::Checked : Qt::Unchecked;
      return {};
    case Qt::DecorationRole:
      if (index.column() == kName) return whole ? wholeColor() : matrixColor(row);
      return {};
    case Qt::ForegroundRole:
      if (index.column() == kForce && row < forces_.size() && !forces_[row].inRange && !stale_)
        return colorsOf().warning;
      return (shown_[row].active > 0 && !stale_) || index.column() == kName ? colorsOf().text
                                                                            : colorsOf().muted;
    case Qt::ToolTipRole:
      if (index.column() == kName) return "Ticked rows are plotted in the timeline";
      if (index.column() == kForce) return forceText(row);
      return {};
    default:
      return {};
  }
}

bool MatrixTableModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (role != Qt::CheckStateRole || index.column() != kName) return false;
  setPlotted(static_cast<std::size_t>(index.row()), value.toInt() == Qt::Checked);
  return true;
}

Qt::ItemFlags MatrixTableModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) return {};
  Qt::ItemFlags flags = Qt::ItemIsEnabled;
  if (index.column() == kName) flags |= Qt::ItemIsUserCheckable;
  return flags;
}

QVariant MatrixTableModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::TextAlignmentRole)
    return QVariant::fromValue(Qt::Alignment(section == kName ? Qt::AlignLeft | Qt::AlignVCenter
                                                              : Qt::AlignRight | Qt::AlignVCenter));
  static const char* const names[] = {"matrix", "active", "mean", "max", "N", "min", "sum", "%2"};
  static const char* const tips[] = {"Sensor matrix; tick to plot it in the timeline",
                                     "Taxels with a value above 0",
                                     "Mean of the active taxels in %1",
                                     "Largest value in %1",
                                     "Force in newtons; needs a calibration (Calibrate)",
                                     "Smallest value of the active taxels in %1",
                                     "Sum of all values in %1",
                                     "Area of the active taxels in %2"};
  if (role == Qt::DisplayRole) return QString(names[section]).replace("%2", area_.symbol);
  if (role == Qt::ToolTipRole)
    return QString(tips[section])
        .replace("%1", hand_.layout ? unitOf(hand_) : QString("counts"))
        .replace("%2", area_.symbol);
  return {};
}

MatrixTable::MatrixTable(MatrixTableModel* model, QWidget* parent) : QTableView(parent) {
  setObjectName("matrixTable");
  setModel(model);
  ticks_ = new TickDelegate(this);
  setItemDelegate(ticks_);
  setSelectionMode(QAbstractItemView::NoSelection);
  // The ticks have keys of their own.
  setFocusPolicy(Qt::NoFocus);
  setShowGrid(false);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setIconSize({10, 10});
  verticalHeader()->hide();
  QHeaderView* header = horizontalHeader();
  header->setSectionsClickable(false);
  header->setHighlightSections(false);
  header->setMinimumSectionSize(24);
  header->setSectionResizeMode(QHeaderView::Fixed);
  header->setSectionResizeMode(MatrixTableModel::kName, QHeaderView::Stretch);
  fitToText(*this, [this] { fitColumns(); });
  connect(model, &QAbstractItemModel::modelReset, this, &QWidget::updateGeometry);
  connect(model, &QAbstractItemModel::dataChanged, this, &MatrixTable::growColumns);
}

// No number is elided.
void MatrixTable::growColumns() {
  const int digit = fontMetrics().horizontalAdvance('0');
  bool grown = false;
  for (int column = kFirstNumber; column < MatrixTableModel::kNumColumns; ++column) {
    int& width = columnSizes_[static_cast<std::size_t>(column)];
    const int before = width;
    for (int row = 0; row < model()->rowCount(); ++row) {
      const QString text = model()->index(row, column).data().toString();
      // Most have room, which needs no measuring.
      if (kMatrixTablePadding + digit * text.size() <= width) continue;
      width = std::max(width, kMatrixTablePadding + fontMetrics().horizontalAdvance(text));
    }
    if (width == before) continue;
    horizontalHeader()->resizeSection(column, width);
    grown = true;
  }
  if (!grown) return;
  hideColumns(this->width());
  updateGeometry();
}

void MatrixTable::fitColumns() {
  verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
  const int digit = fontMetrics().horizontalAdvance('0');
  for (int column = kFirstNumber; column < MatrixTableModel::kNumColumns; ++column) {
    const int digits = column == MatrixTableModel::kSum ? 6 : 4;
    const QString name = model()->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    int& width = columnSizes_[static_cast<std::size_t>(column)];
    width = std::max(digits * digit, horizontalHeader()->fontMetrics().horizontalAdvance(name)) +
            kMatrixTablePadding;
    horizontalHeader()->resizeSection(column, width);
  }
  growColumns();
  hideColumns(width());
  updateGeometry();
}

QSize MatrixTable::sizeHint() const {
  const int rows = std::min(model()->rowCount(), kMatrixTableMostRowsSeen);
  return {
      360,
      horizontalHeader()->sizeHint().height() + 2 + rows * verticalHeader()->defaultSectionSize()};
}

int MatrixTable::nameWidth() const {
  constexpr int kTickAndSquare = 46;
  return fontMetrics().horizontalAdvance("2 proximal") + kTickAndSquare;
}

QSize MatrixTable::minimumSizeHint() const {
  int width = nameWidth();
  for (int column = kFirstNumber; column <= kLastAlways; ++column)
    width += columnSizes_[static_cast<std::size_t>(column)];
  return {width, sizeHint().height()};
}

void MatrixTable::hideColumns(int width) {
  int left = width - nameWidth();
  for (int column = kFirstNumber; column < MatrixTableModel::kNumColumns; ++column) {
    left -= columnSizes_[static_cast<std::size_t>(column)];
    setColumnHidden(column, left < 0 && column > kLastAlways);
  }
}

void MatrixTable::resizeEvent(QResizeEvent* event) {
  hideColumns(event->size().width());
  QTableView::resizeEvent(event);
}

}  // namespace palpate::gui
