#include "gui/help/manual_window.h"

#include <QAbstractTextDocumentLayout>
#include <QDesktopServices>
#include <QImageReader>
#include <QScreen>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
#include <QTextBlock>
#include <QTextTable>
#include <algorithm>

#include <palpate/core/number_text.h>

#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kPageMargin = 18;       // [px]
constexpr int kLargestPicture = 900;  // [px] wide
constexpr int kCellPadding = 4;       // [px]
constexpr QSize kUsualManual(1080, 760);
constexpr double kManualScreenPart = 0.9;
constexpr int kPageRole = Qt::UserRole;
constexpr int kAnchorRole = Qt::UserRole + 1;

// Lines around tables and a background of code, which Qt's Markdown has none of.
void styleBlocks(QTextDocument& document) {
  const ThemeColors& colors = colorsOf();
  for (QTextFrame* frame : document.rootFrame()->childFrames())
    if (auto* table = qobject_cast<QTextTable*>(frame)) {
      QTextTableFormat format = table->format();
      format.setBorder(1);
      format.setBorderBrush(colors.border);
      format.setBorderStyle(QTextFrameFormat::BorderStyle_Solid);
      format.setBorderCollapse(true);
      format.setCellPadding(kCellPadding);
      format.setTopMargin(kCellPadding);
      format.setBottomMargin(2 * kCellPadding);
      table->setFormat(format);
    }
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
    if (!block.blockFormat().hasProperty(QTextFormat::BlockCodeLanguage)) continue;
    QTextBlockFormat format = block.blockFormat();
    format.setBackground(mixed(colors.window, colors.muted, 0.12));
    QTextCursor(block).setBlockFormat(format);
  }
}

QToolButton* arrowButton(Qt::ArrowType arrow, const QString& what, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setArrowType(arrow);
  button->setToolTip(what);
  button->setAccessibleName(what);
  return button;
}

}  // namespace

ManualBrowser::ManualBrowser(const ManualPages& pages, QWidget* parent)
    : QTextBrowser(parent), pages_(pages) {
  setOpenLinks(false);
  // A bar that comes and goes would change the width of the page, and move what it was scrolled to.
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
  setFrameShape(QFrame::NoFrame);
  setAccessibleName("Page of the manual");
  document()->setDocumentMargin(kPageMargin);
}

void ManualBrowser::showPage(const QString& name) {
  page_ = name;
  document()->setDefaultFont(font());
  pages_.fill(*document(), name);
  document()->setDocumentMargin(kPageMargin);
  styleBlocks(*document());
  moveCursor(QTextCursor::Start);
}

void ManualBrowser::scrollTo(int position) {
  const QTextBlock block = document()->findBlock(position);
  if (!block.isValid() || position == 0) return verticalScrollBar()->setValue(0);
  document()->size();  // lays out the whole page: until then the scroll bar ends too early
  const QRectF place = document()->documentLayout()->blockBoundingRect(block);
  verticalScrollBar()->setValue(static_cast<int>(place.top()) - kCellPadding);
}

QVariant ManualBrowser::loadResource(int type, const QUrl& name) {
  if (type != QTextDocument::ImageResource) return {};
  if (!name.isRelative()) return {};  // nothing is fetched from a network
  // Relative to the page.
  const auto file =
      (pages_.folder() / page_.toStdString()).parent_path() / name.path().toStdString();
  QImageReader reader(QString::fromStdString(file.string()));
  const QSize size = reader.size();
  const int widest =
      std::clamp(viewport()->width() - 3 * kPageMargin, 2 * kPageMargin, kLargestPicture);
  QImage picture = reader.read();
  if (size.width() <= widest || picture.isNull()) return picture;
  return picture.scaledToWidth(widest, Qt::SmoothTransformation);
}

ManualWindow::ManualWindow(const std::filesystem::path& folder, QWidget* parent)
    : QDialog(parent, Qt::Window),
      pages_(folder),
      browser_(new ManualBrowser(pages_, this)),
      contents_(new QTreeWidget(this)),
      results_(new QListWidget(this)),
      left_(new QStackedWidget(this)) {
  setWindowTitle("Manual – Palpate");
  contents_->setHeaderHidden(true);
  contents_->setFrameShape(QFrame::NoFrame);
  contents_->setAccessibleName("Contents");
  results_->setWordWrap(true);
  results_->setFrameShape(QFrame::NoFrame);
  results_->setAccessibleName("Search results");
  left_->addWidget(contents_);
  left_->addWidget(results_);
  auto* halves = new QSplitter(this);
  halves->addWidget(left_);
  halves->addWidget(browser_);
  halves->setStretchFactor(1, 1);
  halves->setChildrenCollapsible(false);
  setLayout(inColumn({makeTop(), {halves, 1}}, Space::kNone));
  const QRect available = screen()->availableGeometry();
  resize(kUsualManual.boundedTo(available.size() * kManualScreenPart));
  // Over the other window, but with its title bar on the screen: Qt counts that only once the
  // window manager has drawn it.
  constexpr int kTitleBar = 36;  // [px]
  const QPoint wanted = (parent ? parent->window()->geometry() : available).center() -
                        QPoint(width() / 2, height() / 2);
  const QPoint last = available.bottomRight() - QPoint(width(), height());
  move(std::max(available.left(), std::min(wanted.x(), last.x())),
       std::max(available.top() + kTitleBar, std::min(wanted.y(), last.y())));
  halves->setSizes({width() / 4, width() - width() / 4});
  addKeys();
  buildContents();
  connect(browser_, &QTextBrowser::anchorClicked, this, [this](const QUrl& link) {
    follow(link.toString());
  });
  connect(contents_, &QTreeWidget::itemActivated, this, [this](const QTreeWidgetItem* item) {
    goTo(item->data(0, kPageRole).toString(), item->data(0, kAnchorRole).toString());
  });
  connect(contents_, &QTreeWidget::itemClicked, contents_, &QTreeWidget::itemActivated);
  connect(results_, &QListWidget::currentRowChanged, this, &ManualWindow::showHit);
  if (pages_.names().isEmpty())
    browser_->setPlainText("The pages of the manual are not installed: there is none in " +
                           QString::fromStdString(folder.string()) +
                           ". Install the program with its data folder.");
  else
    show(pages_.names().front());
  browser_->setFocus();
  fitToTheme(*this, [this] {
    if (!page_.isEmpty()) goBackTo(here());
  });
}

QWidget* ManualWindow::makeTop() {
  auto* top = new QWidget(this);
  back_ = arrowButton(Qt::LeftArrow, "Back (Alt+Left)", top);
  forward_ = arrowButton(Qt::RightArrow, "Forward (Alt+Right)", top);
  words_ = new QLineEdit(top);
  words_->setPlaceholderText("Search all pages (Ctrl+F)");
  words_->setAccessibleName("Search all pages");
  words_->setClearButtonEnabled(true);
  words_->setMaximumWidth(320);
  words_->setToolTip(
      "Finds the pages with all these words, in any order; Enter or F3: next place, Shift+F3: "
      "previous place");
  status_ = makeLabel(top, {}, "muted");
  top->setLayout(inRow({back_, forward_, {words_, 1}, {status_, 1}}, around(Space::kUsual)));
  connect(back_, &QToolButton::clicked, this, &ManualWindow::back);
  connect(forward_, &QToolButton::clicked, this, &ManualWindow::forward);
  connect(words_, &QLineEdit::textChanged, this, &ManualWindow::search);
  connect(words_, &QLineEdit::returnPressed, this, &ManualWindow::nextHit);
  return top;
}

void ManualWindow::addKeys() {
  const auto on = [this](const char* keys, auto what) {
    connect(new QShortcut(QKeySequence(QString(keys)), this), &QShortcut::activated, this, what);
  };
  on("Alt+Left", &ManualWindow::back);
  on("Alt+Right", &ManualWindow::forward);
  on("F3", &ManualWindow::nextHit);
  on("Shift+F3", &ManualWindow::previousHit);
  on("Ctrl+F", [this] {
    words_->setFocus();
    words_->selectAll();
  });
  on("Ctrl+W", &QDialog::close);
}

// Every page is an entry; below it are its sections.
void ManualWindow::buildContents() {
  for (const QString& name : pages_.names()) {
    auto* entry = new QTreeWidgetItem(contents_, {pages_.title(name)});
    entry->setData(0, kPageRole, name);
    for (const ManualHeading& heading : pages_.headings(name)) {
      if (heading.level != 2) continue;
      auto* section = new QTreeWidgetItem(entry, {heading.title});
      section->setData(0, kPageRole, name);
      section->setData(0, kAnchorRole, heading.anchor);
    }
  }
}

ManualWindow::Place ManualWindow::here() const {
  return {page_, browser_->verticalScrollBar()->value()};
}

void ManualWindow::show(const QString& page) {
  page_ = page;
  browser_->showPage(page);
  setWindowTitle(pages_.title(page) + " – Manual of Palpate");
  for (int i = 0; i < contents_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* entry = contents_->topLevelItem(i);
    const bool current = entry->data(0, kPageRole).toString() == page;
    if (current && contents_->currentItem() != entry &&
        (!contents_->currentItem() || contents_->currentItem()->parent() != entry))
      contents_->setCurrentItem(entry);
  }
  say({});
  markHits();
  updateButtons();
}

void ManualWindow::goTo(const QString& page, const QString& anchor) {
  if (!page_.isEmpty()) before_.push_back(here());
  after_.clear();
  if (page != page_) show(page);
  browser_->scrollTo(pages_.positionOf(page, anchor).value_or(0));
  updateButtons();
}

void ManualWindow::goBackTo(const Place& place) {
  show(place.page);
  browser_->verticalScrollBar()->setValue(place.scroll);
}

void ManualWindow::back() {
  if (before_.empty()) return;
  const Place place = before_.back();
  before_.pop_back();
  after_.push_back(here());
  goBackTo(place);
}

void ManualWindow::forward() {
  if (after_.empty()) return;
  const Place place = after_.back();
  after_.pop_back();
  before_.push_back(here());
  goBackTo(place);
}

void ManualWindow::follow(const QString& link) {
  const QUrl url(link);
  if (!url.isRelative()) {
    if (!QDesktopServices::openUrl(url)) say("No program opens " + link);
    return;
  }
  const QString page = url.path().isEmpty() ? page_ : pages_.target(url.path(), page_);
  if (!page.isEmpty()) return goTo(page, url.fragment());
  const auto file =
      ((pages_.folder() / page_.toStdString()).parent_path() / url.path().toStdString())
          .lexically_normal();
  const QString path = QString::fromStdString(file.string());
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    say("Only in the source code of Palpate: " + url.path().remove("../"));
  else if (!QDesktopServices::openUrl(QUrl::fromLocalFile(path)))
    say("No program opens " + path);
}

void ManualWindow::search() {
  hits_ = pages_.search(words_->text());
  rowHits_.clear();
  const QSignalBlocker quiet(results_);
  results_->clear();
  int seenTo = 0;  // on the page of the last row [characters]
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const ManualHit& hit = hits_[i];
    const bool samePage = i > 0 && hits_[i - 1].page == hit.page;
    // The last row shows it already.
    if (samePage && hit.position + hit.length <= seenTo) continue;
    constexpr int kShown = 120;  // characters of the line
    const int from = std::max(0, hit.inLine - kShown / 3);
    const QString excerpt = hit.line.mid(from, kShown);
    seenTo = hit.position - hit.inLine + from + static_cast<int>(excerpt.size());
    results_->addItem(hit.title + "\n" + (from > 0 ? "… " : "") + excerpt);
    rowHits_.push_back(i);
  }
  left_->setCurrentWidget(words_->text().isEmpty() ? static_cast<QWidget*>(contents_) : results_);
  markHits();
  if (words_->text().isEmpty()) return say({});
  say(hits_.empty() ? QString("No page has all these words")
                    : "Found at " + QString::fromStdString(counted(rowHits_.size(), "place")));
}

// All places on this page are marked, the chosen one strongest.
void ManualWindow::markHits() {
  QList<QTextEdit::ExtraSelection> marks;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    if (hits_[i].page != page_) continue;
    QTextEdit::ExtraSelection mark;
    mark.cursor = QTextCursor(browser_->document());
    mark.cursor.setPosition(hits_[i].position);
    mark.cursor.setPosition(hits_[i].position + hits_[i].length, QTextCursor::KeepAnchor);
    const int row = results_->currentRow();
    const bool chosen = row >= 0 && rowHits_[static_cast<std::size_t>(row)] == i;
    mark.format.setBackground(chosen ? colorsOf().accent : colorsOf().accentSoft);
    mark.format.setForeground(chosen ? colorsOf().window : colorsOf().text);
    marks.append(mark);
  }
  browser_->setExtraSelections(marks);
}

void ManualWindow::showHit(int row) {
  if (row < 0 || row >= static_cast<int>(rowHits_.size())) return;
  const ManualHit& hit = hits_[rowHits_[static_cast<std::size_t>(row)]];
  if (hit.page != page_) {
    before_.push_back(here());
    after_.clear();
    show(hit.page);
  }
  markHits();
  browser_->scrollTo(hit.position);
  say(QString("Place %1 of %2").arg(row + 1).arg(rowHits_.size()));
}

void ManualWindow::nextHit() {
  if (!hits_.empty()) results_->setCurrentRow((results_->currentRow() + 1) % results_->count());
}

void ManualWindow::previousHit() {
  if (hits_.empty()) return;
  const int row = results_->currentRow();
  results_->setCurrentRow(row > 0 ? row - 1 : results_->count() - 1);
}

void ManualWindow::updateButtons() {
  back_->setEnabled(!before_.empty());
  forward_->setEnabled(!after_.empty());
}

void ManualWindow::say(const QString& text) { status_->setText(text); }

}  // namespace palpate::gui
