// The answer of recognition about one grasp, with its texts and its painting: used by the dock, the
// full-screen window and exported pictures.
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

// RecognitionAnswer::of for grasps of the connected hand.
inline constexpr const char* kHeldNow = "held now";
inline constexpr const char* kLastGrasp = "the last grasp";

// An answer with the texts that are shown with it.
struct RecognitionAnswer {
  enum class Kind { kNothing, kProblem, kNamed, kUnknown };
  struct Place {
    QString name;
    double p = 0.0;
  };

  Kind kind = Kind::kNothing;
  // For kProblem the reason why there is no name; for kNothing what the user can do.
  QString text;
  // Answers marked as sure are right in 95 of 100 cases.
  bool sure = false;
  // Of kNamed: whether it is known that the object is one of the trained ones. If not, the name is
  // only that of the most similar one, and its probability says nothing.
  bool known = true;
  // For kNamed and kUnknown: up to three classes, the most probable first.
  std::vector<Place> best;
  // Which grasp the answer is about: "foam_ball.dsa, 12.40 – 14.10 s".
  QString of;
  // The session offset in words: "today the hand reads ...".
  QString offset;
  // Why no answer is sure; may be empty.
  QString unsure;
  // Index into the grasps of the session.
  std::optional<std::size_t> grasp;

  // "foam ball", "unknown"; empty without an answer
  QString name() const;
  // "sure", "not sure", "not known yet", "unknown"; empty without an answer
  QString confidenceWord() const;
  // Text for screen readers: "foam ball, 97 %, sure".
  QString accessibleText() const;
};

// The answer for a prediction of `model`.
RecognitionAnswer answerOf(const TrainedModel& model, const Prediction& prediction);
// The probability `p` (0..1) of a class: "97 %"; never 100 %.
QString probabilityText(double p);
// Describes an offset in words; `emulated`: the emulated hand has no offset.
QString offsetText(const SessionOffset& offset, bool emulated);

// Paints the name in large type, the certainty, a bar, two runners-up, and the photo if there is
// one; `unit`: height of plain text [px]. Lines that begin below the area are left out. Returns the
// lower end of what is painted.
double paintAnswer(QPainter& painter,
                   const QRectF& area,
                   const RecognitionAnswer& answer,
                   const QPixmap& photo,
                   Theme theme,
                   double unit);

}  // namespace palpate::gui
