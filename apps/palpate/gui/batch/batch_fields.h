// The fields of the Batch dialog for what is made of each recording; only those that have an effect
// are seen.
#pragma once

#include <QFormLayout>
#include <QWidget>
#include <functional>

#include "gui/batch/batch_choices.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLineEdit;
class QSpinBox;

namespace palpate::gui {

class BatchFields : public QWidget {
  Q_OBJECT
 public:
  explicit BatchFields(QWidget* parent = nullptr);
  void fill(const BatchChoices& choices);
  // Puts what the fields show into `choices`.
  void readInto(BatchChoices& choices) const;

  // The text of the filters that the window applies; empty: none.
  std::function<QString()> windowFilters;

 signals:
  void edited();

 private:
  QWidget* makeFilters();
  QWidget* makeLimits();
  void showFields();

  QFormLayout* form_;
  QComboBox* work_;
  QComboBox* ending_;
  QComboBox* table_;
  QComboBox* picture_;
  QComboBox* map_;
  QDoubleSpinBox* speed_;
  QWidget* filtersRow_;
  QLineEdit* filters_ = nullptr;
  QLineEdit* smooth_;
  QSpinBox* matrix_;
  QComboBox* method_;
  QComboBox* reference_;
  QWidget* limits_;
  QDoubleSpinBox* step_ = nullptr;
  QDoubleSpinBox* limit_ = nullptr;
  QDoubleSpinBox* rotation_ = nullptr;
  QComboBox* set_;
  QCheckBox* eachGrasp_;
  QCheckBox* interpolated_;
  QCheckBox* values_;
  QCheckBox* segments_;
  QCheckBox* signals_;
  QCheckBox* slip_;
  QCheckBox* unitsRow_;
};

}  // namespace palpate::gui
