// The table of the Import dialog in which the user says which columns become what: a row for all
// matrices, one per matrix, joint angles, temperatures.
#pragma once

#include <QTableWidget>

#include <palpate/imports/import_mapping.h>
#include <palpate/model/hand_description.h>

namespace palpate::gui {

class ImportFields : public QTableWidget {
  Q_OBJECT
 public:
  explicit ImportFields(QWidget* parent = nullptr);
  // Offers the rows of a hand; what stands in rows that remain is kept.
  void setHand(const HandDescription& hand);
  void setMapping(const ImportMapping& mapping);
  // Puts what stands in the table into a mapping.
  void readInto(ImportMapping& mapping) const;
  // A cell that is no number, in one line; empty: all are.
  QString problem() const;

 signals:
  void edited();

 private:
  void fill();
  QString cellText(int row, int column) const;

  HandDescription hand_;
  ImportMapping mapping_;
};

}  // namespace palpate::gui
