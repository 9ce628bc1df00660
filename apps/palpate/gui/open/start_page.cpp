#include "gui/open/start_page.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/appearance/icons.h"
#include "gui/appearance/text_size.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr const char* kDropText =
    "or drop recordings (.dsa, .palpate, .h5, .mcap) or a folder anywhere in this window";
// For text of the desktop's size.
constexpr int kColumnWidth = 560;        // [px]
constexpr int kStartPageRowHeight = 46;  // [px] of a recent file

QFont scaled(QFont font, double factor, bool bold) {
  font.setPointSizeF(font.pointSizeF() * factor);
  font.setBold(bold);
  return font;
}

// A button with two lines of text: file name and folder.
class RecentRow : public QPushButton {
 public:
  RecentRow(const QString& path, bool exists, QWidget* parent) : QPushButton(parent) {
    setObjectName("RecentRow");
    fitToText(*this, [this] { setFixedHeight(qRound(textScale() * kStartPageRowHeight)); });
    setEnabled(exists);
    setAccessibleName(path);
    setToolTip(path);
    const QFileInfo file(path);
    auto* name = new QLabel(file.fileName(), this);
    name->setTextFormat(Qt::PlainText);
    name->setFont(scaled(font(), 1.0, true));
    auto* folder = new QLabel(this);
    folder->setTextFormat(Qt::PlainText);
    folder->setProperty("role", "muted");
    folder->setText(fontMetrics().elidedText(file.path(), Qt::ElideMiddle, kColumnWidth - 150));
    auto* lines = new QVBoxLayout;
    lines->setSpacing(1);
    lines->addWidget(name);
    lines->addWidget(folder);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 4, 12, 4);
    row->addLayout(lines, 1);
    if (!exists) row->addWidget(new QLabel("missing", this));
    for (QLabel* label : findChildren<QLabel*>())
      label->setAttribute(Qt::WA_TransparentForMouseEvents);
  }
};

}  // namespace

StartPage::StartPage(RecentFiles& recent, bool withDemo, QWidget* parent)
    : QWidget(parent), recent_(recent) {
  setObjectName("StartPage");
  setAttribute(Qt::WA_StyledBackground);
  auto* title = new QLabel("Palpate", this);
  title->setFont(scaled(font(), 2.4, true));
  auto* subtitle = new QLabel("See the pressure on a robot hand.", this);
  subtitle->setProperty("role", "muted");
  subtitle->setFont(scaled(font(), 1.15, false));
  auto* buttons = new QGridLayout;
  buttons->setSpacing(10);
  buttons->setColumnStretch(0, 1);
  buttons->setColumnStretch(1, 1);
  const auto button = [&](const QString& text, const char* name, const QString& tip) {
    auto* made = new QPushButton(text, this);
    made->setObjectName(name);
    made->setMinimumHeight(38);
    made->setToolTip(tip);
    buttons->addWidget(made, buttons->count() / 2, buttons->count() % 2);
    return made;
  };
  auto* connectHand =
      button("Connect a hand…", "startConnect", "Ports, emulated hand, replay (Ctrl+K)");
  connectHand->setProperty("primary", true);
  connect(connectHand, &QPushButton::clicked, this, &StartPage::connectRequested);
  connect(button("Try the emulated hand",
                 "startEmulated",
                 "A simulated hand that grasps a ball (Ctrl+Shift+D)"),
          &QPushButton::clicked,
          this,
          &StartPage::emulatedRequested);
  connect(button("Open a recording…", "startOpen", "(Ctrl+O)"),
          &QPushButton::clicked,
          this,
          &StartPage::openRequested);
  connect(button("Look through a folder",
                 "startLibrary",
                 "The Library lists the recordings of a folder and its subfolders (Ctrl+Shift+L)"),
          &QPushButton::clicked,
          this,
          &StartPage::libraryRequested);
  if (withDemo)
    connect(button("Try the demo recording", "startDemo", "(Ctrl+D)"),
            &QPushButton::clicked,
            this,
            &StartPage::demoRequested);
  dropHint_ = new QLabel(kDropText, this);
  dropHint_->setObjectName("DropHint");
  dropHint_->setAlignment(Qt::AlignCenter);
  dropHint_->setWordWrap(true);
  dropHint_->setMinimumHeight(64);
  recentHeading_ = new QLabel("RECENT", this);
  recentHeading_->setProperty("role", "heading");

  // The page scrolls when ten recent files don't fit into the window.
  auto* content = new QWidget(this);
  content->setObjectName("StartPage");
  auto* middle = new QWidget(content);
  fitToText(*middle, [middle] { middle->setFixedWidth(qRound(textScale() * kColumnWidth)); });
  column_ = new QVBoxLayout(middle);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(8);
  column_->addWidget(title);
  column_->addWidget(subtitle);
  column_->addSpacing(16);
  column_->addLayout(buttons);
  column_->addSpacing(4);
  column_->addWidget(dropHint_);
  column_->addSpacing(18);
  column_->addWidget(recentHeading_);
  auto* page = new QVBoxLayout(content);
  page->setContentsMargins(20, 20, 20, 20);
  page->addStretch(2);
  page->addWidget(middle, 0, Qt::AlignHCenter);
  page->addStretch(3);
  auto* scroll = new QScrollArea(this);
  scroll->setWidgetResizable(true);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(content);
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->addWidget(scroll);
  connect(&recent_, &RecentFiles::changed, this, &StartPage::listRecent);
}

void StartPage::setDragging(bool on) {
  dropHint_->setProperty("dragging", on);
  dropHint_->setText(on ? "drop it to open it" : kDropText);
  style()->unpolish(dropHint_);
  style()->polish(dropHint_);
}

void StartPage::setTheme(Theme theme) {
  theme_ = theme;
  listRecent();
}

void StartPage::showEvent(QShowEvent* event) {
  // Files may have been created or deleted meanwhile.
  recent_.look();
  listRecent();
  QWidget::showEvent(event);
}

void StartPage::listRecent() {
  delete list_;
  list_ = new QWidget(this);
  auto* rows = new QVBoxLayout(list_);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(5);
  for (const QString& path : recent_.paths()) {
    auto* row = new QHBoxLayout;
    row->setSpacing(4);
    auto* button = new RecentRow(path, !recent_.isMissing(path), list_);
    connect(button, &QPushButton::clicked, this, [this, path] { emit fileChosen(path); });
    auto* remove = new QToolButton(list_);
    remove->setObjectName("removeRecent");
    remove->setProperty("flat", true);
    remove->setIcon(makeIcon(IconShape::kClose, theme_));
    remove->setIconSize({10, 10});
    remove->setToolTip("Remove from this list (the file is kept)");
    // The row deletes itself, which must not happen before the click is processed (queued
    // connection).
    connect(
        remove,
        &QToolButton::clicked,
        &recent_,
        [this, path] { recent_.remove(path); },
        Qt::QueuedConnection);
    row->addWidget(button, 1);
    row->addWidget(remove);
    rows->addLayout(row);
  }
  recentHeading_->setVisible(!recent_.paths().isEmpty());
  column_->addWidget(list_);
}

}  // namespace palpate::gui
