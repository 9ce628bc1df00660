// The table of the plan of recordings: object, run, repetitions and notes can be edited; beside
// them, how many takes were made, and what the newest check found.
#pragma once

#include <QAbstractTableModel>

#include "gui/record/plan_controller.h"

namespace palpate::gui {

class PlanModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { kObject, kRun, kRepetitions, kNotes, kDone, kState, kNumColumns };

  // The controller must outlive this object.
  explicit PlanModel(PlanController& controller, QObject* parent = nullptr);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
  // A typed value was refused, and why.
  void refused(const QString& why);

 private:
  void follow();

  PlanController& controller_;
  int numRows_ = 0;
};

}  // namespace palpate::gui
