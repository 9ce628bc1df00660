// A scroll area that is as large as its content whenever there is room, and scrolls only where
// there is less room than the content needs.
#pragma once

#include <QScrollArea>

namespace palpate::gui {

// The least size of the content of most docks [px].
inline constexpr QSize kMinDockContent(220, 90);

class ContentScroll : public QScrollArea {
  Q_OBJECT
 public:
  // Takes `content`. `least`: the smallest size of the area [px]; a side of 0: that side doesn't
  // scroll, the area is never smaller than its content there.
  ContentScroll(QWidget* content, QSize least, QWidget* parent = nullptr);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QSize least_;
};

}  // namespace palpate::gui
