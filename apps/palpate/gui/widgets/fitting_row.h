// A row of controls that hides some of them while it is too narrow for all, so that none is cut
// off.
#pragma once

#include <QList>
#include <QWidget>

class QHBoxLayout;

namespace palpate::gui {

class FittingRow : public QWidget {
  Q_OBJECT
 public:
  explicit FittingRow(QWidget* parent = nullptr);

  // The row's layout, to which the owner adds its controls.
  QHBoxLayout& row() noexcept { return *row_; }
  // The controls that may be hidden, the one that is hidden first at the beginning. What they do
  // must be reachable in another way, too (a menu, a key). The row alone shows and hides them.
  void setOptional(QList<QWidget*> controls);
  // Hides and shows controls for the width that the row has; to be called when the size of a
  // control has changed. Called at each resize.
  void fit();

  // Without the optional controls.
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  // Width of the row [px] with all controls that aren't hidden by their owner, or without the
  // optional ones.
  int neededWidth(bool withOptional) const;

  QHBoxLayout* row_;
  QList<QWidget*> optional_;
};

}  // namespace palpate::gui
