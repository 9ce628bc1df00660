// The file with the settings of the window, made safe to be given to QSettings, and the states of
// widgets in it as plain numbers.
#pragma once

#include <QList>
#include <QSettings>
#include <QString>

class QHeaderView;
class QSplitter;
class QWidget;

namespace palpate::gui {

// Returns the path that QSettings may read: `path` itself. What QSettings can't read safely is
// put out of its way first:
// * lines with values of the form "@Variant(..)", which Qt decodes into objects of any kind and
//   size, are removed; Palpate writes none,
// * what is no regular file (a FIFO would never end), or is larger than 64 MB, is renamed to
//   "NAME.damaged", and the window begins with the defaults.
QString readableSettings(const QString& path);

// The numbers of a list in the settings; empty: there is none, or one of them is no whole number
// from `lowest` to `highest`, or there are not `count` of them.
QList<int> storedNumbers(
    const QSettings& settings, const QString& key, qsizetype count, int lowest, int highest);
void storeNumbers(const QList<int>& numbers, QSettings& settings, const QString& key);

// Sizes of the parts of a splitter [px]; returns whether there were some that make sense.
bool restoreParts(QSplitter& splitter, const QSettings& settings, const QString& key);
// Leaves what is stored while a part is hidden.
void storeParts(const QSplitter& splitter, QSettings& settings, const QString& key);

// Widths, order and sorting of the columns of a table, below `group`.
void restoreColumns(QHeaderView& header, const QSettings& settings, const QString& group);
void storeColumns(const QHeaderView& header, QSettings& settings, const QString& group);

// Place and size of a window on its screen, whether it is maximised or fills the screen.
void restorePlace(QWidget& window, const QSettings& settings, const QString& key);
void storePlace(const QWidget& window, QSettings& settings, const QString& key);

}  // namespace palpate::gui
