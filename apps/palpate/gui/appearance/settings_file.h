// The file with the settings of the window, made safe to be given to QSettings, and the states of
// widgets in it as plain numbers.
#pragma once

#include <QList>
#include <QSettings>
#include <QString>
#include <memory>

class QHeaderView;
class QSplitter;
class QTemporaryDir;
class QWidget;

namespace palpate::gui {

// A file that QSettings may read.
struct SettingsPlace {
  QString path;
  // What the user must know, one line; empty: nothing.
  QString problem = {};
  // The file is in it, and is removed with it; null: it stays.
  std::shared_ptr<QTemporaryDir> session = {};
};

// Makes the file safe for QSettings:
// * Lines with values of the form "@Variant(..)" and "@DateTime(..)" are removed: Qt decodes them
//   into objects of any kind and size. Palpate writes none; versions before wrote the grasps that
//   were left out of training so, which are kept in their present form.
// * Anything that isn't a regular file (a FIFO would never end), is larger than 64 MB, or can't be
//   made safe, is renamed to "NAME.damaged", "NAME.damaged2", .., and the window begins with the
//   defaults.
// * A file that can't be read or written at the moment is left alone. This session uses settings of
//   its own, which aren't kept.
SettingsPlace readableSettings(const QString& path);

// Key of the grasps of a folder that are left out of training.
QString leftOutKeyOf(const QString& folder);

// The numbers of a list in the settings; empty if there is no list, if it doesn't have `count`
// elements, or if one of them isn't a whole number from `lowest` to `highest`.
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
