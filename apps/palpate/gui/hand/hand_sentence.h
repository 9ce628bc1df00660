// What the dock Hand says of the hand: one sentence for each state, without a widget.
#pragma once

#include <QString>
#include <cstdint>

#include <palpate/control/grasp_control.h>

namespace palpate::gui {

// All that the sentence depends on.
struct HandFacts {
  enum class Hand {
    kNone,      // none is connected
    kStreamed,  // sends its data, takes no commands
    kReplayed,  // a recording is replayed
    kMovable
  };
  Hand hand = Hand::kNone;
  GraspStatus status = {};
  // The present time by the session's clock [us since 1970].
  std::int64_t nowUs = 0;
  // When the motion port was last missing [us since 1970]; 0: never.
  std::int64_t goneUs = 0;
  // See PortStatus.
  std::int64_t foundMovingUs = 0;
  // The place in the running sequence; empty: none runs.
  QString sequence = {};
  // Why a motion or a setting was refused; empty: it was not, or something else was asked since.
  QString refusal = {};
  // What an emulated hand does by itself; empty: nothing.
  QString ownMotion = {};
  // Whether a grasp that keeps its limit closes without knowing where it touches: slowly.
  bool touchUnknown = false;
  // Whether a stop ended what it did by itself, and nothing has moved it since.
  bool sceneStopped = false;
  // Whether the limit for which the last grasp was refused can be measured by now.
  bool limitMeasurable = false;
};

struct HandSentence {
  QString text;
  bool bad = false;  // it needs attention
  // Told by the tool tip only.
  QString more = {};
  // Of the motion that ended by itself in another way than asked for, if the sentence tells one:
  // when [us since 1970], and why.
  std::int64_t endUs = 0;
  QString why = {};
};
HandSentence handSentence(const HandFacts& facts);

// What HandFacts::sceneStopped means.
QString sceneStoppedText();

// `text` below the friction that the running or the last grasp has measured: a line that is seen
// without scrolling.
QString withFriction(const QString& text, const GraspStatus& status);

}  // namespace palpate::gui
