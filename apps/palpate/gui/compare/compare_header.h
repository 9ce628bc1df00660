// The controls of a comparison: which recordings are A and B, and how they are aligned in time.
#pragma once

#include <QList>
#include <QString>
#include <QWidget>

#include <palpate/signals/alignment.h>

#include "gui/appearance/theme.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QToolButton;

namespace palpate::gui {

class CompareHeader : public QWidget {
  Q_OBJECT
 public:
  // Each action gets a button; `leave` goes back to the matrices.
  CompareHeader(QAction* leave, QAction* interpolated, QAction* values, QWidget* parent = nullptr);

  // Fills both boxes; `a` and `b` are indices into `names`, -1 for none. The last entry of both
  // boxes opens another recording.
  void setRecordings(const QStringList& names, int a, int b);
  void setAlignment(Alignment alignment);
  // Time from A's first frame to B's first frame [s]; the field is empty when it is unknown.
  void setOffset(std::optional<double> offsetS);
  // Which grasp of A is aligned with which of B, and how many each has (0: none); shown only for
  // Alignment::kGrasp.
  void setGrasps(std::size_t countA, std::size_t countB, std::size_t chosenA, std::size_t chosenB);

 signals:
  void aChosen(int index);
  void bChosen(int index);
  void openRequested();
  void swapRequested();
  void alignmentChosen(palpate::Alignment alignment);
  void offsetTyped(double offsetS);
  // Indices of the chosen grasps.
  void graspsChosen(std::size_t ofA, std::size_t ofB);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QComboBox* recordingBox(const char* name, const QString& tip, QLabel*& swatch);
  void choose(QComboBox* box, int index, bool isA);

  QComboBox* a_;
  QComboBox* b_;
  QLabel* swatchA_;
  QLabel* swatchB_;
  QToolButton* swap_;
  QComboBox* alignment_;
  // The choice of two grasps.
  QWidget* grasps_;
  QComboBox* graspA_;
  QComboBox* graspB_;
  QDoubleSpinBox* offset_;
  QList<QToolButton*> withText_;
  int chosenA_ = -1;
  int chosenB_ = -1;
};

// The name of an alignment: "first contact", "start of both", "clock time", "grasps", "by hand"
QString titleOf(Alignment alignment);

}  // namespace palpate::gui
