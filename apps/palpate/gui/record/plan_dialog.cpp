#include "gui/record/plan_dialog.h"

#include <QAction>
#include <QCheckBox>
#include <QFileInfo>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QResizeEvent>
#include <QScreen>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <QTableView>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <palpate/core/error.h>

#include "gui/appearance/captions.h"
#include "gui/appearance/text_size.h"
#include "gui/record/plan_limits.h"
#include "gui/widgets/dialog_properties.h"
#include "gui/widgets/elided_text.h"
#include "gui/widgets/make.h"
#include "gui/widgets/offer_strip.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr QSize kPlanDialogSize(820, 460);  // [px]
constexpr int kPlanTableBorder = 1;         // [px]
constexpr const char* kPlanTables = "Tables (*.csv);;All files (*)";
constexpr const char* kPlanDialogStyle = R"(
QTableView { background: palette(base); border: 1px solid palette(mid); border-radius: 4px; }
)";

// What is being typed stays, whatever changes elsewhere in the plan meanwhile.
class PlanCells : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void setEditorData(QWidget* editor, const QModelIndex& index) const override {
    const auto* line = qobject_cast<const QLineEdit*>(editor);
    if (!line || !line->isModified()) QStyledItemDelegate::setEditorData(editor, index);
  }
};

}  // namespace

PlanDialog::PlanDialog(WindowState& windowState,
                       PlanController& controller,
                       QAction* record,
                       QWidget* parent)
    : QDialog(parent), windowState_(windowState), controller_(controller), record_(record) {
  setWindowTitle("Plan of recordings");
  setObjectName("planDialog");
  setStyleSheet(kPlanDialogStyle);
  setSizeGripEnabled(true);
  setProperty(kWantsStopProperty, true);
  progress_ = makeLabel(this, "planProgress");
  QFont bold = progress_->font();
  bold.setBold(true);
  progress_->setFont(bold);
  next_ = makeLabel(this, "planNext");
  next_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  bar_ = named(new QProgressBar(this), "planBar");
  bar_->setTextVisible(false);
  bar_->setMaximumWidth(180);
  bar_->setMaximumHeight(10);
  said_ = makeLines(this, "planSaid", "problem");
  question_ = new OfferStrip(this);
  auto* top = inRow({progress_, {next_, 1}, bar_},
                    Space::kWide,
                    {.left = Space::kWide, .top = Space::kWide, .right = Space::kWide});
  setLayout(inColumn({top, question_, {makeRows(), 1}, makeFoot()}, Space::kWide));
  connect(model_, &PlanModel::refused, this, &PlanDialog::say);
  connect(&controller, &PlanController::changed, this, &PlanDialog::showState);
  connect(&controller, &PlanController::imported, this, [this](const QString& problem) {
    say(problem);
    if (!problem.isEmpty() && !isVisible()) windowState_.messages.fail(problem);
  });
  connect(&windowState.live, &LiveController::stateChanged, this, &PlanDialog::showState);
  connect(record, &QAction::changed, this, &PlanDialog::showState);
  connect(table_->selectionModel(),
          &QItemSelectionModel::selectionChanged,
          this,
          &PlanDialog::showState);
  connect(model_, &QAbstractItemModel::modelReset, this, &PlanDialog::showState);
  say({});
  fitToText(*this, [this] {
    fitSize();
    fitColumns();
  });
  showState();
}

// Fields say that they were edited while they are destroyed.
PlanDialog::~PlanDialog() {
  for (QObject* each : findChildren<QObject*>()) each->disconnect(this);
}

QWidget* PlanDialog::makeRows() {
  auto* part = new QWidget(this);
  model_ = new PlanModel(controller_, this);
  table_ = named(new QTableView(part), "planTable", {}, "Plan of recordings");
  table_->setModel(model_);
  table_->setItemDelegate(new PlanCells(table_));
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setTabKeyNavigation(false);
  // Typed letters and digits are keys of the window.
  table_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  table_->setWordWrap(false);
  table_->verticalHeader()->setDefaultAlignment(Qt::AlignCenter);
  QHeaderView* header = table_->horizontalHeader();
  header->setHighlightSections(false);
  header->setSectionResizeMode(QHeaderView::Interactive);
  header->setStretchLastSection(true);
  add_ = makeButton(this, "planAdd", "&Add row", "Add a row below");
  remove_ = makeButton(this, "planRemove", "Re&move row", "Remove the chosen row; its files stay");
  import_ = makeButton(this,
                       "planImport",
                       "&Import…",
                       "Import a table (CSV) with the columns object, run, repetitions, notes");
  export_ = makeButton(this, "planExport", "&Export…", "Export the plan as a table (CSV)");
  anew_ = makeButton(this, "planAnew", "&Start over…", "Make all takes again; files stay");
  connect(add_, &QPushButton::clicked, this, &PlanDialog::addRow);
  connect(remove_, &QPushButton::clicked, this, &PlanDialog::removeRow);
  connect(import_, &QPushButton::clicked, this, &PlanDialog::importTable);
  connect(export_, &QPushButton::clicked, this, &PlanDialog::exportTable);
  connect(anew_, &QPushButton::clicked, this, &PlanDialog::beginAnew);
  limits_ = new PlanLimits(part);
  limits_->fill(controller_.limits());
  connect(limits_, &PlanLimits::edited, this, [this] { controller_.setLimits(limits_->limits()); });
  part->setLayout(inColumn(
      {{table_, 1}, said_, inRow({add_, remove_, import_, export_, anew_, Stretch{}}), limits_},
      {.left = Space::kWide, .right = Space::kWide}));
  return part;
}

QWidget* PlanDialog::makeFoot() {
  follow_ = named(new QCheckBox("&Follow the plan", this),
                  "planFollow",
                  "Record (Ctrl+R) makes the next recording of the plan, without asking");
  connect(follow_, &QCheckBox::toggled, &controller_, &PlanController::setFollowed);
  repeat_ = makeButton(this, "planRepeat", "Re&peat last take");
  connect(repeat_, &QPushButton::clicked, this, &PlanDialog::repeatLast);
  auto* close = makeButton(this, "planClose", "&Close", "The plan is kept");
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  recordNext_ = makePrimary(this, "planRecord", "&Record next", "Record what comes next");
  connect(recordNext_, &QPushButton::clicked, this, &PlanDialog::recordNext);
  return makeDialogFoot(
      inRow({follow_, Stretch{}, close, repeat_, recordNext_}, around(Space::kWide)));
}

// Widths of the columns for text of the present size.
std::array<int, PlanModel::kNumColumns> PlanDialog::wantedWidths() const {
  constexpr std::array kLetters = {18, 12, 0, 22, 8, 22};
  std::array<int, PlanModel::kNumColumns> widths{};
  for (int column = 0; column < PlanModel::kNumColumns; ++column) {
    const auto at = static_cast<std::size_t>(column);
    widths.at(at) = std::max(table_->horizontalHeader()->sectionSizeHint(column),
                             table_->fontMetrics().averageCharWidth() * kLetters.at(at));
  }
  return widths;
}

// What the columns don't get of the width of the window.
int PlanDialog::aroundColumns() const {
  return 2 * (px(Space::kWide) + kPlanTableBorder) + table_->verticalHeader()->sizeHint().width() +
         table_->verticalScrollBar()->sizeHint().width();
}

void PlanDialog::fitSize() {
  const auto widths = wantedWidths();
  const int whole = std::accumulate(widths.begin(), widths.end(), aroundColumns());
  const QSize wanted(std::max(kPlanDialogSize.width(), whole),
                     qRound(textScale() * kPlanDialogSize.height()));
  const QSize room = screen() ? screen()->availableSize() : wanted;
  resize(size().expandedTo(wanted).boundedTo(room.expandedTo(kPlanDialogSize)));
}

// Where the room is too small for all columns, those of free text give some of theirs.
void PlanDialog::fitColumns() {
  QHeaderView* header = table_->horizontalHeader();
  auto widths = wantedWidths();
  const int missing = std::accumulate(widths.begin(), widths.end(), aroundColumns()) - width();
  constexpr std::array kGiving = {PlanModel::kObject, PlanModel::kRun, PlanModel::kNotes};
  const auto spareOf = [&](int column) {
    return std::max(0,
                    widths.at(static_cast<std::size_t>(column)) - header->sectionSizeHint(column));
  };
  int spare = 0;
  for (const int column : kGiving) spare += spareOf(column);
  const double share = spare > 0 ? std::clamp(static_cast<double>(missing) / spare, 0.0, 1.0) : 0.0;
  for (const int column : kGiving)
    widths.at(static_cast<std::size_t>(column)) -=
        static_cast<int>(std::ceil(share * spareOf(column)));
  for (int column = 0; column < PlanModel::kNumColumns; ++column)
    header->resizeSection(column, widths.at(static_cast<std::size_t>(column)));
}

void PlanDialog::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && escape && escape()) return event->accept();
  QDialog::keyPressEvent(event);
}

void PlanDialog::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  layout()->activate();
  if (event->size().width() != event->oldSize().width()) fitColumns();
  // What comes next is shortened to another width.
  showState();
}

void PlanDialog::takeTyped() {
  QWidget* editor = table_->indexWidget(table_->currentIndex());
  if (editor) emit table_->itemDelegate()->commitData(editor);
}

void PlanDialog::say(const QString& text) {
  said_->setText(text);
  said_->setVisible(!text.isEmpty());
}

void PlanDialog::showState() {
  const RecordingPlan& plan = controller_.plan();
  const bool some = !plan.rows().empty();
  progress_->setText(some ? controller_.progressText() : "The plan is empty");
  showElided(next_,
             some ? controller_.nextText() : "add rows, or import a table",
             std::max(120, next_->contentsRect().width()));
  bar_->setMaximum(std::max(1, plan.total()));
  bar_->setValue(plan.numDone());
  follow_->setChecked(controller_.followed());
  // A table that is being read replaces the plan as it is now.
  const bool free = !controller_.importing();
  add_->setEnabled(free);
  import_->setEnabled(free);
  remove_->setEnabled(free && table_->selectionModel()->hasSelection());
  export_->setEnabled(some);
  anew_->setEnabled(free && some &&
                    std::any_of(plan.rows().begin(), plan.rows().end(), [](const auto& row) {
                      return !row.takes.empty();
                    }));
  const auto& last = controller_.lastTake();
  repeat_->setEnabled(last.has_value());
  repeat_->setToolTip((last ? pathText(last->filename()) : QString("The last take")) +
                      " no longer counts, and comes next again");
  const bool on = record_->property(kRecordingProperty).toBool();
  recordNext_->setText(on ? "Stop &recording" : "&Record next");
  recordNext_->setEnabled(record_->isEnabled() && (on || plan.next().has_value()));
  recordNext_->setToolTip(record_->isEnabled() ? "Record what comes next"
                                               : "Connect a hand first (Ctrl+K)");
}

void PlanDialog::addRow() {
  try {
    controller_.addRow({.object = "object"});
  } catch (const Error& error) {
    return say(QString::fromUtf8(error.what()));
  }
  say({});
  const QModelIndex added = model_->index(model_->rowCount() - 1, PlanModel::kObject);
  table_->setCurrentIndex(added);
  table_->edit(added);
}

void PlanDialog::removeRow() {
  const QModelIndexList chosen = table_->selectionModel()->selectedRows();
  if (chosen.isEmpty()) return;
  const int row = chosen.front().row();
  controller_.removeRow(static_cast<std::size_t>(row));
  say({});
  if (model_->rowCount() > 0) table_->selectRow(std::min(row, model_->rowCount() - 1));
}

void PlanDialog::importTable() {
  const QString path =
      windowState_.ask.file("Read a plan", windowState_.recent.lastFolder(), kPlanTables);
  if (path.isEmpty()) return;
  const bool replaces = controller_.plan().numDone() > 0;
  if (replaces &&
      !windowState_.ask.confirmed("The plan with its " + controller_.progressText() +
                                      " takes is replaced by the table; files stay. Replace it?",
                                  "Replace"))
    return;
  say("reading " + QFileInfo(path).fileName() + "…");
  controller_.importCsv(path.toStdString());
}

void PlanDialog::exportTable() {
  const QString path = windowState_.ask.newFile(
      "Save the plan", windowState_.recent.lastFolder() + "/plan.csv", kPlanTables, ".csv");
  if (path.isEmpty()) return;
  try {
    controller_.exportCsv(path.toStdString());
    say({});
    windowState_.messages.flash("saved: " + path);
  } catch (const Error& error) {
    say(QString::fromUtf8(error.what()));
  }
}

void PlanDialog::beginAnew() {
  if (windowState_.ask.confirmed("Make all takes of the plan again? Their files stay.",
                                 "Start over"))
    controller_.beginAnew();
}

void PlanDialog::recordNext() {
  controller_.setFollowed(true);
  record_->trigger();
}

void PlanDialog::repeatLast() {
  if (const auto last = controller_.lastTake()) controller_.reject(*last);
}

}  // namespace palpate::gui
