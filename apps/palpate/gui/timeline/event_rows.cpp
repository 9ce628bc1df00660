#include "gui/timeline/event_rows.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <palpate/core/time.h>

#include "gui/widgets/keep_keys.h"

namespace palpate::gui {
namespace {

// QLineEdit leaves Return to its parent as well, where it would begin the next input.
class EventTextField : public QLineEdit {
 public:
  using QLineEdit::QLineEdit;

 protected:
  void keyPressEvent(QKeyEvent* event) override {
    QLineEdit::keyPressEvent(event);
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) event->accept();
  }
};

constexpr int kAboveText = 3;          // [px] above and below the text of a row
constexpr double kEventRowsGap = 2.0;  // [px] between rows
// Minimum width of a bar [px], also that of a moment.
constexpr double kMinBar = 3.0;
// Distance from an end at which the mouse still takes it [px].
constexpr double kReach = 5.0;
constexpr double kTextRoom = 4.0;   // [px] before a text
constexpr int kFieldWidth = 180;    // [px]
constexpr int kLongestText = 2000;  // [characters]
// Longest name beside a short bar [px].
constexpr int kMaxTextLength = 300;

// Row and span of a mark; to the microsecond, as they are stored.
using EventRowsSpan = std::tuple<EventLane, long long, long long>;
EventRowsSpan eventRowsSpanOf(const EventMark& mark) {
  return {mark.lane, std::llround(mark.fromS * kUsPerS), std::llround(mark.toS * kUsPerS)};
}

}  // namespace

EventRows::EventRows(QWidget* parent) : QWidget(parent) {
  setObjectName("eventRows");
  setMouseTracking(true);
  // A click chooses an event and leaves the arrow keys to the playback; Tab and F7 bring them here.
  setFocusPolicy(Qt::TabFocus);
  setAccessibleName("Events of the recording");
  // While this widget has the focus, arrow keys go from event to event, not from frame to frame.
  keepKeys(*this, {Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down, Qt::Key_Delete});
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

int EventRows::rowHeight() const { return fontMetrics().height() + 2 * kAboveText; }

QSize EventRows::sizeHint() const {
  const auto rows = static_cast<int>(lanes_.size());
  return {200, rows == 0 ? 0 : rows * rowHeight() + kAboveText};
}

int EventRows::heightOfOne() const { return rowHeight() + kAboveText; }

void EventRows::setMarks(std::vector<EventMark> marks) {
  const std::vector<EventMark> before = std::exchange(marks_, std::move(marks));
  const std::vector<Share> shares = shares_;
  lanes_.clear();
  for (const EventLane lane : kAllEventLanes)
    if (std::any_of(marks_.begin(), marks_.end(), [&](const auto& m) { return m.lane == lane; }))
      lanes_.push_back(lane);
  drag_ = Part::kNone;
  arrange();
  const auto again = [&](std::optional<std::size_t> index) {
    return index && *index < before.size() ? indexOf(before[*index], shares[*index]) : std::nullopt;
  };
  chosen_ = again(chosen_);
  edited_ = again(edited_);
  if (field_ && !edited_) field_->hide();
  setVisible(!lanes_.empty());
  updateGeometry();
  update();
  emit marksChanged();
}

std::optional<std::size_t> EventRows::indexOf(const EventMark& before, const Share& share) const {
  std::optional<std::size_t> named;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    // Also one with another text: it was renamed.
    if (shares_[i] == share && eventRowsSpanOf(marks_[i]) == eventRowsSpanOf(before)) return i;
    const EventMark& mark = marks_[i];
    const bool near = std::abs(mark.fromS - before.fromS) + std::abs(mark.toS - before.toS) < 1e-3;
    if (!named && near && mark.lane == before.lane && mark.text == before.text) named = i;
  }
  // One that was removed isn't replaced by another of its span.
  return named;
}

void EventRows::arrange() {
  std::map<EventRowsSpan, std::vector<std::size_t>> spans;
  for (std::size_t i = 0; i < marks_.size(); ++i) spans[eventRowsSpanOf(marks_[i])].push_back(i);
  shares_.assign(marks_.size(), {});
  for (const auto& [span, same] : spans)
    for (std::size_t i = 0; i < same.size(); ++i) shares_[same[i]] = {i, same.size()};
  order_.resize(marks_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return marks_[a].toS - marks_[a].fromS > marks_[b].toS - marks_[b].fromS;
  });
}

void EventRows::setScale(double fromS, double toS, int leftPixel, int rightPixel) {
  fromS_ = fromS;
  toS_ = std::max(toS, fromS + 1e-9);
  left_ = leftPixel;
  right_ = std::max(rightPixel, leftPixel + 1);
  update();
}

double EventRows::pixelOf(double seconds) const {
  return left_ + (seconds - fromS_) / (toS_ - fromS_) * (right_ - left_);
}

QRectF EventRows::barOf(std::size_t index) const {
  const EventMark& mark = marks_[index];
  const bool dragged = drag_ != Part::kNone && chosen_ == index && dragged_;
  double from = pixelOf(dragged ? dragFromS_ : mark.fromS);
  double to = std::max(pixelOf(dragged ? dragToS_ : mark.toS), from + kMinBar);
  if (const auto [place, count] = shares_[index]; count > 1 && !dragged) {
    // Each has a share of what is visible.
    if (from < right_ && to > left_) {
      from = std::max<double>(from, left_);
      to = std::min<double>(to, right_);
    }
    const double width = std::max((to - from) / static_cast<double>(count), kMinBar + 1.0);
    const double all = static_cast<double>(count) * width;
    // Moments at the right border lie before it.
    if (all > to - from && from <= right_) from = std::min(from, right_ - all);
    from += static_cast<double>(place) * width;
    to = from + width - 1.0;
  }
  if (to < left_ || from > right_) return {};
  const auto row = std::find(lanes_.begin(), lanes_.end(), mark.lane) - lanes_.begin();
  // A mark at the end is as wide as one elsewhere.
  const double x0 = std::max<double>(std::min<double>(from, right_ - kMinBar), left_);
  const double x1 = std::min<double>(to, right_);
  return {x0,
          static_cast<double>(row) * rowHeight() + kEventRowsGap,
          std::max(x1 - x0, 1.0),
          rowHeight() - kEventRowsGap};
}

QColor EventRows::colorOf(const EventMark& mark) const {
  const ThemeColors& colors = colorsOf();
  switch (mark.lane) {
    case EventLane::kGrasps:
      return matrixColor(0);
    case EventLane::kSteps:
      return matrixColor(3);
    case EventLane::kSlips:
      return colors.danger;
    case EventLane::kGaps:
      return colors.warning;
    case EventLane::kLabels:
      return matrixColor(5);
    case EventLane::kNotes:
      return matrixColor(2);
    case EventLane::kOthers:
      break;
  }
  return colors.muted;
}

std::vector<EventRows::Neighbours> EventRows::neighbours() const {
  std::vector<std::size_t> order(marks_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Also of the same moment.
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(marks_[a].lane, marks_[a].fromS) < std::pair(marks_[b].lane, marks_[b].fromS);
  });
  std::vector<Neighbours> found(marks_.size());
  for (std::size_t i = order.size(); i-- > 1;) {
    const EventMark& mark = marks_[order[i - 1]];
    const EventMark& next = marks_[order[i]];
    if (mark.lane != next.lane) continue;
    found[order[i - 1]] = {next.fromS, found[order[i]].isLast && next.fromS == mark.fromS};
  }
  return found;
}

void EventRows::paintMark(QPainter& painter, std::size_t index, const Neighbours& beside) const {
  const QRectF bar = barOf(index);
  if (bar.isEmpty()) return;
  const EventMark& mark = marks_[index];
  const bool now = chosen_ == index;
  QColor fill = colorOf(mark);
  fill.setAlphaF(now ? 0.75F : 0.38F);
  painter.setPen(now ? QPen(colorsOf().text, 1.2) : QPen(colorOf(mark), 1.0));
  painter.setBrush(fill);
  painter.drawRoundedRect(bar.adjusted(0.5, 0.5, -0.5, -0.5), 2.0, 2.0);
  painter.setPen(colorsOf().text);
  const double textWidth = fontMetrics().horizontalAdvance(mark.text);
  if (mark.toS > mark.fromS && textWidth + 2 <= bar.width()) {
    painter.drawText(bar, Qt::AlignCenter, mark.text);
    return;
  }
  if (mark.lane == EventLane::kGrasps || mark.lane == EventLane::kSteps ||
      mark.lane == EventLane::kSlips || mark.lane == EventLane::kGaps)
    return;
  // A name that doesn't fit into its bar is painted after it, up to the next bar.
  double room = std::min<double>(right_ - bar.right(), kMaxTextLength) - kTextRoom;
  if (beside.nextFromS)
    room = std::min(room, pixelOf(*beside.nextFromS) - bar.right() - 2 * kTextRoom);
  const int narrowest = fontMetrics().averageCharWidth() * 3;
  const auto drawAt = [&](double x, double width, Qt::Alignment side) {
    painter.drawText(QRectF(x, bar.top(), width, bar.height()),
                     Qt::AlignVCenter | side,
                     fontMetrics().elidedText(mark.text, Qt::ElideRight, static_cast<int>(width)));
  };
  if (room >= narrowest) return drawAt(bar.right() + kTextRoom, room, Qt::AlignLeft);
  // At the right border, where nothing follows, it is painted before the bar.
  if (!beside.isLast) return;
  double before = std::min<double>(bar.left() - left_, kMaxTextLength) - kTextRoom;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    if (marks_[i].lane != mark.lane || i == index) continue;
    before = std::min(before, bar.left() - barOf(i).right() - 2 * kTextRoom);
  }
  if (before >= narrowest) drawAt(bar.left() - kTextRoom - before, before, Qt::AlignRight);
}

void EventRows::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const ThemeColors& colors = colorsOf();
  painter.fillRect(rect(), colors.window);
  for (std::size_t row = 0; row < lanes_.size(); ++row) {
    const QRectF lane(left_,
                      static_cast<double>(row) * rowHeight() + kEventRowsGap,
                      right_ - left_,
                      rowHeight() - kEventRowsGap);
    painter.fillRect(lane, colors.panel);
    painter.setPen(colors.muted);
    painter.drawText(QRectF(0, lane.top(), left_ - 6, lane.height()),
                     Qt::AlignRight | Qt::AlignVCenter,
                     nameOf(lanes_[row]));
  }
  painter.setClipRect(QRect(left_, 0, right_ - left_, height()));
  const std::vector<Neighbours> beside = neighbours();
  for (const std::size_t i : order_) paintMark(painter, i, beside[i]);
  if (!hasFocus()) return;
  painter.setClipping(false);
  painter.setPen(QPen(colors.accent, 1.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(QRectF(left_, 0.5, right_ - left_, height() - 1.0));
}

std::optional<std::size_t> EventRows::markAt(const QPointF& at) const {
  // The mark painted last is on top, but the ends of the chosen one take precedence over all
  // others. An end of its span may lie in the bar of another one of this span.
  if (chosen_ && *chosen_ < marks_.size()) {
    const QRectF bar = barOf(*chosen_);
    const bool inRow = at.y() >= bar.top() && at.y() < bar.bottom();
    if (bar.adjusted(-kReach, 0, kReach, 0).contains(at) ||
        (inRow && endAt(*chosen_, at.x()) != Part::kNone))
      return chosen_;
  }
  // Bars beside each other are told exactly; around them there is a pixel more.
  for (const double around : {0.0, 1.0})
    for (auto i = order_.rbegin(); i != order_.rend(); ++i)
      if (barOf(*i).adjusted(-around, 0, around, 0).contains(at)) return *i;
  return std::nullopt;
}

EventRows::Part EventRows::endAt(std::size_t index, double x) const {
  const EventMark& mark = marks_[index];
  const double from = std::abs(x - pixelOf(mark.fromS));
  const double to = std::abs(x - pixelOf(mark.toS));
  if (!mark.editable || std::min(from, to) > kReach ||
      pixelOf(mark.toS) - pixelOf(mark.fromS) < 2.0)
    return Part::kNone;
  return from < to ? Part::kFrom : Part::kTo;
}

EventRows::Part EventRows::partAt(std::size_t index, const QPointF& at) const {
  const Part end = chosen_ == index ? endAt(index, at.x()) : Part::kNone;
  return end == Part::kNone ? Part::kBody : end;
}

void EventRows::choose(std::optional<std::size_t> mark) {
  if (mark && *mark >= marks_.size()) mark.reset();
  if (mark == chosen_) return;
  chosen_ = mark;
  update();
  emit chosenChanged();
}

void EventRows::chooseNext(int step) {
  if (marks_.empty()) return;
  const std::vector<std::size_t> row = rowOfChosen();
  std::ptrdiff_t at = step > 0 ? -1 : static_cast<std::ptrdiff_t>(row.size());
  for (std::size_t i = 0; i < row.size(); ++i)
    if (chosen_ == row[i]) at = static_cast<std::ptrdiff_t>(i);
  at = std::clamp<std::ptrdiff_t>(at + step, 0, static_cast<std::ptrdiff_t>(row.size()) - 1);
  choose(row[static_cast<std::size_t>(at)]);
  emit markChosen(*chosen_);
}

void EventRows::chooseNextFrom(double seconds,
                               int step,
                               std::optional<EventLane> lane,
                               bool beyond) {
  constexpr double kSameS = 0.001;
  const double afterS = beyond ? seconds + kSameS : seconds - kSameS;
  std::optional<std::size_t> next;
  for (const std::size_t i : rowOf(lane)) {
    if (step > 0 && !next && marks_[i].fromS > afterS) next = i;
    if (step < 0 && marks_[i].fromS < seconds - kSameS) next = i;
  }
  if (!next) return;
  choose(next);
  emit markChosen(*next);
}

std::vector<std::size_t> EventRows::rowOfChosen() const {
  const bool any = chosen_ && *chosen_ < marks_.size();
  return rowOf(any ? std::optional(marks_[*chosen_].lane) : std::nullopt);
}

std::vector<std::size_t> EventRows::rowOf(std::optional<EventLane> lane) const {
  std::vector<std::size_t> row;
  if (marks_.empty()) return row;
  const bool there = lane && std::find(lanes_.begin(), lanes_.end(), *lane) != lanes_.end();
  const EventLane of = there ? *lane : marks_.front().lane;
  for (std::size_t i = 0; i < marks_.size(); ++i)
    if (marks_[i].lane == of) row.push_back(i);
  return row;
}

void EventRows::mousePressEvent(QMouseEvent* event) {
  const auto mark = markAt(event->position());
  if (event->button() != Qt::LeftButton) return;
  pressedPixel_ = event->position().x();
  dragged_ = false;
  if (!mark) return choose(std::nullopt);
  drag_ = partAt(*mark, event->position());
  dragFromS_ = marks_[*mark].fromS;
  dragToS_ = marks_[*mark].toS;
  choose(mark);
  emit markChosen(*mark);
}

void EventRows::mouseMoveEvent(QMouseEvent* event) {
  if (drag_ == Part::kNone || !chosen_) {
    const auto mark = markAt(event->position());
    const Part part = mark ? partAt(*mark, event->position()) : Part::kNone;
    setCursor(part == Part::kFrom || part == Part::kTo ? Qt::SizeHorCursor : Qt::ArrowCursor);
    return;
  }
  if (!marks_[*chosen_].editable) return;
  const double moved = event->position().x() - pressedPixel_;
  if (!dragged_ && std::abs(moved) < QApplication::startDragDistance()) return;
  dragged_ = true;
  const double byS = moved / (right_ - left_) * (toS_ - fromS_);
  const EventMark& mark = marks_[*chosen_];
  dragFromS_ = drag_ == Part::kTo ? mark.fromS : mark.fromS + byS;
  dragToS_ = drag_ == Part::kFrom ? mark.toS : mark.toS + byS;
  if (dragFromS_ > dragToS_) std::swap(dragFromS_, dragToS_);
  update();
}

void EventRows::mouseReleaseEvent(QMouseEvent*) {
  const bool moved = drag_ != Part::kNone && dragged_ && chosen_;
  drag_ = Part::kNone;
  if (moved) emit spanChanged(*chosen_, dragFromS_, dragToS_);
  update();
}

void EventRows::mouseDoubleClickEvent(QMouseEvent* event) {
  drag_ = Part::kNone;
  if (const auto mark = markAt(event->position())) editText(*mark);
}

void EventRows::contextMenuEvent(QContextMenuEvent* event) {
  const auto mark = markAt(event->pos());
  if (mark) choose(mark);
  emit menuRequested(mark, event->globalPos());
}

void EventRows::editText(std::size_t index) {
  if (index >= marks_.size() || !marks_[index].editable) return;
  if (!field_) {
    field_ = new EventTextField(this);
    field_->setObjectName("eventText");
    field_->setMaxLength(kLongestText);
    connect(field_, &QLineEdit::returnPressed, this, [this] {
      const QString text = field_->text().simplified();
      field_->hide();
      setFocus();
      if (edited_ && text != marks_[*edited_].text) emit textChanged(*edited_, text);
    });
    connect(field_, &QLineEdit::editingFinished, field_, &QWidget::hide);
  }
  edited_ = index;
  const QRectF bar = barOf(index);
  const double width = std::max<double>(kFieldWidth, bar.width());
  const double x = std::clamp<double>(
      bar.isEmpty() ? left_ : bar.left(), left_, std::max(left_, right_ - static_cast<int>(width)));
  field_->setGeometry(QRectF(x, bar.top(), width, rowHeight()).toRect());
  field_->setText(marks_[index].text);
  field_->selectAll();
  field_->show();
  field_->setFocus();
}

void EventRows::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return chooseNext(-1);
    case Qt::Key_Right:
      return chooseNext(1);
    case Qt::Key_Up:
    case Qt::Key_Down: {
      if (lanes_.empty()) return;
      const EventLane lane = chosen_ ? marks_[*chosen_].lane : lanes_.front();
      auto row = std::find(lanes_.begin(), lanes_.end(), lane) - lanes_.begin();
      row = std::clamp<std::ptrdiff_t>(row + (event->key() == Qt::Key_Down ? 1 : -1),
                                       0,
                                       static_cast<std::ptrdiff_t>(lanes_.size()) - 1);
      const auto first = std::find_if(marks_.begin(), marks_.end(), [&](const EventMark& mark) {
        return mark.lane == lanes_[static_cast<std::size_t>(row)];
      });
      choose(static_cast<std::size_t>(first - marks_.begin()));
      emit markChosen(*chosen_);
      return;
    }
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_F2:
      if (chosen_) editText(*chosen_);
      return;
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      if (chosen_ && marks_[*chosen_].editable) emit removeRequested(*chosen_);
      return;
    default:
      return QWidget::keyPressEvent(event);
  }
}

void EventRows::focusInEvent(QFocusEvent* event) {
  QWidget::focusInEvent(event);
  update();
}

void EventRows::focusOutEvent(QFocusEvent* event) {
  QWidget::focusOutEvent(event);
  update();
}

bool EventRows::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const auto mark = markAt(help->pos());
    QToolTip::showText(help->globalPos(), mark ? marks_[*mark].detail : QString(), this);
    return true;
  }
  return QWidget::event(event);
}

}  // namespace palpate::gui
