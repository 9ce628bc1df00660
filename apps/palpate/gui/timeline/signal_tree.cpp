#include "gui/timeline/signal_tree.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QPushButton>
#include <QScreen>
#include <QTreeWidget>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/appearance/hand_unit.h"
#include "gui/chart/plotted_curve.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

// What the line stands for (SignalTreeKind).
constexpr int kSignalTreeKind = Qt::UserRole;
// Index of the joint or sensor.
constexpr int kIndex = Qt::UserRole + 1;
// Name of a group before it is edited.
constexpr int kName = Qt::UserRole + 2;
constexpr int kMaxNumbers = 64;
enum SignalTreeKind {
  kSection,
  kChosen,
  kGroup,
  kAngle,
  kTemperature,
  kForce,
  kFormulaLine,
  kColumnLine,
  kCalibratedLine
};

QString computedCaption(ComputedKind kind) {
  switch (kind) {
    case ComputedKind::kForce:
      return "force";
    case ComputedKind::kPressure:
      return "pressure";
    case ComputedKind::kCentroid:
      return "centroid of the contact";
    case ComputedKind::kSphere:
      return "sphere around the contacts";
    case ComputedKind::kSlip:
      return "slip";
  }
  return {};
}

std::set<int> numbersIn(const QVariant& value) {
  std::set<int> numbers;
  for (const QString& word : value.toStringList()) {
    bool good = false;
    const int number = word.toInt(&good);
    if (good && number >= 0 && number < kMaxNumbers) numbers.insert(number);
  }
  return numbers;
}

QStringList signalTreeWordsOf(const std::set<int>& numbers) {
  QStringList words;
  for (const int number : numbers) words.append(QString::number(number));
  return words;
}

}  // namespace

PlottedExtras loadPlottedExtras(const QSettings& settings) {
  PlottedExtras extras;
  extras.chosenTaxels = settings.value("plotted/chosen_taxels", true).toBool();
  for (const QString& name : settings.value("plotted/groups").toStringList())
    extras.groups.insert(name);
  for (const QString& name : settings.value("plotted/formulas").toStringList())
    extras.formulas.insert(name);
  for (const QString& name : settings.value("plotted/columns").toStringList())
    extras.columns.insert(name);
  extras.calibrated = settings.value("plotted/calibrated", false).toBool();
  extras.angles = numbersIn(settings.value("plotted/angles"));
  extras.temperatures = numbersIn(settings.value("plotted/temperatures"));
  extras.forces = numbersIn(settings.value("plotted/forces"));
  return extras;
}

void savePlottedExtras(const PlottedExtras& extras, QSettings& settings) {
  settings.setValue("plotted/chosen_taxels", extras.chosenTaxels);
  settings.setValue("plotted/groups", QStringList(extras.groups.begin(), extras.groups.end()));
  settings.setValue("plotted/formulas",
                    QStringList(extras.formulas.begin(), extras.formulas.end()));
  settings.setValue("plotted/columns", QStringList(extras.columns.begin(), extras.columns.end()));
  settings.setValue("plotted/calibrated", extras.calibrated);
  settings.setValue("plotted/angles", signalTreeWordsOf(extras.angles));
  settings.setValue("plotted/temperatures", signalTreeWordsOf(extras.temperatures));
  settings.setValue("plotted/forces", signalTreeWordsOf(extras.forces));
}

SignalTree::SignalTree(TaxelGroups& groups, FormulaCurves& formulas, QWidget* parent)
    : QFrame(parent, Qt::Popup), groups_(groups), formulas_(formulas) {
  setObjectName("SignalTree");
  setFrameShape(QFrame::StyledPanel);
  tree_ = named(new QTreeWidget(this), "signalList", {}, "Curves in the timeline");
  tree_->setHeaderHidden(true);
  tree_->setRootIsDecorated(false);
  tree_->setIndentation(14);
  tree_->setFrameShape(QFrame::NoFrame);
  tree_->setEditTriggers(QAbstractItemView::EditKeyPressed);
  group_ = makeButton(this, "groupButton", "Name the chosen taxels…");
  group_->setToolTip("Keep them as a group, for other recordings too");
  formula_ = makeButton(this, "formulaButton", "New formula or filter…");
  formula_->setToolTip("Add a slope, a difference, a filtered curve, or any formula of signals");
  setLayout(inColumn({{tree_, 1}, group_, formula_}, around(Space::kUsual)));
  connect(formula_, &QPushButton::clicked, this, [this] {
    hide();
    emit formulaRequested({});
  });
  connect(tree_, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item) {
    pressedState_ = item->checkState(0);
    if (item->data(0, kSignalTreeKind).toInt() != kFormulaLine) return;
    toggle(*item);  // back: its first click has ticked it
    hide();
    emit formulaRequested(item->data(0, kName).toString());
  });
  connect(&formulas_, &FormulaCurves::changed, this, &SignalTree::rebuild);
  connect(tree_, &QTreeWidget::itemChanged, this, &SignalTree::onItemChanged);
  // A click anywhere on a line ticks it; a click on the box has ticked it already.
  connect(tree_, &QTreeWidget::itemPressed, this, [this](QTreeWidgetItem* item) {
    if (item) pressedState_ = item->checkState(0);
  });
  connect(tree_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item) {
    // None when a tick has made the list anew.
    if (item && item->checkState(0) == pressedState_) toggle(*item);
  });
  connect(group_, &QPushButton::clicked, this, [this] {
    hide();
    emit groupRequested();
  });
  connect(&groups_, &TaxelGroups::changed, this, &SignalTree::rebuild);
}

void SignalTree::toggle(QTreeWidgetItem& item) {
  if ((item.flags() & Qt::ItemIsUserCheckable) == 0) return;
  item.setCheckState(0, item.checkState(0) == Qt::Checked ? Qt::Unchecked : Qt::Checked);
}

void SignalTree::setSource(const HandDescription& hand, const SignalSource& source) {
  hand_ = hand;
  source_ = source;
  rebuild();
}

void SignalTree::setNumChosen(std::size_t taxels) {
  if (numChosen_ == taxels) return;
  numChosen_ = taxels;
  rebuild();
}

void SignalTree::setUnits(const DisplayUnits& units) {
  if (units_ == units) return;
  units_ = units;
  rebuild();
}

void SignalTree::setExtras(const PlottedExtras& extras) {
  extras_ = extras;
  rebuild();
}

QTreeWidgetItem* SignalTree::section(const QString& title) {
  auto* item = new QTreeWidgetItem(tree_, {title});
  item->setFlags(Qt::ItemIsEnabled);
  item->setData(0, kSignalTreeKind, kSection);
  QFont font = item->font(0);
  font.setBold(true);
  item->setFont(0, font);
  return item;
}

QTreeWidgetItem* SignalTree::addLine(
    QTreeWidgetItem* parent, const QString& text, int kind, int index, bool on) {
  auto* item = new QTreeWidgetItem(parent, {text});
  item->setData(0, kSignalTreeKind, kind);
  item->setData(0, kIndex, index);
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
  item->setCheckState(0, on ? Qt::Checked : Qt::Unchecked);
  return item;
}

// A heading per kind, open where one of its lines is ticked.
void SignalTree::addComputed() {
  if (source_.computed.empty()) return;
  QTreeWidgetItem* computed = section("Computed");
  const auto disable = [](QTreeWidgetItem* item, const std::string& missing) {
    item->setFlags(item->flags() & ~(Qt::ItemIsEnabled | Qt::ItemIsSelectable));
    item->setToolTip(0, QString::fromStdString(missing));
  };
  const std::string& noForces = source_.computed.front().missing;
  QTreeWidgetItem* calibrated =
      addLine(computed, "matrices in kPa and N", kCalibratedLine, 0, extras_.calibrated);
  calibrated->setToolTip(0, "Mean, filtered mean and maximum as pressure, sum as force");
  if (!noForces.empty()) disable(calibrated, noForces);
  QTreeWidgetItem* group = nullptr;
  std::optional<ComputedKind> kind;
  std::vector<QTreeWidgetItem*> closed;
  for (const ComputedSeries& series : source_.computed) {
    if (kind != series.kind) {
      kind = series.kind;
      group = new QTreeWidgetItem(computed, {computedCaption(series.kind)});
      group->setFlags(Qt::ItemIsEnabled);
      group->setData(0, kSignalTreeKind, kSection);
      closed.push_back(group);
    }
    for (std::size_t i = 0; i < series.description.columns.size(); ++i) {
      const QString name = nameOf(series.description, series.description.columns[i]);
      const PlottedCurve curve = computedCurve(hand_, series, i, units_);
      const bool on = extras_.columns.contains(name);
      QTreeWidgetItem* item =
          addLine(group, curve.name + " (" + curve.unit + ")", kColumnLine, 0, on);
      item->setData(0, kName, name);
      if (!series.missing.empty()) disable(item, series.missing);
      if (on) std::erase(closed, group);
    }
  }
  tree_->expandAll();
  for (QTreeWidgetItem* item : closed) item->setExpanded(false);
}

void SignalTree::rebuild() {
  building_ = true;
  tree_->clear();
  const auto line = [this](auto... of) { return addLine(of...); };
  const auto nothing = [](QTreeWidgetItem* parent, const QString& text) {
    auto* item = new QTreeWidgetItem(parent, {text});
    item->setFlags(Qt::NoItemFlags);
    item->setData(0, kSignalTreeKind, kSection);
  };
  QTreeWidgetItem* taxels =
      section("Taxels (mean in " + (hand_.layout ? unitOf(hand_) : QString("counts")) + ")");
  line(taxels,
       numChosen_ == 0 ? QString("the chosen taxels (none now)")
                       : "the chosen taxels (" + QString::number(numChosen_) + ")",
       kChosen,
       0,
       extras_.chosenTaxels);
  if (hand_.layout)
    for (const TaxelGroups::Group& group : groups_.of(*hand_.layout)) {
      auto* item = line(taxels, group.name, kGroup, 0, extras_.groups.contains(group.name));
      item->setData(0, kName, group.name);
      item->setFlags(item->flags() | Qt::ItemIsEditable);
      item->setToolTip(0, "F2 renames it, Del deletes it");
    }
  // Only recordings have them: a filter needs what comes after a sample, too.
  if (!source_.hasForces && !formulas_.all().empty()) {
    QTreeWidgetItem* formulas = section("Formulas and filters");
    for (const FormulaCurve& each : formulas_.all()) {
      auto* item = line(formulas, each.name, kFormulaLine, 0, extras_.formulas.contains(each.name));
      item->setData(0, kName, each.name);
      item->setToolTip(0, each.formula + "\nF2 or a double click changes it, Del deletes it");
    }
  }
  // What the hand lacks is absent; what the recording lacks is said.
  const QString none = source_.hasForces ? "none from this source" : "none in this recording";
  const bool slides = !hand_.axes.empty() &&
                      std::all_of(hand_.axes.begin(),
                                  hand_.axes.end(),
                                  [](const AxisDescription& axis) { return axis.isSliding; });
  QTreeWidgetItem* angles =
      hand_.layout && hand_.axes.empty()
          ? nullptr
          : section(slides ? QString("Joint positions (mm)")
                           : "Joint angles (" + shownUnit(units_.angle).symbol + ")");
  if (angles && !source_.hasAngles) nothing(angles, none);
  for (std::size_t i = 0; angles && source_.hasAngles && i < hand_.axes.size(); ++i)
    line(angles,
         QString::fromStdString(hand_.axes[i].name),
         kAngle,
         static_cast<int>(i),
         extras_.angles.contains(static_cast<int>(i)));
  QTreeWidgetItem* temperatures =
      hand_.layout && hand_.temperatureSensors.empty()
          ? nullptr
          : section("Temperatures (" + shownUnit(units_.temperature).symbol + ")");
  if (temperatures && !source_.hasTemperatures) nothing(temperatures, none);
  for (std::size_t i = 0;
       temperatures && source_.hasTemperatures && i < hand_.temperatureSensors.size();
       ++i)
    line(temperatures,
         QString::fromStdString(hand_.temperatureSensors[i].name),
         kTemperature,
         static_cast<int>(i),
         extras_.temperatures.contains(static_cast<int>(i)));
  for (const SeriesDescription& series : source_.series) {
    QTreeWidgetItem* columns = section("Series " + QString::fromStdString(series.name));
    for (const Column& column : series.columns) {
      const QString name = nameOf(series, column), unit = unitOf(column);
      line(columns,
           unit.isEmpty() ? name : name + " (" + unit + ")",
           kColumnLine,
           0,
           extras_.columns.contains(name))
          ->setData(0, kName, name);
    }
  }
  QTreeWidgetItem* forces = hand_.layout && source_.hasForces ? section("Forces (N)") : nullptr;
  if (forces && !*source_.hasForces) nothing(forces, "need a calibration: Calibrate, Force");
  for (std::size_t i = 0; forces && *source_.hasForces && i <= hand_.layout->numMatrices(); ++i)
    line(
        forces,
        "force on " + (i < hand_.layout->numMatrices() ? QString::fromStdString(hand_.matrixName(i))
                                                       : QString("the whole hand")),
        kForce,
        static_cast<int>(i),
        extras_.forces.contains(static_cast<int>(i)));
  tree_->expandAll();
  addComputed();
  group_->setEnabled(numChosen_ > 0);
  formula_->setEnabled(hand_.layout != nullptr && !source_.hasForces);
  building_ = false;
}

void SignalTree::onItemChanged(QTreeWidgetItem* item) {
  if (building_) return;
  const bool on = item->checkState(0) == Qt::Checked;
  const int index = item->data(0, kIndex).toInt();
  const auto put = [on](auto& set, const auto& value) {
    on ? (void)set.insert(value) : (void)set.erase(value);
  };
  switch (item->data(0, kSignalTreeKind).toInt()) {
    case kChosen:
      extras_.chosenTaxels = on;
      break;
    case kGroup: {
      const QString before = item->data(0, kName).toString();
      if (item->text(0) != before) {
        const QString name = item->text(0).simplified();
        const bool ticked = extras_.groups.contains(before);
        // `item` no longer exists: rename() has rebuilt the list.
        if (groups_.rename(before, name) && ticked) {
          extras_.groups.erase(before);
          extras_.groups.insert(name);
        }
        rebuild();
        break;
      }
      put(extras_.groups, before);
      break;
    }
    case kAngle:
      put(extras_.angles, index);
      break;
    case kTemperature:
      put(extras_.temperatures, index);
      break;
    case kForce:
      put(extras_.forces, index);
      break;
    case kFormulaLine:
      put(extras_.formulas, item->data(0, kName).toString());
      break;
    case kCalibratedLine:
      extras_.calibrated = on;
      break;
    case kColumnLine:
      put(extras_.columns, item->data(0, kName).toString());
      break;
    default:
      return;
  }
  emit extrasChanged();
}

void SignalTree::keyPressEvent(QKeyEvent* event) {
  const QTreeWidgetItem* item = tree_->currentItem();
  if (event->key() == Qt::Key_Delete && item && item->data(0, kSignalTreeKind).toInt() == kGroup) {
    const QString name = item->data(0, kName).toString();
    extras_.groups.erase(name);
    groups_.forget(name);
    emit extrasChanged();
    return;
  }
  if (item && item->data(0, kSignalTreeKind).toInt() == kFormulaLine) {
    const QString name = item->data(0, kName).toString();
    if (event->key() == Qt::Key_Delete) {
      extras_.formulas.erase(name);
      formulas_.forget(name);
      emit extrasChanged();
      return;
    }
    if (event->key() == Qt::Key_F2) {
      hide();
      emit formulaRequested(name);
      return;
    }
  }
  QFrame::keyPressEvent(event);
}

void SignalTree::openBelow(const QWidget& button) {
  constexpr int kWidth = 300, kMaxHeight = 460, kGap = 2;  // [px]
  const QRect screen = button.screen()->availableGeometry();
  const QRect of(button.mapToGlobal(QPoint()), button.size());
  const int below = screen.bottom() - of.bottom() - kGap;
  const int above = of.top() - kGap - screen.top();
  const bool opensBelow = below >= kMaxHeight || below >= above;
  resize(kWidth, std::min(kMaxHeight, opensBelow ? below : above));
  const int left = std::max(screen.left(), screen.right() - width());
  const QPoint at(std::clamp(of.left(), screen.left(), left),
                  opensBelow ? of.bottom() + kGap : of.top() - kGap - height());
  move(at);
  show();
  tree_->setFocus();
  if (!tree_->currentItem()) tree_->setCurrentItem(tree_->topLevelItem(0)->child(0));
}

bool SignalTree::setTicked(const QString& text, bool on) {
  for (QTreeWidgetItem* item : tree_->findItems(text, Qt::MatchStartsWith | Qt::MatchRecursive)) {
    if (!(item->flags() & Qt::ItemIsUserCheckable) || !(item->flags() & Qt::ItemIsEnabled))
      continue;
    item->setCheckState(0, on ? Qt::Checked : Qt::Unchecked);
    return true;
  }
  return false;
}

QStringList SignalTree::lines() const {
  QStringList texts;
  for (const QTreeWidgetItem* item : tree_->findItems("", Qt::MatchContains | Qt::MatchRecursive)) {
    if (item->flags() & Qt::ItemIsUserCheckable)
      texts.append((item->checkState(0) == Qt::Checked ? "[x] " : "[ ] ") + item->text(0));
  }
  return texts;
}

}  // namespace palpate::gui
