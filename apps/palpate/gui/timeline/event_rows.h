// The rows below the timeline, one for each kind of event; every event is a bar over its span of
// time. A click chooses a bar, its ends can be dragged, a double click renames it; arrow keys go to
// the next one.
#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "gui/appearance/theme.h"
#include "gui/window_state/event_marks.h"

class QLineEdit;

namespace palpate::gui {

class EventRows : public QWidget {
  Q_OBJECT
 public:
  explicit EventRows(QWidget* parent = nullptr);

  // Sets the marks. Rows without a mark aren't shown.
  void setMarks(std::vector<EventMark> marks);
  const std::vector<EventMark>& marks() const noexcept { return marks_; }
  // Sets the scale of time: the visible span [s] and the pixels of its ends in this widget.
  void setScale(double fromS, double toS, int leftPixel, int rightPixel);
  std::optional<std::size_t> chosen() const noexcept { return chosen_; }
  void choose(std::optional<std::size_t> mark);
  // Chooses the next (step 1) or previous (step -1) mark in the row of the chosen one; in the first
  // row if none is chosen.
  void chooseNext(int step);
  // In the row of `lane` (the first row where that has no mark), from a time [s]: the next mark
  // that begins there or later, or the previous one that begins before; none is left as it is. With
  // `beyond` a mark that begins there is passed over.
  void chooseNextFrom(double seconds, int step, std::optional<EventLane> lane, bool beyond = false);
  // Opens an input field over the bar; textChanged() follows when the user presses Enter.
  void editText(std::size_t mark);
  // Rectangle of the bar [px]; empty: not visible. Bars of the same span and row lie beside each
  // other.
  QRectF barOf(std::size_t mark) const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }
  // The height that one row needs [px].
  int heightOfOne() const;

 signals:
  void marksChanged();
  // The user chose a mark by mouse or key.
  void markChosen(std::size_t mark);
  void chosenChanged();
  // Emitted at the end of a drag; the new span [s].
  void spanChanged(std::size_t mark, double fromS, double toS);
  void textChanged(std::size_t mark, const QString& text);
  void removeRequested(std::size_t mark);
  void menuRequested(std::optional<std::size_t> mark, const QPoint& globalPosition);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum class Part { kNone, kBody, kFrom, kTo };
  // The place of a mark among those of the same span in its row.
  struct Share {
    std::size_t index = 0;
    std::size_t count = 1;
    bool operator==(const Share&) const = default;
  };
  int rowHeight() const;
  double pixelOf(double seconds) const;
  // The marks in the row of the chosen one, or in the first row; in order of time.
  std::vector<std::size_t> rowOfChosen() const;
  std::vector<std::size_t> rowOf(std::optional<EventLane> lane) const;
  // The mark of `before`, which was among the marks before they were replaced, or the one that
  // replaced it; `share`: its place then.
  std::optional<std::size_t> indexOf(const EventMark& before, const Share& share) const;
  void arrange();
  std::optional<std::size_t> markAt(const QPointF& at) const;
  // The end of the mark's span that can be taken there; kNone: none.
  Part endAt(std::size_t mark, double x) const;
  Part partAt(std::size_t mark, const QPointF& at) const;
  // What limits the name of a mark that is painted beside its bar.
  struct Neighbours {
    std::optional<double> nextFromS = {};  // of the next mark of its lane
    bool isLast = true;                    // no mark of its lane begins later
  };
  std::vector<Neighbours> neighbours() const;
  void paintMark(QPainter& painter, std::size_t index, const Neighbours& beside) const;
  QColor colorOf(const EventMark& mark) const;

  std::vector<EventMark> marks_;
  std::vector<Share> shares_;  // of each mark
  // The marks in the order in which they are painted: short ones above long ones.
  std::vector<std::size_t> order_;
  // Lanes that have a mark.
  std::vector<EventLane> lanes_;
  double fromS_ = 0.0;
  double toS_ = 1.0;
  int left_ = 0;
  int right_ = 1;
  std::optional<std::size_t> chosen_;
  Part drag_ = Part::kNone;
  double dragFromS_ = 0.0;
  double dragToS_ = 0.0;
  bool dragged_ = false;
  double pressedPixel_ = 0.0;
  QLineEdit* field_ = nullptr;
  // The mark whose text field_ edits.
  std::optional<std::size_t> edited_;
};

}  // namespace palpate::gui
