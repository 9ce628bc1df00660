#include "gui/library/library_panel.h"

#include <QApplication>
#include <QClipboard>
#include <QFileInfo>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "gui/appearance/icons.h"
#include "gui/appearance/settings_file.h"
#include "gui/desktop/ask.h"
#include "gui/desktop/reveal_file.h"
#include "gui/widgets/empty_page.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/keep_keys.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr const char* kLibraryPanelFolderKey = "library/folder";
constexpr const char* kHeaderKey = "library/columns";
constexpr const char* kChooseFolder = "Choose a folder…";
// [ms] time without changes before the folder is scanned again
constexpr int kLibraryPanelCalmMs = 1000;
constexpr qsizetype kMaxWatched = 500;    // folders
constexpr int kLibraryPanelSteps = 1000;  // of the progress bar

QString countText(int count, const QString& what) {
  return QString::number(count) + " " + what + (count == 1 ? "" : "s");
}

// Says which words in front of a colon are no key, and which there are; empty: all are keys.
QString unknownKeysText(const RecordingSearch& search) {
  QStringList unknown, known;
  for (const std::string& key : search.unknownKeys())
    unknown.append("“" + QString::fromStdString(key) + ":”");
  if (unknown.isEmpty()) return {};
  for (const std::string_view key : kSearchKeys)
    known.append(QString::fromUtf8(key.data(), static_cast<qsizetype>(key.size())) + ":");
  return (unknown.size() == 1 ? "Unknown search keyword " : "Unknown search keywords ") +
         unknown.join(" ") + "; there are " + known.join(" ");
}

}  // namespace

LibraryPanel::LibraryPanel(QSettings& settings,
                           Ask& ask,
                           const QString& cacheFolder,
                           LibraryScanner::Catalog catalog,
                           QWidget* parent)
    : QWidget(parent),
      comparable([] { return false; }),
      reveal(revealInFileManager),
      settings_(settings),
      ask_(ask),
      scanner_(cacheFolder, std::move(catalog)),
      model_(new LibraryModel(this)),
      filter_(new LibraryFilter(*model_, this)) {
  setObjectName("LibraryPanel");
  QLayout* top = makeTop();
  pages_ = new FittingPages(this);
  setLayout(inColumn({top, {pages_, 1}}, Space::kNone));
  buildTable();
  buildEmpty();
  buildBottom();
  connectScanner();
  changed_.setSingleShot(true);
  changed_.setInterval(kLibraryPanelCalmMs);
  connect(&changed_, &QTimer::timeout, this, &LibraryPanel::refresh);
  connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, [this] { changed_.start(); });
  setFolder(settings_.value(kLibraryPanelFolderKey).toString());
}

LibraryPanel::~LibraryPanel() { rememberColumns(); }

QLayout* LibraryPanel::makeTop() {
  folderButton_ = named(new QToolButton(this), "libraryFolder");
  folderButton_->setProperty("flat", true);
  folderButton_->setIcon(makeIcon(IconShape::kOpen));
  folderButton_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  folderButton_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  // Paths are shortened, the words that stand there without a folder are not.
  fitToText(*folderButton_, [button = folderButton_] {
    constexpr int kIconAndPadding = 66;  // [px]
    button->setMinimumWidth(button->fontMetrics().horizontalAdvance(kChooseFolder) +
                            kIconAndPadding);
  });
  refreshButton_ = makeToolButton(this, "libraryRefresh", "Refresh", "Read the folder again (F5)");
  refreshButton_->setProperty("flat", true);
  refreshButton_->setShortcut(QKeySequence("F5"));
  search_ = named(new QLineEdit(this), "librarySearch", {}, "Search the library");
  search_->setClearButtonEnabled(true);
  showExample();
  search_->setToolTip(
      "Every word must be found; \"several words\" in quotes are one.\n"
      "In one place only: name: path: operator: object: run: notes: label: date: form: state:");
  search_->installEventFilter(this);
  connect(folderButton_, &QToolButton::clicked, this, &LibraryPanel::chooseFolder);
  connect(refreshButton_, &QToolButton::clicked, this, &LibraryPanel::refresh);
  connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
    filter_->setSearch(text);
    showState();
  });
  return inColumn({inRow({{folderButton_, 1}, refreshButton_}, Space::kNarrow), search_},
                  around(Space::kUsual));
}

void LibraryPanel::buildTable() {
  table_ = named(new RowsTable(pages_), "libraryTable");
  table_->setModel(filter_);
  table_->setDragEnabled(true);
  table_->setContextMenuPolicy(Qt::CustomContextMenu);
  table_->setSortingEnabled(true);
  QHeaderView* header = table_->horizontalHeader();
  header->setSectionsMovable(true);
  header->setStretchLastSection(true);
  header->setMinimumSectionSize(36);
  constexpr std::array kLetters = {26, 13, 17, 14, 12, 8, 18, 18, 18};
  constexpr int kPadding = 24;  // [px] around the text of a cell
  for (int column = 0; const int letters : kLetters)
    header->resizeSection(column++, letters * fontMetrics().horizontalAdvance('0') + kPadding);
  table_->sortByColumn(LibraryModel::kDate, Qt::DescendingOrder);
  restoreColumns(*header, settings_, kHeaderKey);
  pages_->addWidget(table_);
  // Ctrl moves without choosing.
  keepKeys(*table_,
           {Qt::Key_Left,
            Qt::Key_Right,
            Qt::SHIFT | Qt::Key_Left,
            Qt::SHIFT | Qt::Key_Right,
            Qt::CTRL | Qt::Key_Up,
            Qt::CTRL | Qt::Key_Down});
  keepKeys(*table_, QKeySequence::Copy, [this] { copyRows(); });
  keepKeys(*table_, {Qt::Key_Return, Qt::Key_Enter}, [this] { openChosen(); });
  keepKeys(
      *table_, {Qt::CTRL | Qt::Key_Return, Qt::CTRL | Qt::Key_Enter}, [this] { compareChosen(); });
  // On some keyboards the slash needs Shift.
  keepKeys(*table_, {Qt::Key_Slash, Qt::SHIFT | Qt::Key_Slash, Qt::CTRL | Qt::Key_F}, [this] {
    startSearch();
  });
  connect(table_, &QTableView::doubleClicked, this, &LibraryPanel::openChosen);
  connect(table_, &QWidget::customContextMenuRequested, this, &LibraryPanel::showMenu);
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    showSummary();
  });
}

void LibraryPanel::buildEmpty() {
  empty_ = new EmptyPage("library", pages_);
  pages_->addWidget(empty_);
  connect(empty_, &EmptyPage::buttonClicked, this, [this] {
    if (filter_->searching() && model_->numRecordings() > 0)
      search_->clear();
    else
      chooseFolder();
  });
}

void LibraryPanel::buildBottom() {
  summary_ = makeLabel(this, "librarySummary", "muted");
  summary_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  bar_ = named(new QProgressBar(this), "libraryProgress");
  bar_->setRange(0, kLibraryPanelSteps);
  bar_->setTextVisible(false);
  bar_->setFixedSize(90, 8);
  stop_ = makeToolButton(this, "libraryStop", "Stop reading", "Stop reading the folder");
  stop_->setProperty("flat", true);
  auto* row = inRow({{summary_, 1}, bar_, stop_},
                    {.left = Space::kWide,
                     .top = Space::kNarrow,
                     .right = Space::kUsual,
                     .bottom = Space::kNarrow});
  static_cast<QBoxLayout*>(layout())->addLayout(row);
  bar_->hide();
  stop_->hide();
  connect(stop_, &QToolButton::clicked, &scanner_, &LibraryScanner::cancel);
}

void LibraryPanel::connectScanner() {
  connect(&scanner_, &LibraryScanner::listed, this, [this](int numFiles) {
    numListed_ = numFiles;
    showState();
  });
  connect(
      &scanner_, &LibraryScanner::found, this, [this](const std::vector<LibraryEntry>& entries) {
        numFound_ += static_cast<int>(entries.size());
        model_->take(entries);
        showState();
      });
  connect(&scanner_, &LibraryScanner::progressed, this, [this](double fraction) {
    bar_->setValue(static_cast<int>(fraction * kLibraryPanelSteps));
  });
  connect(&scanner_, &LibraryScanner::finished, this, [this](const CatalogReport& report) {
    scanEnded(&report);
  });
  connect(&scanner_, &LibraryScanner::cancelled, this, [this] {
    stopped_ = true;
    scanEnded(nullptr);
  });
  connect(&scanner_, &LibraryScanner::failed, this, [this](const QString& message) {
    problems_ = {message};
    emit said(message);
    scanEnded(nullptr);
  });
}

void LibraryPanel::setFolder(const QString& folder) {
  folder_ = folder;
  settings_.setValue(kLibraryPanelFolderKey, folder_);
  if (!watcher_.directories().isEmpty()) watcher_.removePaths(watcher_.directories());
  model_->setFolder(folder_);
  problems_.clear();
  looked_ = false;
  stopped_ = false;
  stale_ = true;
  showFolder();
  if (isVisible() || scanner_.busy()) refresh();
  showState();
}

void LibraryPanel::refresh() {
  changed_.stop();
  if (folder_.isEmpty()) return;
  stale_ = !isVisible();
  // The scan follows when the panel is visible again.
  if (stale_) return scanner_.cancel();
  numListed_ = 0;
  numFound_ = 0;
  stopped_ = false;
  problems_.clear();
  bar_->setValue(0);
  model_->beginScan();
  scanner_.scan(folder_);
  showState();
}

void LibraryPanel::scanEnded(const CatalogReport* report) {
  looked_ = true;
  if (report) {
    model_->endScan();
    for (const std::string& problem : report->problems) {
      problems_.append(QString::fromStdString(problem));
      emit said(problems_.last());
    }
    if (!report->cacheProblem.empty())
      emit said("Library: " + QString::fromStdString(report->cacheProblem));
    QStringList folders;
    if (report->local)
      for (const auto& folder : report->folders)
        folders.append(QString::fromStdString(folder.string()));
    folders = folders.mid(0, kMaxWatched);
    const QStringList watched = watcher_.directories();
    for (const QString& folder : watched)
      if (!folders.contains(folder)) watcher_.removePath(folder);
    folders.removeIf([&](const QString& folder) { return watched.contains(folder); });
    if (!folders.isEmpty()) watcher_.addPaths(folders);
  }
  showState();
  emit settled();
}

void LibraryPanel::showFolder() {
  constexpr int kIconAndRefresh = 140;
  const QString shown = folderButton_->fontMetrics().elidedText(
      folder_, Qt::ElideMiddle, std::max(60, width() - kIconAndRefresh));
  folderButton_->setText(" " + (folder_.isEmpty() ? QString(kChooseFolder) : shown));
  folderButton_->setToolTip(folder_.isEmpty() ? QString("Choose a folder with recordings")
                                              : folder_ + "\nChoose another one");
}

// An example of a search that finds something here.
void LibraryPanel::showExample() {
  QString example = "name:foam";
  for (int row = 0; row < static_cast<int>(model_->numRecordings()); ++row) {
    const QString name = QFileInfo(model_->path(row)).completeBaseName();
    if (name.isEmpty() || name.contains(' ') || name.contains('"')) continue;
    example = "name:" + name;
    break;
  }
  search_->setPlaceholderText("Search, as " + example);
}

// Shows the table, or the reason why there is none.
void LibraryPanel::showState() {
  showExample();
  const bool busy = scanner_.busy();
  bar_->setVisible(busy);
  stop_->setVisible(busy);
  refreshButton_->setEnabled(!folder_.isEmpty());
  search_->setEnabled(!folder_.isEmpty());
  QString text;
  QString button = kChooseFolder;
  if (folder_.isEmpty()) {
    text = "Here you search and open the recordings of a folder and of its subfolders.";
  } else if (model_->numRecordings() > 0) {
    if (filter_->rowCount() == 0) {
      text = "Nothing here matches “" + search_->text().simplified() + "”.";
      if (const QString unknown = unknownKeysText(filter_->search()); !unknown.isEmpty())
        text += "\n\n" + unknown;
      if (stopped_) text += "\n\n" + stoppedText();
      button = "Clear the search";
    }
  } else if (busy) {
    text = "Reading the folder …";
    button.clear();
  } else if (!problems_.isEmpty()) {
    text = problems_.first();
  } else if (stopped_) {
    text = stoppedText();
  } else if (looked_) {
    text = "No recordings (.palpate, .dsa) in this folder or its subfolders.";
  }
  const bool empty = !text.isEmpty() || (!folder_.isEmpty() && model_->numRecordings() == 0);
  empty_->say(text, text.isEmpty() ? QString() : button);
  pages_->setCurrentIndex(empty ? 1 : 0);
  showSummary();
}

// Says that the list is not complete, and how it becomes so.
QString LibraryPanel::stoppedText() const {
  return "Reading stopped: " + countText(static_cast<int>(model_->numRecordings()), "recording") +
         " so far. Refresh (F5) reads the whole folder.";
}

void LibraryPanel::showSummary() {
  const int all = static_cast<int>(model_->numRecordings());
  const int shown = filter_->rowCount();
  const auto selected = table_->selectionModel()->selectedRows().size();
  QStringList parts;
  if (scanner_.busy() && numListed_ > 0)
    parts.append(QString("%1 of %2 read").arg(numFound_).arg(numListed_));
  else if (stopped_ && all > 0)
    parts.append(
        "reading stopped: " + (filter_->searching() ? QString("%1 of ").arg(shown) : QString()) +
        countText(all, "recording") + " so far (Refresh reads all)");
  else if (all > 0)
    parts.append(filter_->searching()
                     ? QString("%1 of %2").arg(shown).arg(countText(all, "recording"))
                     : countText(all, "recording") + ", " + lengthText(model_->totalS()));
  if (selected > 1) parts.append(QString::number(selected) + " chosen");
  if (!problems_.isEmpty() && all > 0)
    parts.append(countText(static_cast<int>(problems_.size()), "folder") + " not readable");
  summary_->setText(parts.join(" · "));
  QStringList more = problems_.mid(0, 10);
  if (stopped_ && !scanner_.busy()) more.prepend(stoppedText());
  summary_->setToolTip(more.join('\n'));
}

void LibraryPanel::chooseFolder() {
  const QString folder = ask_.folder("Folder with recordings", folder_);
  if (folder.isEmpty()) return;
  setFolder(QFileInfo(folder).absoluteFilePath());
  // The button that had the keyboard may be hidden now: the next one is "Stop reading".
  search_->setFocus(Qt::OtherFocusReason);
}

void LibraryPanel::setDamaged(const std::filesystem::path& path, const std::string& message) {
  model_->setDamaged(path, message);
}

void LibraryPanel::startSearch() {
  search_->setFocus(Qt::ShortcutFocusReason);
  search_->selectAll();
}

QStringList LibraryPanel::chosen() const {
  QStringList paths;
  for (const QModelIndex& row : table_->chosenRows())
    paths.append(model_->path(filter_->mapToSource(row).row()));
  return paths;
}

void LibraryPanel::openChosen() {
  const QStringList paths = chosen();
  if (!paths.isEmpty()) emit openRequested(paths);
}

void LibraryPanel::compareChosen() {
  const QStringList paths = chosen();
  if (paths.size() == 1 && comparable()) emit compareRequested(paths.first());
}

void LibraryPanel::copyRows() const {
  const QModelIndexList rows = table_->chosenRows();
  if (rows.isEmpty()) return;
  const QHeaderView& header = *table_->horizontalHeader();
  QStringList lines;
  const auto addLine = [&](auto cell) {
    QStringList cells;
    for (int at = 0; at < header.count(); ++at) {
      const int column = header.logicalIndex(at);
      if (!header.isSectionHidden(column)) cells.append(cell(column).toString().simplified());
    }
    lines.append(cells.join('\t'));
  };
  addLine([&](int column) { return filter_->headerData(column, Qt::Horizontal); });
  for (const QModelIndex& row : rows)
    addLine([&](int column) { return row.siblingAtColumn(column).data(); });
  QApplication::clipboard()->setText(lines.join('\n') + '\n');
}

void LibraryPanel::showMenu(const QPoint& at) {
  const QStringList paths = chosen();
  QMenu menu(this);
  const auto add = [&](const QString& text, const QString& keys, bool enabled, auto what) {
    QAction* action = menu.addAction(text, this, what);
    action->setShortcut(QKeySequence(keys));
    action->setEnabled(enabled);
  };
  const bool one = paths.size() == 1;
  add("&Open", "Return", !paths.isEmpty(), [this] { openChosen(); });
  add("&Compare with the shown recording", "Ctrl+Return", one && comparable(), [this] {
    compareChosen();
  });
  add("&Batch…", {}, !paths.isEmpty(), [this] { emit batchRequested(); });
  menu.addSeparator();
  add("&Show in the file manager", {}, one, [&] { reveal(paths.first()); });
  add("Copy &rows", "Ctrl+C", !paths.isEmpty(), [this] { copyRows(); });
  add("Copy &path", {}, !paths.isEmpty(), [&] {
    QApplication::clipboard()->setText(paths.join('\n'));
  });
  menu.addSeparator();
  add("Re&fresh", "F5", !folder_.isEmpty(), [this] { refresh(); });
  menu.exec(table_->viewport()->mapToGlobal(at));
}

void LibraryPanel::rememberColumns() {
  storeColumns(*table_->horizontalHeader(), settings_, kHeaderKey);
}

void LibraryPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (stale_) refresh();
}

void LibraryPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  showFolder();
}

// Moves the focus from the search field to the table by keys.
bool LibraryPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched != search_ ||
      (event->type() != QEvent::KeyPress && event->type() != QEvent::ShortcutOverride))
    return QWidget::eventFilter(watched, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  const bool down = key == Qt::Key_Down || key == Qt::Key_Return || key == Qt::Key_Enter;
  const bool escape = key == Qt::Key_Escape && !search_->text().isEmpty();
  if (!down && !escape) return QWidget::eventFilter(watched, event);
  event->accept();
  if (event->type() == QEvent::ShortcutOverride) return true;
  if (escape) {
    search_->clear();
  } else if (filter_->rowCount() > 0) {
    table_->setFocus(Qt::TabFocusReason);
    if (chosen().isEmpty()) table_->selectRow(0);
  }
  return true;
}

}  // namespace palpate::gui
