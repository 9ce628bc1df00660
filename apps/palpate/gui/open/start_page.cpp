#include "gui/open/start_page.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/appearance/icons.h"
#include "gui/appearance/text_size.h"
#include "gui/widgets/make.h"
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

// A button with a picture, where there is one, and two lines of text: file name and folder.
class RecentRow : public QPushButton {
 public:
  RecentRow(const QString& path, const QImage& picture, bool exists, QWidget* parent)
      : QPushButton(parent) {
    setObjectName("RecentRow");
    const int leastPx = picture.isNull() ? 0 : kThumbnailSize.height() + 2;
    fitToText(*this, [this, leastPx] {
      setFixedHeight(std::max(leastPx, qRound(textScale() * kStartPageRowHeight)));
    });
    setEnabled(exists);
    setAccessibleName(path);
    setToolTip(path);
    const QFileInfo file(path);
    auto* name = makeLabel(this, {}, {}, file.fileName());
    name->setFont(scaled(font(), 1.0, true));
    auto* folder = makeLabel(this, {}, "muted");
    constexpr int kBesideFolder = 150;  // [px]
    folder->setText(fontMetrics().elidedText(
        file.path(),
        Qt::ElideMiddle,
        kColumnWidth - kBesideFolder - (picture.isNull() ? 0 : kThumbnailSize.width())));
    auto* row = inRow({{inColumn({name, folder}, Space::kNone), 1}}, kBarEdges);
    setLayout(row);
    if (!picture.isNull()) {
      auto* shown = new QLabel(this);
      shown->setPixmap(QPixmap::fromImage(picture));
      row->insertWidget(0, shown);
      row->setContentsMargins(1, 1, row->contentsMargins().right(), 1);
    }
    if (!exists) row->addWidget(new QLabel("missing", this));
    for (QLabel* label : findChildren<QLabel*>())
      label->setAttribute(Qt::WA_TransparentForMouseEvents);
  }
};

}  // namespace

StartPage::StartPage(RecentFiles& recent,
                     const Thumbnails& thumbnails,
                     bool withDemo,
                     QWidget* parent)
    : QWidget(parent), recent_(recent), thumbnails_(thumbnails) {
  setObjectName("StartPage");
  setAttribute(Qt::WA_StyledBackground);
  auto* title = new QLabel("Palpate", this);
  title->setFont(scaled(font(), 2.4, true));
  auto* subtitle = makeLabel(this, {}, "muted", "See the pressure on a robot hand.");
  subtitle->setFont(scaled(font(), 1.15, false));
  auto* buttons = new QGridLayout;
  buttons->setSpacing(10);
  buttons->setColumnStretch(0, 1);
  buttons->setColumnStretch(1, 1);
  const auto button = [&](const QString& text, const char* name, const QString& tip) {
    auto* made = makeButton(this, name, text, tip);
    made->setMinimumHeight(38);
    buttons->addWidget(made, buttons->count() / 2, buttons->count() % 2);
    return made;
  };
  auto* connectHand =
      button("Connect a hand…", "startConnect", "Ports, emulated hand, replay (Ctrl+K)");
  connectHand->setProperty("primary", true);
  connect(connectHand, &QPushButton::clicked, this, &StartPage::connectRequested);
  connect(button("Try the emulated hand", "startEmulated", "A simulated hand that grasps a ball"),
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
    connect(button("Try the demo recording", "startDemo", ""),
            &QPushButton::clicked,
            this,
            &StartPage::demoRequested);
  const auto offer = [&](const char* name) {
    auto* made = makeButton(this, name, "");
    made->setMinimumHeight(38);
    made->hide();
    return made;
  };
  again_ = offer("startAgain");
  connect(again_, &QPushButton::clicked, this, &StartPage::againRequested);
  plan_ = offer("startPlan");
  connect(plan_, &QPushButton::clicked, this, &StartPage::planRequested);
  dropHint_ = makeLines(this, "DropHint", {}, kDropText);
  dropHint_->setAlignment(Qt::AlignCenter);
  dropHint_->setMinimumHeight(64);
  recentHeading_ = makeLabel(this, {}, "heading", "RECENT");

  // The page scrolls when ten recent files don't fit into the window.
  auto* content = named(new QWidget(this), "StartPage");
  auto* middle = new QWidget(content);
  fitToText(*middle, [middle] { middle->setFixedWidth(qRound(textScale() * kColumnWidth)); });
  column_ = new QVBoxLayout(middle);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(8);
  column_->addWidget(title);
  column_->addWidget(subtitle);
  column_->addSpacing(16);
  column_->addWidget(again_);
  column_->addWidget(plan_);
  column_->addLayout(buttons);
  column_->addSpacing(4);
  column_->addWidget(dropHint_);
  column_->addSpacing(18);
  column_->addWidget(recentHeading_);
  content->setLayout(
      inColumn({Stretch{2}, {middle, 0, Qt::AlignHCenter}, Stretch{3}}, around(Space::kDialog)));
  auto* scroll = new QScrollArea(this);
  scroll->setWidgetResizable(true);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(content);
  setLayout(inColumn({scroll}));
  connect(&recent_, &RecentFiles::changed, this, &StartPage::listRecent);
}

void StartPage::setScene(QWidget* scene) {
  scene_ = scene;
  column_->insertWidget(2, scene);  // below the words
  fitScene();
}

// On a low page the scene gives way to the buttons.
void StartPage::fitScene() {
  constexpr double kPagePerScene = 2.4;  // [of heights]
  if (scene_) scene_->setVisible(height() >= kPagePerScene * scene_->height());
}

void StartPage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fitScene();
}

void StartPage::setLastConnection(const QString& text) {
  again_->setText("Connect again: " + QString(text).replace('&', "&&"));
  again_->setToolTip(text);
  again_->setVisible(!text.isEmpty());
}

void StartPage::setPlan(const QString& text) {
  plan_->setText("Plan of recordings: " + QString(text).replace('&', "&&"));
  plan_->setToolTip(text);
  plan_->setVisible(!text.isEmpty());
}

void StartPage::setDragging(bool on) {
  dropHint_->setProperty("dragging", on);
  dropHint_->setText(on ? "drop it to open it" : kDropText);
  style()->unpolish(dropHint_);
  style()->polish(dropHint_);
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
    auto* button = new RecentRow(path, thumbnails_.of(path), !recent_.isMissing(path), list_);
    connect(button, &QPushButton::clicked, this, [this, path] { emit fileChosen(path); });
    auto* remove =
        named(new QToolButton(list_), "removeRecent", "Remove from this list (the file is kept)");
    remove->setProperty("flat", true);
    remove->setIcon(makeIcon(IconShape::kClose));
    remove->setIconSize({10, 10});
    // The row deletes itself, which must not happen before the click is processed (queued
    // connection).
    connect(
        remove,
        &QToolButton::clicked,
        &recent_,
        [this, path] { recent_.remove(path); },
        Qt::QueuedConnection);
    rows->addLayout(inRow({{button, 1}, remove}, Space::kNarrow));
  }
  recentHeading_->setVisible(!recent_.paths().isEmpty());
  column_->addWidget(list_);
}

}  // namespace palpate::gui
