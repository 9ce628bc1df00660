// What recognition says of one grasp, as the window tells it: on a page, on the wall of a lecture
// hall, on paper.
#pragma once

#include <QPixmap>
#include <QRectF>
#include <QString>
#include <cstddef>
#include <optional>
#include <vector>

#include <palpate/recognition/recognition_session.h>

#include "gui/appearance/theme.h"

class QPainter;

namespace palpate::gui {

// RecognitionAnswer::of, for a grasp of the connected hand.
inline constexpr const char* kHeldNow = "held now";
inline constexpr const char* kLastGrasp = "the last grasp";

struct RecognitionAnswer {
  enum class Kind { kNothing, kProblem, kNamed, kUnknown };
  struct Place {
    QString name;
    double p = 0.0;
  };

  Kind kind = Kind::kNothing;
  QString text;       // of kProblem: why there is no name; of kNothing: what to do
  bool sure = false;  // right 95 times in 100
  // of kNamed, kUnknown: up to three, best first; the first one is what it is called
  std::vector<Place> best;
  QString of;                        // which grasp: "foam_ball.dsa, 12.40 – 14.10 s"
  QString offset;                    // "today the hand reads ..."
  QString unsure;                    // why nothing is sure; may be empty
  std::optional<std::size_t> grasp;  // of the day's

  // "foam ball", "unknown"; empty without an answer.
  QString name() const;
  // "sure", "not sure", "unknown"; empty without an answer.
  QString confidenceWord() const;
  // For those who hear it: "foam ball, 97 %, sure".
  QString accessibleText() const;
};

// Of a verdict with a model.
RecognitionAnswer answerOf(const TrainedModel& model, const Prediction& prediction);
// What a person reads of an offset; `emulated`: the hand has none.
QString offsetText(const SessionOffset& offset, bool emulated);

// Large name, word, bar, two runners-up, and the photo where there is one; `unit`: height of plain
// text.
void paintAnswer(QPainter& painter,
                 const QRectF& area,
                 const RecognitionAnswer& answer,
                 const QPixmap& photo,
                 Theme theme,
                 double unit);

}  // namespace palpate::gui
