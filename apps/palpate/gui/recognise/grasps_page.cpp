#include "gui/recognise/grasps_page.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QSplitter>
#include <QStackedWidget>
#include <algorithm>

#include "gui/appearance/captions.h"
#include "gui/appearance/settings_file.h"
#include "gui/recognise/feature_scatter.h"
#include "gui/recognise/grasp_table_model.h"
#include "gui/widgets/empty_page.h"
#include "gui/widgets/keep_keys.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr const char* kGraspsAxisXKey = "recognise/scatterX";
constexpr const char* kGraspsAxisYKey = "recognise/scatterY";
constexpr const char* kGraspsPartsKey = "recognise/graspsParts";
constexpr int kMaxGraspColumn = 170;  // [px]

}  // namespace

GraspsPage::GraspsPage(TrainingController& controller, QSettings& settings, QWidget* parent)
    : QWidget(parent), controller_(controller), settings_(settings) {
  setObjectName("graspsPage");
  model_ = new GraspTableModel(this);
  sorted_ = new QSortFilterProxyModel(this);
  sorted_->setSourceModel(model_);
  sorted_->setSortRole(GraspTableModel::kSortRole);
  sorted_->setSortCaseSensitivity(Qt::CaseInsensitive);
  empty_ = new EmptyPage("grasps", this);
  pages_ = new QStackedWidget(this);
  parts_ = named(new QSplitter(Qt::Vertical, this), "graspsParts");
  parts_->setChildrenCollapsible(false);
  parts_->addWidget(makeTable());
  parts_->addWidget(makePlot());
  parts_->setStretchFactor(0, 1);
  parts_->setStretchFactor(1, 1);
  restoreParts(*parts_, settings, kGraspsPartsKey);
  pages_->addWidget(empty_);
  pages_->addWidget(parts_);
  setLayout(inColumn({pages_}, kPageEdges));
  connect(parts_, &QSplitter::splitterMoved, this, [this] {
    storeParts(*parts_, settings_, kGraspsPartsKey);
  });
  connect(model_, &GraspTableModel::leavingOutAsked, this, [this](int row, bool out) {
    controller_.setLeftOut({static_cast<std::size_t>(row)}, out);
  });
  connect(view_, &QTableView::doubleClicked, this, [this](const QModelIndex& index) {
    openRow(sorted_->mapToSource(index).row());
  });
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    scatter_->choose(chosenRow());
    showState();
  });
  connect(scatter_, &FeatureScatter::rowChosen, this, &GraspsPage::choose);
  for (QComboBox* box : {x_, y_}) connect(box, &QComboBox::activated, this, &GraspsPage::setAxes);
  connect(leave_, &QPushButton::clicked, this, &GraspsPage::leaveOutChosen);
  connect(undo_, &QPushButton::clicked, &controller_, &TrainingController::undoLeavingOut);
  connect(copy_, &QPushButton::clicked, this, &GraspsPage::copy);
  connect(&controller_, &TrainingController::folderChanged, this, &GraspsPage::showTable);
  connect(&controller_, &TrainingController::leftOutChanged, this, &GraspsPage::showLeftOut);
  showTable();
}

QWidget* GraspsPage::makeTable() {
  auto* part = new QWidget(parts_);
  view_ = named(new RowsTable(part), "graspsTable", {}, "Grasps of the training folder");
  view_->setModel(sorted_);
  view_->setSortingEnabled(true);
  view_->sortByColumn(-1, Qt::AscendingOrder);
  keepKeys(*view_,
           {Qt::Key_Left, Qt::Key_Right, Qt::SHIFT | Qt::Key_Left, Qt::SHIFT | Qt::Key_Right});
  keepKeys(*view_, QKeySequence::Copy, [this] { copy(); });
  keepKeys(*view_, {Qt::Key_Return, Qt::Key_Enter}, [this] { openRow(chosenRow()); });
  keepKeys(*view_, {Qt::Key_Space}, [this] {
    if (leave_->isEnabled()) leaveOutChosen();
  });
  // Not those of the recording's events.
  keepKeys(*this, QKeySequence::Undo, [this] { controller_.undoLeavingOut(); });
  keepKeys(*this, QKeySequence::Redo, [this] { controller_.redoLeavingOut(); });
  leave_ = makeButton(
      part,
      "graspsLeaveOut",
      "Leave out",
      "Leave the chosen grasps out of training and testing; their recordings stay as they are");
  undo_ = makeButton(part,
                     "graspsUndo",
                     "Undo",
                     "Undo the last change of what is left out (Ctrl+Z; redo: Ctrl+Shift+Z)");
  copy_ = makeButton(
      part, "graspsCopy", "Copy", "Copy the chosen rows, or all, for a spreadsheet (Ctrl+C)");
  state_ = makeLines(part, "graspsState", "muted");
  part->setLayout(inColumn({{view_, 1}, inRow({{state_, 1}, leave_, undo_, copy_})},
                           {.bottom = Space::kNarrow}));
  return part;
}

QWidget* GraspsPage::makePlot() {
  auto* part = new QWidget(parts_);
  const auto field = [part](const char* name, const char* accessible) {
    auto* box = named(new QComboBox(part), name, accessible, accessible);
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(12);
    return box;
  };
  x_ = field("scatterX", "Feature along x");
  y_ = field("scatterY", "Feature along y");
  scatter_ = new FeatureScatter(part);
  part->setLayout(
      inColumn({inRow({"x", {x_, 1}, "y", {y_, 1}}), {scatter_, 1}}, {.top = Space::kNarrow}));
  return part;
}

std::vector<bool> GraspsPage::leftOut() const {
  std::vector<bool> out;
  if (const auto& table = controller_.table())
    for (const FeatureRow& row : table->rows) out.push_back(controller_.isLeftOut(row));
  return out;
}

void GraspsPage::showTable() {
  const auto& table = controller_.table();
  if (!table || table->rows.empty()) {
    empty_->say(controller_.folder().empty()
                    ? "Choose a folder of grasps on the page Teach: they are listed here."
                : controller_.busy()              ? "The recordings of the folder are being read."
                : controller_.problem().isEmpty() ? "The folder has no grasps yet."
                                                  : controller_.problem());
    pages_->setCurrentWidget(empty_);
    model_->setTable(nullptr, {});
    scatter_->setTable(nullptr, {});
    return;
  }
  pages_->setCurrentWidget(parts_);
  if (table == model_->table()) return showState();
  model_->setTable(table, leftOut());
  scatter_->setTable(table, leftOut());
  fillAxes();
  view_->resizeColumnsToContents();
  QHeaderView* header = view_->horizontalHeader();
  for (int column = 0; column < model_->columnCount(); ++column)
    header->resizeSection(
        column,
        std::clamp(std::max(header->sectionSizeHint(column), header->sectionSize(column)),
                   40,
                   kMaxGraspColumn));
  showState();
}

void GraspsPage::showLeftOut() {
  if (model_->table() != controller_.table()) return;
  model_->setLeftOut(leftOut());
  scatter_->setLeftOut(leftOut());
  showState();
}

void GraspsPage::fillAxes() {
  const FeatureTable& table = *controller_.table();
  const auto fill = [&](QComboBox* box, const char* key, int usual) {
    box->clear();
    for (const std::string& name : table.names) box->addItem(featureLabel(table.set, name));
    for (int i = 0; i < box->count(); ++i) box->setItemData(i, box->itemText(i), Qt::ToolTipRole);
    const int last = box->findText(settings_.value(key).toString());
    box->setCurrentIndex(last >= 0 ? last : std::min(usual, box->count() - 1));
  };
  fill(x_, kGraspsAxisXKey, 0);
  fill(y_, kGraspsAxisYKey, 1);
  scatter_->setAxes(static_cast<std::size_t>(x_->currentIndex()),
                    static_cast<std::size_t>(y_->currentIndex()));
}

void GraspsPage::setAxes() {
  settings_.setValue(kGraspsAxisXKey, x_->currentText());
  settings_.setValue(kGraspsAxisYKey, y_->currentText());
  scatter_->setAxes(static_cast<std::size_t>(x_->currentIndex()),
                    static_cast<std::size_t>(y_->currentIndex()));
}

int GraspsPage::chosenRow() const {
  const QModelIndexList rows = view_->selectionModel()->selectedRows();
  return rows.isEmpty() ? -1 : sorted_->mapToSource(rows.front()).row();
}

// Not by QTableView::selectRow(), which obeys the keys that are held: with Shift, and nothing
// chosen before, it chooses nothing.
void GraspsPage::choose(int row) {
  const QModelIndex index = sorted_->mapFromSource(model_->index(row, 0));
  view_->selectionModel()->setCurrentIndex(
      index, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  view_->scrollTo(index);
}

std::vector<int> GraspsPage::shownRows() const {
  std::vector<int> rows;
  for (int row = 0; row < sorted_->rowCount(); ++row)
    rows.push_back(sorted_->mapToSource(sorted_->index(row, 0)).row());
  return rows;
}

void GraspsPage::showState() {
  const auto& table = model_->table();
  if (!table) return;
  const std::vector<bool> out = leftOut();
  const auto numOut = std::count(out.begin(), out.end(), true);
  state_->setText(numberOf(table->rows.size(), "grasp") +
                  (numOut > 0 ? ", " + QString::number(numOut) + " left out" : QString()));
  const QModelIndexList rows = view_->selectionModel()->selectedRows();
  const bool allOut =
      !rows.isEmpty() && std::all_of(rows.begin(), rows.end(), [this](const QModelIndex& row) {
        return model_->isLeftOut(sorted_->mapToSource(row).row());
      });
  leave_->setEnabled(!rows.isEmpty());
  leave_->setText(allOut ? "Take in" : "Leave out");
  undo_->setEnabled(controller_.canUndoLeavingOut());
}

void GraspsPage::leaveOutChosen() {
  const QModelIndexList rows = view_->selectionModel()->selectedRows();
  const bool out = leave_->text() == "Leave out";
  std::vector<std::size_t> chosen;
  for (const QModelIndex& row : rows)
    chosen.push_back(static_cast<std::size_t>(sorted_->mapToSource(row).row()));
  controller_.setLeftOut(chosen, out);
}

void GraspsPage::openRow(int row) {
  if (!model_->table() || row < 0) return;
  const FeatureRow& grasp = model_->table()->rows.at(static_cast<std::size_t>(row));
  emit graspAsked(grasp.file, grasp.begin, grasp.end);
}

void GraspsPage::copy() const {
  std::vector<int> rows;
  for (const QModelIndex& row : view_->chosenOrAllRows())
    rows.push_back(sorted_->mapToSource(row).row());
  const TextTable text = graspTextTable(model_->table(), leftOut(), rows);
  QApplication::clipboard()->setText(QString::fromStdString(tabbedText(text, text.numRows)));
}

bool GraspsPage::shown() const { return isVisible() && pages_->currentWidget() == parts_; }

std::vector<ExportedTable> GraspsPage::tables() const {
  if (!shown()) return {};
  return {{"grasps", [table = model_->table(), out = leftOut(), rows = shownRows()] {
             return graspTextTable(table, out, rows);
           }}};
}

void GraspsPage::paint(QPainter& painter, const PictureLook& look) {
  scatter_->paintPicture(painter, look);
}

}  // namespace palpate::gui
