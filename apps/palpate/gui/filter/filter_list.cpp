#include "gui/filter/filter_list.h"

#include <QApplication>
#include <QDropEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPainter>
#include <QSignalBlocker>

#include "gui/appearance/captions.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

enum FilterListColumn { kName, kCost, kLatency };

QString filterListOptionsOf(const FilterStep& step) {
  const QString text = QString::fromStdString(shownFilterText(step));
  const auto colon = text.indexOf(':');
  return colon < 0 ? QString() : text.mid(colon + 1).replace(',', "  ").replace('=', ' ');
}

}  // namespace

FilterList::FilterList(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("filterList");
  setAccessibleName("Chain of filters");
  setHeaderLabels({"Filter", "µs/frame", "delay"});
  headerItem()->setToolTip(kCost, "Time that a frame of all matrices takes");
  headerItem()->setToolTip(kLatency, "Frames until a load step has reached half its height");
  for (const FilterListColumn column : {kCost, kLatency})
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setDragDropMode(InternalMove);
  setDefaultDropAction(Qt::MoveAction);
  setSelectionMode(SingleSelection);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(kName, QHeaderView::Stretch);
  header()->setSectionResizeMode(kCost, QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kLatency, QHeaderView::ResizeToContents);
  header()->setSectionsMovable(false);
  fitToTheme(*this, [this] {
    for (int i = 0; i < topLevelItemCount(); ++i)
      if (topLevelItem(i)->data(kName, Qt::ForegroundRole).isValid())
        topLevelItem(i)->setForeground(kName,
                                       QApplication::palette().brush(QPalette::PlaceholderText));
  });
  connect(this, &QTreeWidget::currentItemChanged, this, [this] {
    if (!filling_) emit stepChosen();
  });
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (filling_ || column != kName) return;
    emit enabledChanged(static_cast<std::size_t>(indexOfTopLevelItem(item)),
                        item->checkState(kName) == Qt::Checked);
  });
}

void FilterList::showRecipe(const Recipe& recipe, bool live) {
  filling_ = true;
  const auto before = chosen();
  while (topLevelItemCount() > static_cast<int>(recipe.steps.size()))
    delete takeTopLevelItem(topLevelItemCount() - 1);
  while (topLevelItemCount() < static_cast<int>(recipe.steps.size())) {
    auto* item = new QTreeWidgetItem(this);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled |
                   Qt::ItemIsUserCheckable);
    for (const FilterListColumn column : {kCost, kLatency})
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  for (std::size_t i = 0; i < recipe.steps.size(); ++i) {
    const FilterStep& step = recipe.steps[i];
    QTreeWidgetItem* item = topLevelItem(static_cast<int>(i));
    const bool leftOut = live && !step.causal();
    QString text = QString::fromStdString(step.kind().title);
    if (const QString options = filterListOptionsOf(step); !options.isEmpty())
      text += "   " + options;
    item->setText(kName, text);
    item->setCheckState(kName, step.enabled ? Qt::Checked : Qt::Unchecked);
    item->setToolTip(kName,
                     !leftOut ? QString::fromStdString(step.kind().purpose)
                     : step.name == "baseline"
                         ? QString("Takes its baseline from a recording: left out while a hand is "
                                   "live; Baseline (Ctrl+Alt+L) takes it from the last second")
                         : QString("Needs later frames: left out while a hand is live"));
    const bool faint = leftOut || !step.enabled;
    item->setData(kName,
                  Qt::ForegroundRole,
                  faint ? QApplication::palette().brush(QPalette::PlaceholderText) : QVariant());
  }
  if (before && *before < recipe.steps.size()) choose(before);
  filling_ = false;
}

void FilterList::showFigures(const std::optional<FilterFigures>& figures) {
  filling_ = true;
  for (int i = 0; i < topLevelItemCount(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    QTreeWidgetItem* item = topLevelItem(i);
    const bool on = item->checkState(kName) == Qt::Checked;
    const bool known = figures && index < figures->costsUs.size();
    item->setText(kCost,
                  !on ? QString("–")
                  : known && figures->costsUs[index] > 0.0
                      ? figure(figures->costsUs[index], figures->costsUs[index] < 10.0 ? 1 : 0)
                      : QString("…"));
    const bool delayKnown = figures && index < figures->latencies.size();
    item->setText(kLatency,
                  !on                         ? QString("–")
                  : !delayKnown               ? QString("…")
                  : figures->latencies[index] ? QString::number(*figures->latencies[index])
                                              : QString("never"));
  }
  filling_ = false;
}

std::optional<std::size_t> FilterList::chosen() const {
  const int index = indexOfTopLevelItem(currentItem());
  return index < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(index));
}

void FilterList::choose(std::optional<std::size_t> index) {
  setCurrentItem(index ? topLevelItem(static_cast<int>(*index)) : nullptr);
}

// Only emits the move; the list is filled again when the recipe has changed.
void FilterList::dropEvent(QDropEvent* event) {
  const auto from = chosen();
  const QPoint at = event->position().toPoint();
  QTreeWidgetItem* under = itemAt(at);
  event->setDropAction(Qt::IgnoreAction);
  event->accept();
  if (event->source() != this || !from) return;
  auto to = static_cast<std::size_t>(topLevelItemCount() - 1);
  if (under != nullptr) {
    to = static_cast<std::size_t>(indexOfTopLevelItem(under));
    const QRect row = visualItemRect(under);
    const bool below = at.y() > row.center().y();
    if (to > *from && !below) --to;
    if (to < *from && below) ++to;
  }
  if (to == *from) return;
  emit moved(*from, to);
  choose(to);
  emit stepChosen();
}

void FilterList::keyPressEvent(QKeyEvent* event) {
  const auto at = chosen();
  if (at && (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace)) {
    emit removeRequested(*at);
    return;
  }
  const int way = event->key() == Qt::Key_Up ? -1 : event->key() == Qt::Key_Down ? 1 : 0;
  if (at && way != 0 && event->modifiers().testFlag(Qt::AltModifier)) {
    const int to = static_cast<int>(*at) + way;
    if (to < 0 || to >= topLevelItemCount()) return;
    emit moved(*at, static_cast<std::size_t>(to));
    choose(static_cast<std::size_t>(to));
    emit stepChosen();
    return;
  }
  QTreeWidget::keyPressEvent(event);
}

void FilterList::paintEvent(QPaintEvent* event) {
  QTreeWidget::paintEvent(event);
  if (topLevelItemCount() > 0) return;
  QPainter painter(viewport());
  painter.setPen(palette().color(QPalette::PlaceholderText));
  painter.drawText(viewport()->rect().adjusted(16, 8, -16, -8),
                   Qt::AlignCenter | Qt::TextWordWrap,
                   "No filter yet. Add one, or choose a recipe.");
}

}  // namespace palpate::gui
