// MCAP files of other programs, written by mcap_check.py.
#include <numbers>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/mcap_recording.h"
#include "palpate/recording/recording.h"

#include "imports/import_samples.h"
#include "testing/testing.h"

namespace palpate::mcap_foreign_test {
namespace {

namespace fs = std::filesystem;
using Values = std::vector<float>;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;

class McapForeign : public ::testing::Test {
 protected:
  // Python that writes a file by the calls pad(), camera() and joints() with times in ms; `log` is
  // the log time where it differs from the stamp.
  fs::path written(const std::string& script) {
    testing::runPython(folder_,
                       "import sys, math, struct\nsys.path.insert(0, '" PALPATE_MCAP_CHECK_FOLDER
                       "')\nsys.dont_write_bytecode = True\nimport mcap_check as m\n"
                       "w = m.Writer(sys.argv[1] + '/a.mcap')\n"
                       R"(
MS = 10**6
def image(topic, at, rows, form='mono16', log=None):
  w.message(topic, 'sensor_msgs/msg/Image', m.cdr_image(at * MS, rows, form), (at if log is None else log) * MS)
def pad(at, value, log=None): image('/pad', at, [[value, 2]], log=log)
def joints(at, names, positions, topic='/joint_states', log=None, publisher=''):
  w.message(topic, 'sensor_msgs/msg/JointState', m.cdr_joints(at * MS, names, positions), (at if log is None else log) * MS, publisher=publisher)
def pad_of(publisher, at, value, frame='camera'):
  w.message('/pad', 'sensor_msgs/msg/Image', m.cdr_image(at * MS, [[value, 2]], 'mono16', frame=frame), at * MS, publisher=publisher)
)" + script + "\nw.close()\n");
    return folder_ / "a.mcap";
  }

  static std::string textOf(const std::vector<std::string>& notes) {
    std::string text;
    for (const std::string& note : notes) text += note + "\n";
    return text;
  }
  static void expectNote(const Profile& profile, const std::string& words) {
    const std::string notes = textOf(profile.info().warnings);
    EXPECT_NE(notes.find(words), std::string::npos) << notes;
  }
  static void expectNoNote(const Profile& profile) {
    EXPECT_EQ(textOf(profile.info().warnings), "");
    EXPECT_EQ(lostText(profile), "");
  }
  static void expectDeg(const Profile& profile, std::size_t sample, std::vector<double> rad) {
    const std::vector<double> deg = profile.angles(sample).values;
    ASSERT_EQ(deg.size(), rad.size());
    for (std::size_t i = 0; i < rad.size(); ++i)
      EXPECT_NEAR(deg[i], rad[i] * kDegPerRad, 1e-9) << sample << ", " << i;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(McapForeign, JointsAreTakenByTheirNames) {
  const Profile profile = openRecording(written(R"(
pad(1, 7)
joints(1, ['a', 'b'], [1, 2])
joints(2, ['b', 'a'], [2.5, 1.5])
)"));
  ASSERT_EQ(profile.numAngles(), 2u);
  expectDeg(profile, 0, {1, 2});
  expectDeg(profile, 1, {1.5, 2.5});
  EXPECT_EQ(profile.hand().axes.at(0).name, "a");
  expectNoNote(profile);
}

TEST_F(McapForeign, JointsWithoutNamesAreTakenByTheirPosition) {
  const Profile profile = openRecording(written("pad(1, 7)\njoints(1, [], [1, 2])"));
  ASSERT_EQ(profile.numAngles(), 1u);
  expectDeg(profile, 0, {1, 2});
  EXPECT_EQ(profile.hand().axes.at(1).name, "axis 1");
  expectNoNote(profile);
}

// An arm and a gripper publish on one topic: each sample has the last value of each joint.
TEST_F(McapForeign, SeveralPublishersOfJointsArePutTogether) {
  const Profile profile = openRecording(written(R"(
pad(1, 7)
joints(1, ['a', 'b'], [1, 2])
joints(2, ['c'], [3])
joints(3, ['b', 'a'], [5, 4])
joints(3, ['c'], [6])
joints(2, ['x'], [9], topic='/other/joint_states')
)"));
  ASSERT_EQ(profile.numAngles(), 2u);  // the first at 2 ms, when c is known
  EXPECT_EQ(profile.angleTimeUs(0), 2000);
  expectDeg(profile, 0, {1, 2, 3});
  EXPECT_EQ(profile.angleTimeUs(1), 3000);
  expectDeg(profile, 1, {4, 5, 6});
  expectDeg(profile, 0, {1, 2, 3});
  expectNote(profile, "put together by name");
  EXPECT_EQ(lostText(profile),
            "1 message of the topic \"/joint_states\" is left out (before all joints are known)");
  expectNote(profile, "\"/other/joint_states\" is left out");
  EXPECT_EQ(profile.numFrames(), 1u);
}

TEST_F(McapForeign, AJointThatComesLateCostsTheAnglesBeforeItAndTheyAreCounted) {
  const fs::path file = written(R"(
pad(1, 7)
for i in range(50): joints(i + 1, ['a', 'b'], [1, 2])
joints(51, ['c'], [3])
)");
  const Profile profile = openRecording(file);
  EXPECT_EQ(profile.numAngles(), 1u);
  EXPECT_EQ(lostText(profile),
            "50 messages of the topic \"/joint_states\" are left out (before all joints are "
            "known)");
  EXPECT_EQ(recoverRecording(file, folder_ / "b.palpate").state, RecoverReport::State::kPart);
}

TEST_F(McapForeign, MessagesOfJointsThatCantBeUsedAreCounted) {
  const fs::path file = written(R"(
pad(1, 7)
joints(1, ['a', 'b'], [1, 2])
joints(2, ['a', 'b'], [1, math.nan])
joints(3, ['a', 'b'], [1])
joints(4, ['a', 'a'], [1, 2])
joints(5, [], [1, 2])
joints(6, ['a', 'b'], [])
joints(7, ['a', 'b'], [3, 4])
)");
  const Profile profile = openRecording(file);
  ASSERT_EQ(profile.numAngles(), 2u);
  expectDeg(profile, 1, {3, 4});
  EXPECT_EQ(lostText(profile),
            "4 messages of the topic \"/joint_states\" are left out (the first: a position that "
            "is not a number)");
}

// The joints of the SDH-2's URDF, in another order than its axes.
TEST_F(McapForeign, TheAxesOfAKnownHandAreFoundByTheNamesOfItsJoints) {
  const std::string matrices = R"(
for i, rows in enumerate([14, 13] * 3): image(f'/m{i}', 1, [[0] * 6] * rows)
)";
  const Profile profile = openRecording(written(matrices + R"(
names = [f'finger_{f}_{link}' for f in (2, 1, 0) for link in ('distal', 'proximal')]
joints(1, names + ['finger_2_base', 'finger_0_base'], [.6, .5, .4, .3, .2, .1, .7, .7])
)"));
  EXPECT_EQ(profile.hand().name, defaultHand().name);
  ASSERT_EQ(profile.numAngles(), 1u);
  expectDeg(profile, 0, {.7, .1, .2, .3, .4, .5, .6});
  expectNoNote(profile);
  const Profile others = openRecording(
      written(matrices + "joints(1, [f'j{i}' for i in range(7)], [.1, .2, .3, .4, .5, .6, .7])"));
  expectDeg(others, 0, {.1, .2, .3, .4, .5, .6, .7});
  expectNote(others, "in the order of the file");
}

TEST_F(McapForeign, OfTwoPublishersOfATopicTheFirstOneIsRead) {
  const std::string channels =
      "for i in range(4): pad_of('ab'[i % 2], 10 * i + 10, [i, 700][i % 2])";
  const std::string frameIds =
      "for i in range(4): pad_of('', 10 * i + 10, [i, 700][i % 2], ['left', 'right'][i % 2])";
  for (const std::string& script : {channels, frameIds}) {
    const fs::path file = written(script);
    const Profile profile = openRecording(file);
    ASSERT_EQ(profile.numFrames(), 2u) << script;
    EXPECT_EQ(profile.frame(0).values, (Values{0, 2}));
    EXPECT_EQ(profile.frame(1).values, (Values{2, 2}));
    EXPECT_EQ(profile.frameTimeUs(1), 30'000);
    EXPECT_NE(lostText(profile).find("2 messages of the topic \"/pad\" are left out (the first: it "
                                     "is from another publisher, channel "),
              std::string::npos)
        << lostText(profile);
    fs::remove(file);
  }
}

TEST_F(McapForeign, PublishersOneAfterTheOtherAreOne) {
  const Profile profile = openRecording(
      written("for i in range(4): pad_of('aabb'[i], 10 * i + 10, i, ['one', 'two'][i // 2])"));
  ASSERT_EQ(profile.numFrames(), 4u);
  EXPECT_EQ(profile.frame(3).values, (Values{3, 2}));
  expectNoNote(profile);
}

TEST_F(McapForeign, OfTwoPublishersOfTheSameJointsTheFirstOneIsRead) {
  const Profile profile = openRecording(written(R"(
pad(1, 7)
for i in range(3):
  joints(10 * i + 1, ['a', 'b'], [i, 2], publisher='state')
  joints(10 * i + 2, ['b', 'c'], [9, 9], publisher='command')
)"));
  ASSERT_EQ(profile.numAngles(), 3u);
  EXPECT_EQ(profile.hand().axes.size(), 2u);
  for (int i = 0; i < 3; ++i)
    expectDeg(profile, static_cast<std::size_t>(i), {static_cast<double>(i), 2});
  EXPECT_NE(lostText(profile).find("3 messages of the topic \"/joint_states\" are left out"),
            std::string::npos)
      << lostText(profile);
}

// One camera counts from the start of its computer, the other from 1970.
TEST_F(McapForeign, StampsOfTwoClocksGiveWayToTheLogTimes) {
  const Profile profile = openRecording(written(R"(
T0 = 1763800000000
for i in range(3):
  image('/a', T0 + 10 * i, [[i, 2]], log=T0 + 10 * i + 1)
  image('/b', 5000 + 10 * i, [[i, 3]], log=T0 + 10 * i + 4)
)"));
  ASSERT_EQ(profile.numFrames(), 6u);
  EXPECT_EQ(profile.frameTimeUs(0), 1763800000001'000);
  EXPECT_EQ(profile.frameTimeUs(5), 1763800000024'000);
  EXPECT_EQ(profile.frame(5).values, (Values{2, 2, 2, 3}));
  expectNote(profile, "the stamps of the topic \"/b\" are from another clock");
}

TEST_F(McapForeign, JointsWithoutANameAreSaid) {
  const Profile profile = openRecording(
      written("pad(1, 7)\njoints(1, ['a', 'b'], [1, 2])\njoints(2, ['', ''], [3, 4])"));
  EXPECT_EQ(profile.numAngles(), 1u);
  EXPECT_NE(lostText(profile).find("a joint has no name"), std::string::npos) << lostText(profile);
}

TEST_F(McapForeign, ACameraBesideThePadIsLeftOut) {
  const fs::path file = written(R"(
for i in range(3):
  pad(10 * i + 1, i)
  image('/camera', 10 * i + 2, [[1, 2, 3]], 'rgb8')
  image('/depth', 10 * i + 2, [[0] * 257], '32FC1')
w.message('/old', 'sensor_msgs/Image', b'', 5, 'ros1')
)");
  const Profile profile = openRecording(file);
  ASSERT_EQ(profile.layout().numMatrices(), 1u);
  ASSERT_EQ(profile.numFrames(), 3u);
  EXPECT_EQ(profile.frame(2).values, (Values{2, 2}));
  expectNote(profile, "\"/camera\" is left out: its images have the encoding \"rgb8\"");
  expectNote(profile, "\"/depth\" is left out: its images have 257 x 1 pixels");
  expectNote(profile, "\"/old\" is left out: its messages have the encoding \"ros1\"");
  EXPECT_EQ(lostText(profile), "");
  EXPECT_EQ(verifyRecording(file).state, VerifyReport::State::kSound);
  EXPECT_EQ(recoverRecording(file, folder_ / "b.palpate").state, RecoverReport::State::kWhole);
}

TEST_F(McapForeign, ATopicThatChangesItsSizeKeepsWhatFits) {
  const fs::path file = written(R"(
pad(1, 7)
image('/pad', 2, [[1], [2]])
pad(3, 9)
image('/pad', 4, [[1, 2]], 'rgb8')
)");
  const Profile profile = openRecording(file);
  ASSERT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.frame(1).values, (Values{9, 2}));
  EXPECT_EQ(lostText(profile),
            "2 messages of the topic \"/pad\" are left out (the first: the size of its images "
            "changes from 2 x 1 to 1 x 2 pixels)");
  const RecoverReport report = recoverRecording(file, folder_ / "b.palpate");
  EXPECT_EQ(report.state, RecoverReport::State::kPart);
  EXPECT_NE(report.message.find("2 messages"), std::string::npos) << report.message;
}

// A driver may publish an empty image before its first frame.
TEST_F(McapForeign, AnEmptyFirstImageCostsOnlyItself) {
  const fs::path file = written("image('/pad', 1, [])\npad(2, 7)\npad(3, 9)");
  const Profile profile = openRecording(file);
  ASSERT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.frame(1).values, (Values{9, 2}));
  EXPECT_EQ(lostText(profile),
            "1 message of the topic \"/pad\" is left out (the first: its images have 0 x 0 pixels "
            "(a matrix has at most 256 x 256 taxels))");
  EXPECT_EQ(readRecording(file, {.topics = {"/pad"}}).profile.numFrames(), 2u);
}

TEST_F(McapForeign, TopicsCanBeChosen) {
  const fs::path file = written(R"(
image('/a', 1, [[1]])
image('/b', 1, [[2]])
image('/camera', 1, [[1, 2, 3]], 'rgb8')
joints(1, ['x'], [1])
joints(1, ['y'], [2], topic='/arm')
w.message('/text', 'std_msgs/msg/String', b'\0\1\0\0', 5)
)");
  const Profile profile = readRecording(file, {.topics = {"/b", "/arm"}}).profile;
  ASSERT_EQ(profile.layout().numMatrices(), 1u);
  EXPECT_EQ(profile.frame(0).values, Values{2});
  EXPECT_EQ(profile.hand().axes.at(0).name, "y");
  expectNoNote(profile);
  EXPECT_EQ(readableRecording(file, {.topics = {"/a"}}).profile.numAngles(), 0u);
  const auto errorOf = [&](const std::vector<std::string>& topics) {
    return testing::errorOf([&] { readRecording(file, {.topics = topics}); });
  };
  EXPECT_NE(errorOf({"/c"}).find("has no topic \"/c\""), std::string::npos) << errorOf({"/c"});
  EXPECT_NE(errorOf({"/c"}).find("\"/text\": std_msgs/msg/String"), std::string::npos);
  EXPECT_NE(errorOf({"/a", "/camera"}).find("\"/camera\" can't be read: its images have"),
            std::string::npos);
  EXPECT_NE(errorOf({"/arm"}).find("has no images"), std::string::npos);
}

// Two messages of one stamp: the log times tell them apart.
TEST_F(McapForeign, LogTimesTakeThePlaceOfStampsThatRepeat) {
  for (const char* second : {"1000", "900"}) {  // repeats, comes late
    const Profile profile = openRecording(
        written("pad(1000, 5, log=1001)\npad(" + std::string(second) +
                ", 6, log=1011)\npad(1020, 7, log=1021)\njoints(1000, ['a'], [1], log=1015)"));
    ASSERT_EQ(profile.numFrames(), 3u);
    EXPECT_EQ(profile.frameTimeUs(1), 1'011'000);
    EXPECT_EQ(profile.frame(1).values, (Values{6, 2}));
    EXPECT_EQ(profile.angleTimeUs(0), 1'015'000);
    expectNote(profile, "1 stamp of the topic \"/pad\" repeats or comes late: all times are");
    EXPECT_EQ(lostText(profile), "");
  }
}

TEST_F(McapForeign, MessagesOfOneStampAndLogTimeAreCounted) {
  const Profile profile =
      openRecording(written("pad(10, 5)\npad(10, 6)\npad(30, 7)\npad(20, 8)\npad(40, 9)"));
  ASSERT_EQ(profile.numFrames(), 4u);
  EXPECT_EQ(profile.frame(0).values[0], 5.0F);
  EXPECT_EQ(profile.frame(1).values[0], 8.0F);  // sorted
  EXPECT_EQ(profile.frame(2).values[0], 7.0F);
  EXPECT_EQ(lostText(profile),
            "1 message of the topic \"/pad\" is left out (the first: its stamp is that of another "
            "message)");
  expectNote(profile, "stamps of the topic \"/pad\" repeat or come late: its messages are sorted");
}

TEST_F(McapForeign, ValuesThatAreNotNumbersAreZeroAndCounted) {
  const fs::path file = written(R"(
image('/pad', 1, [[0.5, math.nan], [math.inf, -1.5]], '32FC1')
image('/pad', 2, [[1, 2], [math.nan, 4]], '32FC1')
)");
  const Profile profile = openRecording(file);
  ASSERT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.frame(0).values, (Values{0.5F, 0, 0, -1.5F}));
  EXPECT_EQ(profile.frame(1).values, (Values{1, 2, 0, 4}));
  EXPECT_EQ(lostText(profile), "3 values of the topic \"/pad\" are taken as 0 (NaN or infinite)");
  EXPECT_NE(readableRecording(file).damage.text.find("3 values"), std::string::npos);
}

TEST_F(McapForeign, AFileWithoutImagesNamesItsTopics) {
  const std::string error = testing::errorOf([&] {
    openRecording(written(R"(
w.message('/array', 'std_msgs/msg/Float32MultiArray', b'\0\1\0\0', 5)
w.message('/json', 'pad', b'{}', 5, 'json')
image('/camera', 1, [[1, 2, 3]], 'rgb8')
)"));
  });
  for (const char* words : {"has no images that could be matrices",
                            "\"/array\": std_msgs/msg/Float32MultiArray, cdr",
                            "\"/json\": pad, json",
                            "\"/camera\": its images have the encoding \"rgb8\""})
    EXPECT_NE(error.find(words), std::string::npos) << error;
}

// foxglove.RawImage: fields by the tags of its .proto, written here by hand.
TEST_F(McapForeign, RawImagesOfFoxgloveAreRead) {
  const Profile profile = openRecording(written(R"(
def raw(at, values):
  stamp = b'\x08' + bytes([at])
  return (b'\x0a' + bytes([len(stamp)]) + stamp + b'\x15' + struct.pack('<I', len(values)) + b'\x1d' +
          struct.pack('<I', 1) + b'\x22\x06mono16' + b'\x2d' + struct.pack('<I', 2 * len(values)) + b'\x32' +
          bytes([2 * len(values)]) + struct.pack(f'<{len(values)}H', *values))
for at in 3, 4: w.message('/pad', 'foxglove.RawImage', raw(at, [at, 300]), 5, 'protobuf')
)"));
  ASSERT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.frameTimeUs(0), 3'000'000);
  EXPECT_EQ(profile.frame(1).values, (Values{4, 300}));
}

TEST_F(McapForeign, AnUnknownCompressionIsNamedInARecovery) {
  testing::runPython(folder_,
                     "import sys\nsys.path.insert(0, '" PALPATE_MCAP_CHECK_FOLDER
                     "')\nsys.dont_write_bytecode = True\nimport mcap_check as m\n"
                     "w = m.Writer(sys.argv[1] + '/b.mcap', 1, 'br')\n"
                     "w.message('/pad', 'sensor_msgs/msg/Image', m.cdr_image(5, [[1]], 'mono8'), "
                     "5)\nw.close()\n");
  const std::string error = testing::errorOf([&] { readableRecording(folder_ / "b.mcap"); });
  EXPECT_NE(error.find("unknown compression, \"br\""), std::string::npos) << error;
}

}  // namespace
}  // namespace palpate::mcap_foreign_test
