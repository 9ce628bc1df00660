// A list with check boxes that chooses which curves the timeline shows in addition to those of the
// matrices: the selected taxels, named groups, formulas, joint angles, temperatures, columns of
// further series, computed ones, forces. It stays open while several are ticked.
#pragma once

#include <QFrame>
#include <QSettings>
#include <QStringList>
#include <optional>
#include <set>
#include <vector>

#include <palpate/computed/computed_series.h>
#include <palpate/model/hand_description.h>

#include "gui/appearance/display_units.h"
#include "gui/timeline/taxel_groups.h"
#include "gui/window_state/formula_curves.h"

class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace palpate::gui {

// The additional curves, stored in the settings.
struct PlottedExtras {
  bool chosenTaxels = true;
  std::set<QString> groups = {};
  std::set<int> angles = {};
  std::set<int> temperatures = {};
  // Forces on matrices; the number of matrices stands for the whole hand.
  std::set<int> forces = {};
  // Names of curves by formulas.
  std::set<QString> formulas = {};
  // Columns of further series by their names: "wrist fz"; of computed ones, too: "m1_force n".
  std::set<QString> columns = {};
  // Whether curves of matrices are in kPa and N where the recording is calibrated.
  bool calibrated = false;
  bool operator==(const PlottedExtras&) const = default;
};
PlottedExtras loadPlottedExtras(const QSettings& settings);
void savePlottedExtras(const PlottedExtras& extras, QSettings& settings);

// Which curves a source has.
struct SignalSource {
  bool hasAngles = false;
  bool hasTemperatures = false;
  // Those beside the series of the hand.
  std::vector<SeriesDescription> series = {};
  // Computed of the frames; those with something missing are shown, but can't be ticked.
  std::vector<ComputedSeries> computed = {};
  // Whether a calibration gives forces; nothing: forces aren't offered.
  std::optional<bool> hasForces = std::nullopt;
};

class SignalTree : public QFrame {
  Q_OBJECT
 public:
  SignalTree(TaxelGroups& groups, FormulaCurves& formulas, QWidget* parent = nullptr);

  // Sets which curves are available.
  void setSource(const HandDescription& hand, const SignalSource& source);
  void setNumChosen(std::size_t taxels);
  // The units that the titles name.
  void setUnits(const DisplayUnits& units);
  void setExtras(const PlottedExtras& extras);
  const PlottedExtras& extras() const noexcept { return extras_; }
  // Opens the list below a widget, or above it where there is more room, and gives it the keyboard
  // focus. It scrolls where the screen is too low.
  void openBelow(const QWidget& button);
  // Ticks a line by its text, for tests and keys; false: no such line.
  bool setTicked(const QString& text, bool on);
  QStringList lines() const;

 signals:
  void extrasChanged();
  // The user asks to make a group of the selected taxels.
  void groupRequested();
  // The user asks to change the curve of that name; empty: to make a new one.
  void formulaRequested(const QString& name);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void rebuild();
  QTreeWidgetItem* section(const QString& title);
  void addComputed();
  QTreeWidgetItem* addLine(
      QTreeWidgetItem* parent, const QString& text, int kind, int index, bool on);
  static void toggle(QTreeWidgetItem& item);
  void onItemChanged(QTreeWidgetItem* item);

  TaxelGroups& groups_;
  FormulaCurves& formulas_;
  HandDescription hand_;
  SignalSource source_;
  DisplayUnits units_;
  std::size_t numChosen_ = 0;
  PlottedExtras extras_;
  bool building_ = false;
  Qt::CheckState pressedState_ = Qt::Unchecked;  // of the line that was pressed last, at that time
  QTreeWidget* tree_;
  QPushButton* group_;
  QPushButton* formula_;
};

}  // namespace palpate::gui
