// The table of the dock Inspect: one row per matrix and one for the whole hand, with the signals of
// the current frame, recorded or live; a tick plots the row in the timeline.
#pragma once

#include <QAbstractTableModel>
#include <QTableView>
#include <array>
#include <vector>

#include <palpate/model/hand_description.h>

#include "gui/appearance/display_units.h"
#include "gui/appearance/theme.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

class MatrixTableModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { kName, kActive, kMean, kMaximum, kForce, kMinimum, kSum, kArea, kNumColumns };

  using QAbstractTableModel::QAbstractTableModel;

  // Null: the table is empty.
  void setRecording(const OpenedRecordingPtr& recording);
  // Shows a live hand: all matrices are plotted; values follow by showSignals().
  void setHand(const HandDescription& hand);
  // The same hand scans other taxels: the plotted rows stay.
  void renewHand(const HandDescription& hand);
  void showFrame(std::size_t frame);
  // One entry per matrix, the whole hand last; any other number of entries is ignored.
  void showSignals(const std::vector<CharacteristicSignals>& rows);
  // Force of one row [N].
  struct Force {
    double newtons = 0.0;
    double sd = 0.0;
    bool inRange = true;
    bool areaKnown = true;  // false: an upper limit
    bool operator==(const Force&) const = default;
  };
  // One entry per matrix, the whole hand last; empty: no calibration is applied. `why`: tells that
  // in the tool tip.
  void showForces(const std::vector<Force>& forces, const QString& why);
  // Greys the values when they are stale.
  void setStale(bool old);
  std::size_t numMatrices() const noexcept { return shown_.empty() ? 0 : shown_.size() - 1; }
  const HandDescription& hand() const noexcept { return hand_; }
  // The unit of areas.
  void setUnits(const DisplayUnits& units);
  // Which rows are plotted; the last one is the whole hand.
  const std::vector<bool>& plotted() const noexcept { return plotted_; }
  void setPlotted(std::size_t row, bool on);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 signals:
  void plottedChanged();

 private:
  QString text(std::size_t row, int column) const;
  QString forceText(std::size_t row) const;

  void showRow(std::size_t row, const CharacteristicSignals& now);

  OpenedRecordingPtr recording_;
  HandDescription hand_;
  // Of values, for this hand.
  int decimals_ = 0;
  ShownUnit area_ = shownUnit(AreaUnit{});
  // Signals of the current frame, the whole hand last.
  std::vector<CharacteristicSignals> shown_;
  // In the order of shown_, or empty.
  std::vector<Force> forces_;
  QString forceTip_;
  std::vector<bool> plotted_;
  bool stale_ = false;
};

class TickDelegate;

// The view of the table, as high as its rows.
class MatrixTable : public QTableView {
  Q_OBJECT
 public:
  explicit MatrixTable(MatrixTableModel* model, QWidget* parent = nullptr);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  // Hides the last columns when there is no room for all.
  void resizeEvent(QResizeEvent* event) override;

 private:
  int nameWidth() const;
  // As wide as their headings and figures, in the present size of text.
  void fitColumns();
  void growColumns();
  void hideColumns(int width);
  std::array<int, MatrixTableModel::kNumColumns> columnSizes_{};  // [px]
  TickDelegate* ticks_;
};

}  // namespace palpate::gui
