// What is asked before the recording of a connected hand ends.
#include "gui/connect/connect_feature.h"

#include <gtest/gtest.h>

namespace palpate::gui::connect_feature_test {
namespace {

using Ending = UserPrompts::Ending;
using State = RecorderStatus::State;

std::string asked(State recording, std::optional<GraspPhase> hand, Ending ending) {
  RecorderStatus recorder;
  recorder.state = recording;
  std::optional<GraspStatus> status;
  if (hand) status.emplace().phase = *hand;
  return endRecordingText(recorder, status, ending).toStdString();
}

TEST(ConnectFeature, ARunningRecordingIsKept) {
  EXPECT_EQ(asked(State::kRecording, {}, Ending::kDisconnect),
            "A recording is running. Before the hand is disconnected, the recording is finished; "
            "all that was recorded is kept.");
  EXPECT_EQ(asked(State::kRecording, GraspPhase::kClosing, Ending::kQuit),
            "A recording is running. Before the program quits and the hand is disconnected, the "
            "recording is finished; all that was recorded is kept. The hand is moving: it will be "
            "stopped.");
}

// Nothing was recorded before the contact: nothing can be kept.
TEST(ConnectFeature, AWaitingRecordingPromisesNothing) {
  EXPECT_EQ(asked(State::kArmed, {}, Ending::kDisconnect),
            "A recording waits for contact. Before the hand is disconnected, it is cancelled: "
            "there is nothing to keep yet.");
  EXPECT_EQ(asked(State::kWaiting, {}, Ending::kDisconnect),
            "A recording waits for the first frame. Before the hand is disconnected, it is "
            "cancelled: there is nothing to keep yet.");
}

TEST(ConnectFeature, AHandThatHoldsIsNotSaidToMove) {
  EXPECT_EQ(asked(State::kArmed, GraspPhase::kHolding, Ending::kDisconnect),
            "A recording waits for contact. Before the hand is disconnected, it is cancelled: "
            "there is nothing to keep yet. The hand keeps holding, but no longer answers slips.");
}

}  // namespace
}  // namespace palpate::gui::connect_feature_test
