// A line inside the window that offers an action: "Recorded run_003.palpate: 412 frames [Open]". It
// blocks nothing and can be closed.
#pragma once

#include <QWidget>
#include <functional>

#include "gui/appearance/theme.h"

class QBoxLayout;
class QHBoxLayout;
class QLabel;
class QPushButton;
class QToolButton;

namespace palpate::gui {

class OfferStrip : public QWidget {
  Q_OBJECT
 public:
  explicit OfferStrip(QWidget* parent = nullptr);
  // Replaces the previous offer. `accept` is called at most once; `decline` (may be empty) is
  // called when the user closes the line without accepting.
  void offer(const QString& text,
             const QString& button,
             std::function<void()> accept,
             std::function<void()> decline = {});
  // Adds a button to the present offer; `action` may be called several times, and the line stays.
  void offerAlso(const QString& button, const QString& tip, std::function<void()> action);
  // Shows only a text, while the accepted action runs.
  void say(const QString& text);
  // Hides the line without calling `decline`.
  void dismiss();
  // Shows the present line in the colours of a warning: something isn't as it should be.
  void warn(bool on);
  QString text() const;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void removeOthers();
  // Beside the text where there is room for it, else below it, so that the window needs no more
  // width for them.
  void placeOthers();

  QLabel* text_;
  QPushButton* accept_;
  QBoxLayout* row_;
  QBoxLayout* below_;
  QHBoxLayout* others_;
  std::function<void()> onAccept_;
  std::function<void()> onDecline_;
};

}  // namespace palpate::gui
