// Which curves the timeline shows beside those of the matrices: the chosen taxels, named groups,
// joint angles, temperatures. A list with ticks that stays open while several are ticked.
#pragma once

#include <QFrame>
#include <QSettings>
#include <QStringList>
#include <set>
#include <vector>

#include <palpate/model/hand_description.h>

#include "gui/timeline/taxel_groups.h"

class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace palpate::gui {

// Remembered from day to day.
struct PlottedExtras {
  bool chosenTaxels = true;
  std::set<QString> groups;
  std::set<int> angles;
  std::set<int> temperatures;
  bool operator==(const PlottedExtras&) const = default;
};
PlottedExtras loadPlottedExtras(const QSettings& settings);
void savePlottedExtras(const PlottedExtras& extras, QSettings& settings);

class SignalTree : public QFrame {
  Q_OBJECT
 public:
  explicit SignalTree(TaxelGroups& groups, QWidget* parent = nullptr);

  // What there is to be ticked.
  void setSource(const HandDescription& hand, bool hasAngles, bool hasTemperatures);
  void setNumChosen(std::size_t taxels);
  void setExtras(const PlottedExtras& extras);
  const PlottedExtras& extras() const noexcept { return extras_; }
  // Below a widget, with the keyboard in it.
  void openBelow(const QWidget& button);
  // For tests and keys: ticks a line by its text; false: there is none.
  bool setTicked(const QString& text, bool on);
  QStringList lines() const;

 signals:
  void extrasChanged();
  void groupAsked();  // of the chosen taxels

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void rebuild();
  QTreeWidgetItem* section(const QString& title);
  void onItemChanged(QTreeWidgetItem* item);

  TaxelGroups& groups_;
  HandDescription hand_;
  bool hasAngles_ = false;
  bool hasTemperatures_ = false;
  std::size_t numChosen_ = 0;
  PlottedExtras extras_;
  bool building_ = false;
  QTreeWidget* tree_;
  QPushButton* group_;
};

}  // namespace palpate::gui
