// Answers the questions to the user, and notes what was asked.
#pragma once

#include <functional>

#include "gui/appearance/captions.h"  // pathText(), for answers
#include "gui/desktop/ask.h"

namespace palpate::gui {

class FakeAsk : public Ask {
 public:
  class Queue {
   public:
    Queue() = default;
    // What is answered, one after the other; the last one stays. No answer or a null one:
    // cancelled. Of several files the paths are lines of one answer, of a choice the text of the
    // button.
    Queue& operator=(const QStringList& next) {
      answers_ = next;
      return *this;
    }
    // Titles, or texts of choices; what the questions began with, or the buttons, as lines;
    // filters, or questions for texts.
    QStringList asked, began, filters;
    // What happens while the user is asked.
    std::function<void()> meanwhile = [] {};

   private:
    friend FakeAsk;
    QString next(const QString& question, const QString& begin, const QString& filter) {
      asked << question;
      began << begin;
      filters << filter;
      meanwhile();
      return answers_.size() > 1 ? answers_.takeFirst() : answers_.value(0);
    }
    QStringList answers_;
  };
  Queue files, folders, newFiles, texts, choices;

  std::optional<QString> text(const QString& title,
                              const QString& question,
                              const QString& text) override {
    const QString answer = texts.next(title, text, question);
    return answer.isNull() ? std::nullopt : std::optional(answer.simplified());
  }
  int choice(const QString& text, const QStringList& buttons, int) override {
    return static_cast<int>(buttons.indexOf(choices.next(text, buttons.join('\n'), {})));
  }

 private:
  QStringList places(Place place,
                     const QString& title,
                     const QString& begin,
                     const QString& filter) override {
    Queue& queue = place == Place::kFolder ? folders : place == Place::kNewFile ? newFiles : files;
    return queue.next(title, begin, filter).split('\n', Qt::SkipEmptyParts);
  }
};

}  // namespace palpate::gui
