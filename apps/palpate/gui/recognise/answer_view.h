// The widget that shows an answer of recognition, scaled to its size.
#pragma once

#include <QWidget>

#include "gui/picture/stale_notice.h"
#include "gui/recognise/object_photo.h"
#include "gui/recognise/recognition_answer.h"

namespace palpate::gui {

class AnswerView : public QWidget {
  Q_OBJECT
 public:
  // `scale`: text size relative to the window's; 0: as large as fits with all of its lines.
  AnswerView(PhotoCache& photos, double scale, QWidget* parent = nullptr);
  void setAnswer(const RecognitionAnswer& answer);
  const RecognitionAnswer& answer() const noexcept { return answer_; }
  // Greys the answer, with the reason why it isn't of now; empty: it is current.
  void setStale(const QString& reason);
  const QString& stale() const noexcept { return stale_.notice; }
  // Height of plain text [px] with which the answer is painted now.
  double textHeight() const;
  QSize sizeHint() const override { return {380, 300}; }
  QSize minimumSizeHint() const override { return {220, 180}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  const QPixmap& photo() const;
  // The height that all lines need with this height of text [px].
  double neededHeight(double unit) const;
  // Text of a given size is never cut: the view asks for the height of all lines.
  void askForHeight();
  void renewAccessibleName();

  PhotoCache& photos_;
  const double scale_;
  RecognitionAnswer answer_;
  StaleNotice stale_;
};

}  // namespace palpate::gui
