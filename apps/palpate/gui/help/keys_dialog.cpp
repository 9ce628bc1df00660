#include "gui/help/keys_dialog.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QScreen>
#include <QScrollArea>
#include <algorithm>

#include "gui/widgets/make.h"
#include "gui/window_state/action_registry.h"

namespace palpate::gui {
namespace {

constexpr int kWidestWords = 190;     // [px]
constexpr int kNarrowestWords = 120;  // [px]
constexpr double kScreenPart = 0.95;  // largest part of the screen that the dialog covers

// Mouse gestures have no actions, so they are listed here.
const std::vector<KeyEntry>& mouseEntries() {
  static const std::vector<KeyEntry> entries = {
      {"Mouse", "Click or drag", "In the timeline or the seek bar: move through time"},
      {"Mouse", "Wheel", "In the timeline: zoom; with Shift: pan"},
      {"Mouse", "Wheel or drag", "Over a vertical axis: its range; double click: automatic"},
      {"Mouse", "Drag", "In the live chart: two cursors with differences; click: none"},
      {"Mouse", "Double click", "In the live chart: to the newest frame"},
      {"Mouse", "Middle or Shift+drag", "In the timeline: pan"},
      {"Mouse", "Double click", "In the timeline: show all of it; on an event: name it"},
      {"Mouse", "Drag", "In the timeline: select; along its axis: scrub; ends can be moved"},
      {"Mouse", "Click or drag", "Over taxels: choose them; with Ctrl: choose more"},
      {"Mouse", "Drag", "Hand in 3-D: turn; with Shift or the middle button: move"},
      {"Mouse", "Wheel or right drag", "Hand in 3-D: zoom"},
      {"Mouse", "Click, Ctrl+drag", "Hand in 3-D: choose taxels; double click: all of it"},
      {"Mouse", "Right button", "Over the matrices: which taxels are scanned"},
      {"Mouse", "Hover", "Over a taxel or the timeline: the values there"},
      {"Mouse", "Drop a file", "Anywhere: open it"}};
  return entries;
}

// The sections of some entries; the labels of what the keys do are added to `words`.
QWidget* columnOf(const std::vector<KeyEntry>& entries,
                  std::vector<QLabel*>& words,
                  QWidget* parent) {
  auto* column = new QWidget(parent);
  auto* grid = new QGridLayout(column);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(18);
  grid->setVerticalSpacing(5);
  grid->setColumnStretch(1, 1);
  QString section;
  int row = 0;
  for (const KeyEntry& entry : entries) {
    if (entry.section != section) {
      section = entry.section;
      auto* heading = makeLabel(column, {}, "heading", section.toUpper());
      heading->setContentsMargins(0, row == 0 ? 0 : 12, 0, 2);
      grid->addWidget(heading, row++, 0, 1, 2);
    }
    auto* keys = makeLabel(column, {}, {}, entry.keys);
    grid->addWidget(keys, row, 0);
    auto* what = makeLines(column, {}, "muted", entry.what);
    words.push_back(what);
    grid->addWidget(what, row++, 1);
  }
  grid->setRowStretch(row, 1);
  return column;
}

void setWidestWords(const std::vector<QLabel*>& words, int widest) {
  for (QLabel* what : words)
    what->setFixedWidth(std::min(widest, what->fontMetrics().horizontalAdvance(what->text()) + 4));
}

}  // namespace

std::vector<KeyEntry> keysOf(const QList<QAction*>& actions) {
  std::vector<KeyEntry> entries;
  for (const char* section :
       {"File", "Edit", "View", "Hand in 3-D", "Analysis", "Hand", "Playback", "Help"}) {
    for (const QAction* action : actions) {
      if (sectionOf(*action) != section) continue;
      if (const auto kind = kindOf(*action)) {
        if (entries.back().what != kind->what) entries.push_back({section, kind->keys, kind->what});
        continue;
      }
      QStringList keys;
      for (const QKeySequence& sequence : action->shortcuts())
        keys.append(sequence.toString(QKeySequence::NativeText));
      if (!keys.isEmpty()) entries.push_back({section, keys.join(" or "), plainText(*action)});
    }
  }
  return entries;
}

KeysDialog::KeysDialog(const QList<QAction*>& actions, QWidget* parent) : QDialog(parent) {
  setWindowTitle("Keys");
  // Distributes the sections so that the columns are about equally long.
  std::vector<KeyEntry> left, middle, right, space;
  for (const KeyEntry& entry : keysOf(actions))
    (entry.section == "File" || entry.section == "Hand"                                  ? left
     : entry.section == "View" || entry.section == "Analysis" || entry.section == "Help" ? middle
     : entry.section == "Hand in 3-D"                                                    ? space
                                                                                         : right)
        .push_back(entry);
  space.insert(space.end(), mouseEntries().begin(), mouseEntries().end());
  auto* content = new QWidget(this);
  auto* columns = new QGridLayout(content);
  columns->setContentsMargins(18, 16, 18, 8);
  columns->setHorizontalSpacing(24);
  columns->setVerticalSpacing(12);
  std::vector<QLabel*> words;
  std::vector<QWidget*> parts;
  for (const std::vector<KeyEntry>& entries : {left, middle, right, space})
    parts.push_back(columnOf(entries, words, content));
  const auto arrange = [&](int beside) {
    for (int i = 0; i < static_cast<int>(parts.size()); ++i)
      columns->addWidget(parts[static_cast<std::size_t>(i)], i / beside, i % beside);
  };
  arrange(static_cast<int>(parts.size()));
  auto* scroll = new QScrollArea(this);
  scroll->setWidgetResizable(true);
  scroll->setWidget(content);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  setLayout(inColumn({{scroll, 1}, buttons}, {.right = Space::kWide, .bottom = Space::kWide}));
  // Without a desktop, pictures are taken of windows that are larger than the screen.
  const QWidget& shownOn = parent ? *parent->window() : *this;
  const QSize available = shownOn.screen()->availableSize().expandedTo(shownOn.size());
  const QSize most = QSize(1440, 860).boundedTo(available * kScreenPart);
  const QSize around(40, 80);  // [px]
  // On a narrow screen what the keys do takes more lines; then the columns stand in two rows.
  const auto narrowWords = [&] {
    constexpr int kStep = 10;  // [px]
    for (int widest = kWidestWords; widest >= kNarrowestWords; widest -= kStep) {
      setWidestWords(words, widest);
      if (content->sizeHint().width() + around.width() <= most.width()) return true;
    }
    return false;
  };
  if (!narrowWords()) {
    arrange(2);
    narrowWords();
  }
  resize((content->sizeHint() + around).boundedTo(most));
}

}  // namespace palpate::gui
