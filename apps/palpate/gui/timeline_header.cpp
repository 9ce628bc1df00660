#include "gui/timeline_header.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QPainter>

namespace palpate::gui {
namespace {

constexpr int kSwatch = 10;      // [px] side of a square of colour
constexpr int kAfterSwatch = 6;  // [px]
constexpr int kAfterName = 16;   // [px]

}  // namespace

Legend::Legend(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  setAttribute(Qt::WA_TransparentForMouseEvents);  // the title row is there to be dragged
}

void Legend::setEntries(std::vector<Entry> entries, Theme theme) {
  entries_ = std::move(entries);
  theme_ = theme;
  updateGeometry();
  update();
}

QSize Legend::sizeHint() const {
  int width = 0;
  for (const Entry& entry : entries_)
    width += kSwatch + kAfterSwatch + fontMetrics().horizontalAdvance(entry.name) + kAfterName;
  return {width, fontMetrics().height() + 2};
}

void Legend::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  int x = 0;
  for (const Entry& entry : entries_) {
    const int nameWidth = fontMetrics().horizontalAdvance(entry.name);
    if (x + kSwatch + kAfterSwatch + nameWidth > width()) {
      painter.setPen(colorsOf(theme_).muted);
      painter.drawText(QRect(x, 0, width() - x, height()), Qt::AlignVCenter, "…");
      return;
    }
    painter.fillRect(QRect(x, (height() - kSwatch) / 2, kSwatch, kSwatch), entry.color);
    x += kSwatch + kAfterSwatch;
    painter.setPen(colorsOf(theme_).text);
    painter.drawText(QRect(x, 0, nameWidth + 2, height()), Qt::AlignVCenter, entry.name);
    x += nameWidth + kAfterName;
  }
}

TimelineHeader::TimelineHeader(QWidget* parent) : QWidget(parent) {
  signal_ = new QComboBox(this);
  signal_->setObjectName("signalBox");
  signal_->setFocusPolicy(Qt::NoFocus);  // it has a key
  signal_->setToolTip("What is plotted of each ticked matrix (S)");
  for (const PlottedSignal signal : kAllPlottedSignals) signal_->addItem(nameOf(signal));
  legend_ = new Legend(this);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(14);
  row->addWidget(signal_);
  row->addWidget(legend_, 1);
  connect(signal_, &QComboBox::activated, this, [this](int index) {
    emit signalChosen(kAllPlottedSignals[static_cast<std::size_t>(index)]);
  });
}

void TimelineHeader::setSignal(PlottedSignal signal) { signal_->setCurrentText(nameOf(signal)); }

void TimelineHeader::setPlotted(const HandDescription& hand,
                                const std::vector<bool>& plotted,
                                Theme theme) {
  std::vector<Legend::Entry> entries;
  for (std::size_t row = 0; row < plotted.size(); ++row) {
    if (!plotted[row]) continue;
    if (row + 1 == plotted.size())
      entries.push_back({wholeColor(theme), "all"});
    else
      entries.push_back({matrixColor(row, theme), QString::fromStdString(hand.matrixName(row))});
  }
  legend_->setEntries(std::move(entries), theme);
}

}  // namespace palpate::gui
