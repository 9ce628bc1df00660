// The controls of a comparison: what is A, what is B, how they are aligned.
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
  // The actions are behind buttons: `leave` goes back to the matrices.
  CompareHeader(QAction* leave, QAction* interpolated, QAction* values, QWidget* parent = nullptr);

  // -1: none. Behind the recordings both boxes offer to open another one.
  void setRecordings(const QStringList& names, int a, int b);
  void setAlignment(Alignment alignment);
  // Seconds from A's first frame to B's. Unknown: empty.
  void setOffset(std::optional<double> offsetS);
  void setTheme(Theme theme);

 signals:
  void aChosen(int index);
  void bChosen(int index);
  void openRequested();
  void swapRequested();
  void alignmentChosen(palpate::Alignment alignment);
  void offsetTyped(double offsetS);

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
  QDoubleSpinBox* offset_;
  QList<QToolButton*> withText_;
  int chosenA_ = -1;
  int chosenB_ = -1;
};

// "first contact", "start of both", "clock time", "by hand"
QString titleOf(Alignment alignment);

}  // namespace palpate::gui
