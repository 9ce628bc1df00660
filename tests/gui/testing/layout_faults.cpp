#include "gui/testing/layout_faults.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QRubberBand>
#include <QScrollBar>
#include <QSpinBox>
#include <QStyleOptionComboBox>
#include <QStyleOptionHeader>
#include <QTabBar>
#include <QTableView>
#include <QTextDocument>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>

namespace palpate::gui {
namespace {

// Rounding of font sizes and style sheets [px].
constexpr int kSlack = 1;

QString describe(const QWidget& widget) {
  QString text;
  if (const auto* label = qobject_cast<const QLabel*>(&widget)) text = label->text();
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) text = button->text();
  if (const auto* box = qobject_cast<const QComboBox*>(&widget)) text = box->currentText();
  if (const auto* field = qobject_cast<const QLineEdit*>(&widget)) text = field->text();
  if (const auto* tabs = qobject_cast<const QTabBar*>(&widget))
    for (int i = 0; i < tabs->count(); ++i) text += tabs->tabText(i) + "|";
  const QString name = widget.objectName().isEmpty() && widget.parentWidget()
                           ? widget.parentWidget()->objectName() + "/"
                           : widget.objectName();
  return QString("%1 %2 '%3' %4x%5")
      .arg(widget.metaObject()->className(), name, text.left(40))
      .arg(widget.width())
      .arg(widget.height());
}

QString wanted(const QWidget& widget, const QString& what, QSize size) {
  return QString("%1: %2 needs %3x%4")
      .arg(describe(widget), what)
      .arg(size.width())
      .arg(size.height());
}

// The part of `widget` that can be seen or scrolled to, in coordinates of `window`; empty if it is
// scrolled out of sight.
struct Clip {
  bool inSight = true;
  QStringList faults;
};

Clip clipOf(const QWidget& widget, const QWidget& window) {
  Clip clip;
  QRect rect = widget.rect();
  const QWidget* at = &widget;
  while (at != &window && at->parentWidget()) {
    rect.translate(at->pos());
    const QWidget* around = at->parentWidget();
    const QRect room = around->rect();
    const auto* area = qobject_cast<const QAbstractScrollArea*>(around->parentWidget());
    if (area && area->viewport() == around) {
      const bool across = area->horizontalScrollBar()->maximum() > 0 &&
                          area->horizontalScrollBarPolicy() != Qt::ScrollBarAlwaysOff;
      const bool along = area->verticalScrollBar()->maximum() > 0 &&
                         area->verticalScrollBarPolicy() != Qt::ScrollBarAlwaysOff;
      if (!along && (rect.top() < room.top() - kSlack || rect.bottom() > room.bottom() + kSlack))
        clip.faults.append(describe(widget) + ": cut above or below by " + describe(*around));
      if (!across && (rect.left() < room.left() - kSlack || rect.right() > room.right() + kSlack))
        clip.faults.append(describe(widget) + ": cut at the side by " + describe(*around));
      rect &= room;
      if (rect.isEmpty()) {
        clip.inSight = false;
        return clip;
      }
    } else if (!room.adjusted(-kSlack, -kSlack, kSlack, kSlack).contains(rect)) {
      clip.faults.append(QString("%1: lies at %2,%3 %4x%5, outside %6")
                             .arg(describe(widget))
                             .arg(rect.x())
                             .arg(rect.y())
                             .arg(rect.width())
                             .arg(rect.height())
                             .arg(describe(*around)));
      return clip;
    }
    at = around;
  }
  return clip;
}

void checkLabel(const QLabel& label, QStringList& faults) {
  if (label.text().isEmpty()) return;
  const QSize hint = label.sizeHint();
  if (!label.wordWrap()) {
    const QSize least = label.minimumSizeHint().expandedTo(
        label.inherits("palpate::gui::ElidedText") ? QSize() : hint);
    if (label.width() + kSlack < least.width() || label.height() + kSlack < least.height())
      faults.append(wanted(label, "the text", least));
    return;
  }
  const int height = label.heightForWidth(label.width());
  if (label.height() + kSlack < height && label.toolTip() != label.text())
    faults.append(wanted(label, "the wrapped text", {label.width(), height}));
  // No word is broken.
  QTextDocument plain;
  if (Qt::mightBeRichText(label.text()) && label.textFormat() != Qt::PlainText)
    plain.setHtml(label.text());
  else
    plain.setPlainText(label.text());
  const int margins = label.width() - label.contentsRect().width();
  for (const QString& word :
       plain.toPlainText().split(QRegularExpression("\\s+"), Qt::SkipEmptyParts)) {
    const int needed = label.fontMetrics().horizontalAdvance(word) + margins;
    // Paths have no spaces, and may break.
    if (needed > label.width() + kSlack && !word.contains('/'))
      faults.append(wanted(label, "the word '" + word + "'", {needed, label.height()}));
  }
}

void checkCombo(const QComboBox& box, QStringList& faults) {
  if (box.isEditable()) return;
  QStyleOptionComboBox option;
  option.initFrom(&box);
  option.editable = false;
  option.frame = true;
  const int room =
      box.style()
          ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box)
          .width();
  // Names of files are shortened; the list shows them in full.
  int widest = box.fontMetrics().horizontalAdvance(box.currentText());
  if (box.sizeAdjustPolicy() == QComboBox::AdjustToMinimumContentsLengthWithIcon ||
      box.inherits("palpate::gui::ElidingBox"))
    return;
  if (!box.itemIcon(box.currentIndex()).isNull()) widest += box.iconSize().width() + 4;
  if (widest > room + kSlack)
    faults.append(
        wanted(box, "'" + box.currentText() + "'", {box.width() + widest - room, box.height()}));
}

void checkTable(const QTableView& table, QStringList& faults) {
  const auto* header = table.horizontalHeader();
  if (!table.model()) return;
  for (int column = 0; column < table.model()->columnCount(); ++column) {
    if (header->isSectionHidden(column)) continue;
    const QString title = table.model()->headerData(column, Qt::Horizontal).toString();
    const int width = header->sectionSize(column);
    constexpr int kPadding = 4;
    if (header->isVisible() && !title.isEmpty() &&
        header->fontMetrics().horizontalAdvance(title) + kPadding > width + kSlack)
      faults.append(QString("%1: heading '%2' has %3 px").arg(describe(table), title).arg(width));
    for (int row = 0; row < std::min(table.model()->rowCount(), 40); ++row) {
      const QModelIndex index = table.model()->index(row, column);
      const QString text = index.data().toString();
      if (text.isEmpty() || text.contains(QRegularExpression("[./ ][^ ]*[a-z]{4}"))) continue;
      if (table.isRowHidden(row)) continue;
      const QStringList lines = text.split('\n');
      for (const QString& line : lines)
        if (table.fontMetrics().horizontalAdvance(line) + 2 > width + kSlack &&
            index.data(Qt::ToolTipRole).toString().isEmpty())
          faults.append(QString("%1: cell '%2' of '%3' has %4 px")
                            .arg(describe(table), line, title)
                            .arg(width));
    }
  }
  if (table.horizontalScrollBarPolicy() == Qt::ScrollBarAlwaysOff &&
      header->length() > table.viewport()->width() + kSlack)
    faults.append(QString("%1: its columns need %2 px").arg(describe(table)).arg(header->length()));
}

void checkTabs(const QTabBar& tabs, QStringList& faults) {
  for (int i = 0; i < tabs.count(); ++i) {
    if (!tabs.isTabVisible(i)) continue;
    const QRect rect = tabs.tabRect(i);
    if (!tabs.rect().adjusted(-kSlack, -kSlack, kSlack, kSlack).contains(rect) ||
        tabs.fontMetrics().horizontalAdvance(tabs.tabText(i)) > rect.width())
      faults.append(QString("%1: tab '%2' at %3, %4 px wide")
                        .arg(describe(tabs), tabs.tabText(i))
                        .arg(rect.x())
                        .arg(rect.width()));
  }
}

void checkContent(const QWidget& widget, QStringList& faults) {
  if (const auto* label = qobject_cast<const QLabel*>(&widget)) return checkLabel(*label, faults);
  if (const auto* box = qobject_cast<const QComboBox*>(&widget)) return checkCombo(*box, faults);
  if (const auto* tabs = qobject_cast<const QTabBar*>(&widget)) return checkTabs(*tabs, faults);
  if (const auto* table = qobject_cast<const QTableView*>(&widget))
    return checkTable(*table, faults);
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) {
    const QSize hint = button->sizeHint();
    if (!button->text().isEmpty() &&
        (button->width() + kSlack < hint.width() || button->height() + 2 * kSlack < hint.height()))
      faults.append(wanted(widget, "the button", hint));
    return;
  }
  if (const auto* spin = qobject_cast<const QAbstractSpinBox*>(&widget)) {
    const auto* field = spin->findChild<const QLineEdit*>();
    const int room = field->width();
    // Qt shortens a placeholder that has no room beside its margins.
    const bool empty = field->text().isEmpty();
    const QString text = empty ? field->placeholderText() : spin->text();
    const int needed = field->fontMetrics().horizontalAdvance(text) + (empty ? 4 : 2);
    if (needed > room + (empty ? 0 : kSlack))
      faults.append(
          wanted(widget, "'" + text + "'", {spin->width() + needed - room, spin->height()}));
    return;
  }
  if (const auto* field = qobject_cast<const QLineEdit*>(&widget)) {
    const QString text = field->text().isEmpty() ? field->placeholderText() : field->text();
    const int needed = field->fontMetrics().horizontalAdvance(text) + 8;
    if (field->text().isEmpty() && needed > field->width() + kSlack)
      faults.append(wanted(widget, "'" + text + "'", {needed, field->height()}));
    return;
  }
}

// Widgets that lie over others on purpose.
bool isOverlay(const QWidget& widget) {
  return widget.isWindow() || widget.testAttribute(Qt::WA_TransparentForMouseEvents) ||
         qobject_cast<const QRubberBand*>(&widget) || widget.inherits("QFocusFrame") ||
         widget.inherits("QSizeGrip") || widget.inherits("QSplitterHandle") ||
         widget.objectName() == "qt_qmainwindow_extended_splitter";
}

// Whether `widget` is (in) a dock behind another tab: Qt moves it out of the window.
bool isBehindATab(const QWidget& widget, const QWidget& window) {
  // So does it with a bar that has one tab only.
  if (qobject_cast<const QTabBar*>(&widget) && widget.parentWidget() == &window)
    return !widget.geometry().intersects(window.rect());
  const QWidget* dock = &widget;
  while (dock && dock != &window && !qobject_cast<const QDockWidget*>(dock))
    dock = dock->parentWidget();
  return dock && dock != &window && !dock->geometry().intersects(window.rect());
}

void checkOverlaps(const QWidget& around, QStringList& faults) {
  // Parts of a spin box, a combo box and a scroll area are placed by the style.
  if (qobject_cast<const QAbstractScrollArea*>(&around) ||
      qobject_cast<const QAbstractSpinBox*>(&around) || qobject_cast<const QComboBox*>(&around) ||
      qobject_cast<const QLineEdit*>(&around) || qobject_cast<const QTabBar*>(&around) ||
      around.inherits("QComboBoxPrivateContainer"))
    return;
  const auto* area = qobject_cast<const QAbstractScrollArea*>(around.parentWidget());
  if (area && qobject_cast<const QAbstractItemView*>(area)) return;
  QList<const QWidget*> parts;
  for (const QObject* child : around.children())
    if (const auto* part = qobject_cast<const QWidget*>(child))
      if (part->isVisible() && !isOverlay(*part) && !part->size().isEmpty() &&
          part->geometry().intersects(around.rect()))
        parts.append(part);
  for (qsizetype i = 0; i < parts.size(); ++i)
    for (qsizetype j = i + 1; j < parts.size(); ++j) {
      const QRect common = parts[i]->geometry() & parts[j]->geometry();
      if (common.width() > kSlack && common.height() > kSlack)
        faults.append(QString("%1 overlaps %2 by %3x%4")
                          .arg(describe(*parts[i]), describe(*parts[j]))
                          .arg(common.width())
                          .arg(common.height()));
    }
}

}  // namespace

QStringList layoutFaults(const QWidget& window) {
  QStringList faults;
  const QSize least = window.minimumSizeHint();
  if (least.width() > window.width() || least.height() > window.height())
    faults.append(wanted(window, "the content", least));
  checkOverlaps(window, faults);
  for (const QWidget* widget : window.findChildren<QWidget*>()) {
    if (!widget->isVisible() || widget->window() != &window || isOverlay(*widget) ||
        isBehindATab(*widget, window))
      continue;
    if (widget->objectName() == "qt_toolbar_ext_button") {
      faults.append("the tool bar hides buttons behind its button >>");
      continue;
    }
    const QWidget* parent = widget->parentWidget();
    if (qobject_cast<const QAbstractItemView*>(parent) || qobject_cast<const QComboBox*>(parent) ||
        qobject_cast<const QAbstractSpinBox*>(parent) || qobject_cast<const QTabBar*>(parent) ||
        qobject_cast<const QScrollBar*>(widget))
      continue;
    if (parent && parent->parentWidget() &&
        qobject_cast<const QAbstractItemView*>(parent->parentWidget()))
      continue;
    const Clip clip = clipOf(*widget, window);
    if (!clip.inSight) continue;
    faults.append(clip.faults);
    checkContent(*widget, faults);
    checkOverlaps(*widget, faults);
  }
  faults.removeDuplicates();
  return faults;
}

}  // namespace palpate::gui
