// The dialog that makes or changes a curve by a formula: of one or two signals and an operation
// (derivative, difference, filter), which write the formula, or typed. Says in one line what is
// wrong with the formula while it is typed.
#pragma once

#include <QDialog>
#include <QString>
#include <vector>

#include <palpate/model/hand_description.h>
#include <palpate/model/profile.h>

#include "gui/window_state/formula_curves.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace palpate::gui {

// A signal that a formula can be made of.
struct FormulaSignal {
  QString caption;  // "finger 0 distal, mean"
  QString name;     // "m1_mean"
  QString unit;
};
// The signals of a recording's hand and of its further series and, if it is one, the chosen taxel;
// those of the matrices are `signal`.
std::vector<FormulaSignal> formulaSignals(const Profile& profile,
                                          SignalKind signal,
                                          const TaxelSelection& chosen);

class FormulaDialog : public QDialog {
  Q_OBJECT
 public:
  // `profile`: the recording that the formula is tried on. `before`: the curve that is changed;
  // without name: a new one.
  FormulaDialog(std::vector<FormulaSignal> from,
                const Profile& profile,
                const FormulaCurve& before,
                QWidget* parent = nullptr);

  FormulaCurve curve() const;
  // What is wrong now; empty: nothing.
  QString problem() const;

 private:
  // Writes the formula of the chosen signals and operation.
  void write();
  void proposeOther();
  void check();

  std::vector<FormulaSignal> from_;
  Profile profile_;
  QComboBox* of_;
  QComboBox* operation_;
  QComboBox* other_;
  QLineEdit* name_;
  QLineEdit* formula_;
  QLineEdit* unit_;
  QLabel* problem_;
  QPushButton* good_;
  // The name was typed, not made of the choice.
  bool ownName_ = false;
  bool ownUnit_ = false;
};

}  // namespace palpate::gui
