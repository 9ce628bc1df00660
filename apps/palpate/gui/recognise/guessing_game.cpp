#include "gui/recognise/guessing_game.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "gui/widgets/make.h"

namespace palpate::gui {

GuessingGame::GuessingGame(QWidget* parent) : QWidget(parent) {
  setObjectName("guessingGame");
  words_ = makeLines(this, "gameWords");
  score_ = makeLabel(this, "gameScore", "muted");
  auto* objects = new QHBoxLayout;
  for (int i = 0; i < kMaxObjects; ++i) {
    QPushButton*& button = buttons_[static_cast<std::size_t>(i)];
    button = makeButton(this, "gameObject", "");
    button->setFocusPolicy(Qt::NoFocus);  // has a key instead
    connect(button, &QPushButton::clicked, this, [this, i] { choose(i); });
    objects->addWidget(button, 1);
  }
  setLayout(inColumn({words_, objects, score_}, around(Space::kDialog)));
  hide();
}

void GuessingGame::begin(const QStringList& objects) {
  objects_ = objects.mid(0, kMaxObjects);
  rounds_ = visitor_ = hand_ = 0;
  guess_.clear();
  if (!isPlayed()) return end();
  for (qsizetype i = 0; i < kMaxObjects; ++i) {
    QPushButton* button = buttons_[static_cast<std::size_t>(i)];
    button->setVisible(i < objects_.size());
    if (i >= objects_.size()) continue;
    button->setText(QString::number(i + 1) + "  " + QString(objects_[i]).replace('&', "&&"));
    button->setAccessibleName(objects_[i]);
  }
  setVisible(true);
  show("Guess: which of them is in the hand?");
}

void GuessingGame::end() {
  objects_.clear();
  guess_.clear();
  hide();
  emit changed();
}

void GuessingGame::choose(int object) {
  if (object < 0 || object >= objects_.size()) return;
  const QString name = objects_[object];
  if (guess_.isEmpty()) {
    guess_ = name;
    answer_.clear();
    show("You say " + name + ". What was it really?");
    emit guessed();
    return;
  }
  const bool visitorRight = guess_ == name, handRight = answer_ == name;
  ++rounds_;
  visitor_ += visitorRight ? 1 : 0;
  hand_ += handRight ? 1 : 0;
  const QString right = visitorRight && handRight ? "You and the hand are right."
                        : visitorRight            ? "You are right, the hand isn't."
                        : handRight               ? "The hand is right, you aren't."
                                                  : "Neither you nor the hand is right.";
  guess_.clear();
  show("It was " + name + ". " + right + " Guess the next one.");
}

QString GuessingGame::score() const {
  return "hand " + QString::number(hand_) + " · you " + QString::number(visitor_) + " · of " +
         QString::number(rounds_);
}

void GuessingGame::show(const QString& words) {
  words_->setText(words);
  score_->setText(score());
  emit changed();
}

}  // namespace palpate::gui
