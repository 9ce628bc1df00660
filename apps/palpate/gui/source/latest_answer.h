// Answers questions in the background, of which only the newest counts: a new one cancels the
// running one, and neither an answer nor a failure of an older one is heard of. As every
// Abandonable it can be left at any moment.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include <palpate/core/error.h>

#include "gui/source/abandonable.h"

namespace palpate::gui {

template <typename Question, typename Answer>
class LatestAnswer : public Abandonable {
 public:
  // What is known so far, before the answer.
  using Tell = std::function<void(const Answer&)>;
  // Runs in other threads, perhaps longer than this object lives.
  using Answers = std::function<Answer(const Question&, const Progress&, const Tell&)>;
  using TakeAnswer = std::function<void(const Answer&)>;

  // kOneAtATime: a question waits until the work on the older one has seen that it is cancelled, so
  // that what `answers` holds for later questions needs no lock. kAtOnce: it doesn't wait for an
  // older one whose folder doesn't answer.
  enum class Turns { kOneAtATime, kAtOnce };

  // `take` and `failed` are called in the thread of this object.
  LatestAnswer(Answers answers,
               TakeAnswer take,
               Failed failed,
               QObject* parent = nullptr,
               Turns turns = Turns::kOneAtATime)
      : Abandonable(parent),
        answers_(std::move(answers)),
        take_(std::move(take)),
        failed_(std::move(failed)),
        turn_(turns == Turns::kOneAtATime ? std::make_shared<std::mutex>() : nullptr) {}

  void ask(Question question) {
    start(
        [question = std::move(question), answers = answers_, take = take_, turn = turn_](
            const Asker& asker) -> Take {
          std::unique_lock<std::mutex> guard;
          if (turn) guard = std::unique_lock(*turn);
          if (!asker.progress(0.0)) throw Cancelled();
          const auto taken = [&take](Answer answer) -> Take {
            return [take, answer = std::move(answer)] { take(answer); };
          };
          return taken(answers(
              question, asker.progress, [&](const Answer& answer) { asker.tell(taken(answer)); }));
        },
        failed_);
  }

 private:
  const Answers answers_;
  const TakeAnswer take_;
  const Failed failed_;
  // Null: each question begins at once.
  const std::shared_ptr<std::mutex> turn_;
};

}  // namespace palpate::gui
