#include "gui/timeline/timeline_header.h"

#include <QComboBox>
#include <QEvent>
#include <QLabel>
#include <QPainter>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "gui/chart/chart_style.h"
#include "gui/widgets/make.h"
#include "gui/widgets/signal_box.h"

namespace palpate::gui {
namespace {

constexpr int kTimelineHeaderStroke = 18;  // [px] length of a stroke
constexpr int kAfterStroke = 6;            // [px]
constexpr int kAfterName = 16;             // [px]
constexpr int kMaxLegendLines = 2;

}  // namespace

Legend::Legend(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  // Lets mouse events pass, so that the title row can be dragged.
  setAttribute(Qt::WA_TransparentForMouseEvents);
}

void Legend::setEntries(std::vector<Entry> entries) {
  entries_ = std::move(entries);
  fit();
  updateGeometry();
  update();
}

QSize Legend::sizeHint() const {
  int width = 0;
  for (const Entry& entry : entries_)
    width += kTimelineHeaderStroke + kAfterStroke + fontMetrics().horizontalAdvance(entry.name) +
             kAfterName;
  return {width, lines_ * fontMetrics().height() + 2};
}

std::vector<QPoint> Legend::places(int roomPx) const {
  std::vector<QPoint> places;
  const int more = fontMetrics().horizontalAdvance("…");
  QPoint at;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const int needed =
        kTimelineHeaderStroke + kAfterStroke + fontMetrics().horizontalAdvance(entries_[i].name);
    if (at.x() > 0 && at.y() + 1 < kMaxLegendLines && at.x() + needed > roomPx)
      at = {0, at.y() + 1};
    // The dots need room on the last line if something follows that has none.
    const bool last = at.y() + 1 == kMaxLegendLines;
    const int reserved = last && i + 1 < entries_.size() ? more + kAfterName : 0;
    if (at.x() + needed > roomPx - reserved && (last || at.x() == 0)) break;
    places.push_back(at);
    at.rx() += needed + kAfterName;
  }
  return places;
}

bool Legend::isCut() const { return places(width()).size() < entries_.size(); }

void Legend::fit() {
  const std::vector<QPoint> at = places(width());
  int lines = at.empty() ? 1 : at.back().y() + 1;
  if (at.size() < entries_.size()) lines = std::max(lines, dotsPlace().y() + 1);
  if (lines == std::exchange(lines_, lines)) return;
  updateGeometry();
}

// Behind the last name or, where there is too little room, on the next line.
QPoint Legend::dotsPlace() const {
  const std::vector<QPoint> at = places(width());
  if (at.empty()) return {};
  const int end = at.back().x() + kTimelineHeaderStroke + kAfterStroke +
                  fontMetrics().horizontalAdvance(entries_[at.size() - 1].name) + kAfterName;
  const bool fits = end + fontMetrics().horizontalAdvance("…") <= width();
  if (!fits && at.back().y() + 1 < kMaxLegendLines) return {0, at.back().y() + 1};
  return {end, at.back().y()};
}

QRect Legend::dotsRect() const {
  if (!isCut()) return {};
  const int line = fontMetrics().height();
  const QPoint at = dotsPlace();
  return {at.x(),
          (height() - lines_ * line) / 2 + at.y() * line,
          fontMetrics().horizontalAdvance("…"),
          line};
}

void Legend::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fit();
}

void Legend::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) fit();
}

void Legend::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const std::vector<QPoint> at = places(width());
  const int line = fontMetrics().height();
  const int top = (height() - lines_ * line) / 2;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Entry& entry = entries_[i];
    const int nameWidth = fontMetrics().horizontalAdvance(entry.name);
    const int y = top + at[i].y() * line;
    int x = at[i].x();
    QPen pen = entry.pen;
    pen.setWidthF(3.0);
    pen.setCapStyle(Qt::FlatCap);
    painter.setPen(legendPen(pen, kTimelineHeaderStroke));
    painter.drawLine(x, y + line / 2, x + kTimelineHeaderStroke, y + line / 2);
    x += kTimelineHeaderStroke + kAfterStroke;
    painter.setPen(colorsOf().text);
    painter.drawText(QRect(x, y, nameWidth + 2, line), Qt::AlignVCenter, entry.name);
  }
  if (at.size() == entries_.size()) return;
  painter.setPen(colorsOf().muted);
  painter.drawText(dotsRect(), Qt::AlignVCenter | Qt::TextDontClip, "…");
}

TimelineHeader::TimelineHeader(const Actions& actions, QWidget* parent) : QWidget(parent) {
  signal_ = named(new QComboBox(this), "signalBox");
  signal_->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
  signal_->setToolTip("What is plotted of each ticked matrix");
  offerSignals(*signal_, false);
  curves_ = makeToolButton(this, "curvesButton", "Curves");
  curves_->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
  curves_->setToolTip("Taxels, joint angles, temperatures and forces in the timeline");
  legend_ = new Legend(this);
  reading_ = makeLabel(this, "readingWords");
  reading_->hide();
  selection_ = named(new QWidget(this), "selectionStrip");
  selectionWords_ = makeLabel(selection_, "selectionWords");
  auto* strip = inRow({selectionWords_, Space::kNarrow}, Space::kNarrow);
  selection_->setLayout(strip);
  const auto buttonFor = [](QAction* action, QWidget* of) {
    auto* button = new QToolButton(of);
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    button->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
    return button;
  };
  for (QAction* action : actions.ofSelection) {
    QToolButton* button = buttonFor(action, selection_);
    strip->addWidget(button);
    if (!actions.ofCursors.contains(action)) ofRecording_.append(button);
  }
  selection_->hide();
  auto* row = inRow({signal_, curves_, Space::kUsual, {legend_, 1}, reading_, selection_});
  setLayout(row);
  for (QAction* action : actions.ofLive) {
    ofLive_.append(buttonFor(action, this));
    ofLive_.last()->hide();
    row->addWidget(ofLive_.last());
  }
  connect(signal_, &QComboBox::activated, this, [this](int index) {
    emit signalChosen(kAllPlottedSignals[static_cast<std::size_t>(index)]);
  });
  connect(curves_, &QToolButton::clicked, this, &TimelineHeader::curvesRequested);
}

void TimelineHeader::setSignal(PlottedSignal signal) { signal_->setCurrentText(nameOf(signal)); }

void TimelineHeader::setComponents(bool offered) { offerSignals(*signal_, offered); }

void TimelineHeader::setCurves(const std::vector<PlottedCurve>& curves) {
  std::vector<Legend::Entry> entries;
  for (const PlottedCurve& curve : curves) entries.push_back({curve.pen, curve.name});
  legend_->setEntries(std::move(entries));
}

void TimelineHeader::setSelection(const QString& words) {
  selectionWords_->setText(words);
  selection_->setVisible(!words.isEmpty());
}

void TimelineHeader::setReading(const QString& words) {
  reading_->setText(words);
  reading_->setVisible(!words.isEmpty());
}

void TimelineHeader::setLive(bool live) {
  for (QToolButton* button : ofRecording_) button->setVisible(!live);
  for (QToolButton* button : ofLive_) button->setVisible(live);
  if (live) reading_->hide();
}

}  // namespace palpate::gui
