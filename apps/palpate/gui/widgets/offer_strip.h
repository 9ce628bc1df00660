// A calm line inside the window that offers something: "Recorded run_003.palpate: 412 frames
// [Open]". It blocks nothing and can be closed.
#pragma once

#include <QWidget>
#include <functional>

#include "gui/appearance/theme.h"

class QLabel;
class QPushButton;
class QToolButton;

namespace palpate::gui {

class OfferStrip : public QWidget {
  Q_OBJECT
 public:
  explicit OfferStrip(QWidget* parent = nullptr);
  // Replaces what was offered before. `accept` is called once; `decline` (may be empty) when the
  // line is closed by its button without it.
  void offer(const QString& text,
             const QString& button,
             std::function<void()> accept,
             std::function<void()> decline = {});
  // Text alone, while something that was accepted is done.
  void say(const QString& text);
  void dismiss();  // without declining
  QString text() const;
  void setTheme(Theme theme);

 private:
  QLabel* text_;
  QPushButton* accept_;
  QToolButton* close_;
  std::function<void()> onAccept_;
  std::function<void()> onDecline_;
};

}  // namespace palpate::gui
