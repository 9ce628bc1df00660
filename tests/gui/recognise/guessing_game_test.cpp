#include "gui/recognise/guessing_game.h"

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "testing/testing.h"

namespace palpate::gui::guessing_game_test {
namespace {

QString wordsOf(const GuessingGame& game) { return game.findChild<QLabel*>("gameWords")->text(); }

TEST(GuessingGame, CountsWhoIsRight) {
  GuessingGame game;
  QSignalSpy guessed(&game, &GuessingGame::guessed);
  EXPECT_FALSE(game.isPlayed());
  EXPECT_FALSE(game.hidesAnswer());
  game.begin({"ball", "pen", "bottle", "box"});
  EXPECT_TRUE(game.hidesAnswer());
  game.choose(3);
  EXPECT_TRUE(game.hidesAnswer()) << "there are three objects";
  // The guess, and then what it was: the columns are guess, answer of the hand, truth.
  const std::array<int, 3> table[] = {{0, 1, 1}, {1, 1, 1}, {2, 0, 2}, {0, 0, 1}};
  const QStringList names = {"ball", "pen", "bottle"};
  const QStringList scores = {"hand 1 · you 0 · of 1",
                              "hand 2 · you 1 · of 2",
                              "hand 2 · you 2 · of 3",
                              "hand 2 · you 2 · of 4"};
  for (int round = 0; round < 4; ++round) {
    const auto& [guess, answer, truth] = table[round];
    game.choose(guess);
    EXPECT_EQ(guessed.count(), round + 1);
    EXPECT_FALSE(game.hidesAnswer());
    EXPECT_TRUE(wordsOf(game).contains(names[guess]));
    game.setAnswer(names[answer]);
    game.setAnswer({});  // the object is taken out
    game.choose(truth);
    EXPECT_TRUE(game.hidesAnswer()) << "the next round";
    EXPECT_TRUE(wordsOf(game).contains("It was " + names[truth])) << wordsOf(game).toStdString();
    EXPECT_EQ(game.score(), scores[round]);
  }
  game.begin({"ball", "pen"});
  EXPECT_EQ(game.score(), "hand 0 · you 0 · of 0");
}

TEST(GuessingGame, AHandWithoutAnAnswerIsNotRight) {
  GuessingGame game;
  game.begin({"ball", "pen"});
  game.setAnswer("ball");  // before the guess
  game.choose(0);
  game.choose(0);
  EXPECT_EQ(game.score(), "hand 0 · you 1 · of 1");
}

TEST(GuessingGame, NeedsTwoObjects) {
  GuessingGame game;
  for (const QStringList& objects : {QStringList(), QStringList{"ball"}}) {
    game.begin(objects);
    EXPECT_FALSE(game.isPlayed());
    EXPECT_FALSE(game.isVisible());
    EXPECT_FALSE(game.hidesAnswer());
  }
}

}  // namespace
}  // namespace palpate::gui::guessing_game_test
