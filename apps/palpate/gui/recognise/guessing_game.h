// The guessing game of the show: a visitor guesses which of up to three taught objects the hand
// holds, then the hand says its name, and somebody says what it was. The answer of the hand is
// hidden until the visitor has guessed.
#pragma once

#include <QStringList>
#include <QWidget>
#include <array>

class QLabel;
class QPushButton;

namespace palpate::gui {

class GuessingGame : public QWidget {
  Q_OBJECT
 public:
  static constexpr int kMaxObjects = 3;

  explicit GuessingGame(QWidget* parent = nullptr);

  // Begins anew, with the first three of these objects; with fewer than two it ends.
  void begin(const QStringList& objects);
  void end();
  bool isPlayed() const noexcept { return objects_.size() > 1; }
  bool hidesAnswer() const noexcept { return isPlayed() && guess_.isEmpty(); }
  // The name that the hand gives now; empty: none. What it said after the guess stays its answer
  // when the object is taken out.
  void setAnswer(const QString& name) {
    if (!guess_.isEmpty() && !name.isEmpty()) answer_ = name;
  }
  // The visitor's guess, or else what it was; an object that doesn't exist is ignored.
  void choose(int object);
  // "hand 2 · you 1 · of 3"
  QString score() const;

 signals:
  // The visitor has guessed: the hand is to be asked.
  void guessed();
  // Whether the answer is hidden has changed.
  void changed();

 private:
  void show(const QString& words);

  QStringList objects_;
  QString guess_;   // empty: not yet
  QString answer_;  // of the hand
  int rounds_ = 0, visitor_ = 0, hand_ = 0;
  QLabel* words_;
  QLabel* score_;
  std::array<QPushButton*, kMaxObjects> buttons_;
};

}  // namespace palpate::gui
