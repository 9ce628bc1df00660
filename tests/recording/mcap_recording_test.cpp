#include "palpate/recording/mcap_recording.h"

#include <cmath>
#include <csignal>
#include <random>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"

#include "imports/import_samples.h"
#include "recording/exchange_samples.h"
#include "recording/palpate_samples.h"
#include "recording/series_samples.h"
#include "testing/testing.h"

namespace palpate::mcap_recording_test {
namespace {

namespace fs = std::filesystem;
using testing::expectSame;
using testing::maskedPads;
using testing::openingError;
using testing::randomProfile;
using testing::TemporaryFolder;

// NUL, a byte that is no UTF-8, a character of two bytes, and the one that stands for a NUL in
// files.
const Event kOddEvent{
    5, 9, "note", 1, std::string("a\0b\xC0 \xC3\xBC \xF4\x8F\xBC\x80", 12), "{\"k\":1}"};
const std::vector<Event> kEvents{kOddEvent, {7, 7, "gap", {}, "", ""}};

McapWriteOptions smallChunks(McapCompression compression = McapCompression::kNone) {
  McapWriteOptions options;
  options.compression = compression;
  options.chunkBytes = 4096;
  return options;
}

void write(const Profile& profile,
           const fs::path& path,
           const McapWriteOptions& options = smallChunks()) {
  ExportExtras extras;
  extras.provenance = {"palpate 9", "a.dsa", "00ff", "median:size=3", "", "pads"};
  extras.series.push_back(testing::rampSeries(profile.numFrames(), 1'600'000'000'000'000));
  writeMcap({profile, kEvents, {{"operator", "A. B.\xFF"}, {"frames", "99"}}, extras},
            path,
            Overwrite::kReplace,
            {},
            options);
}

void writeUsual(const Profile& profile, const fs::path& path) { write(profile, path); }

// Runs Python with mcap_check.py.
void runMcapPython(const TemporaryFolder& folder, const std::string& script) {
  testing::runPython(folder,
                     "import sys, math, struct\nsys.path.insert(0, '" PALPATE_MCAP_CHECK_FOLDER
                     "')\nsys.dont_write_bytecode = True\nimport mcap_check as m\n"
                     "folder = sys.argv[1] + '/'\n" +
                         script);
}

TEST(McapRecording, randomRecordingsComeBackBitByBit) {
  const TemporaryFolder folder;
  for (const bool floats : {false, true})
    for (const std::size_t frames : {0, 1, 300, 1100})
      for (const auto compression :
           {McapCompression::kNone, McapCompression::kLz4, McapCompression::kZstd})
        for (const auto images : {McapImages::kRos, McapImages::kFoxglove}) {
          const Profile profile = randomProfile(static_cast<std::uint32_t>(frames), floats, frames);
          McapWriteOptions options = smallChunks(compression);
          options.images = images;
          write(profile, folder / "a.mcap", options);
          const Recording read = readMcap(folder / "a.mcap");
          expectSame(profile, read.profile);
          EXPECT_EQ(read.events, kEvents);
          EXPECT_EQ(readMcapEvents(folder / "a.mcap").events, kEvents);
          EXPECT_EQ(read.meta.at("operator"), "A. B.\xFF");
          EXPECT_EQ(read.meta, readMcapMeta(folder / "a.mcap"));
          EXPECT_FALSE(read.meta.contains("frames"));  // of the file of the source
          EXPECT_EQ(read.provenance,
                    (Provenance{"palpate 9", "a.dsa", "00ff", "median:size=3", "", "pads"}));
        }
}

// Also by way of a native recording: what was said of the recording stays as well.
TEST(McapRecording, aNativeRecordingComesBackAsItWas) {
  testing::expectNativeComesBackFrom("a.mcap");
}

TEST(McapRecording, aHandOfAnotherLayoutComesBackWithItsFiles) {
  const TemporaryFolder folder;
  const HandDescription& hand = builtInHand("flat_pad_16x16");
  ProfileBuilder builder(hand);
  TactileFrame frame(hand.layout);
  for (std::int64_t i = 0; i < 50; ++i) {
    frame.hostUs = 1000 + i;
    frame.values[static_cast<std::size_t>(i)] = static_cast<float>(i);
    builder.addFrame(frame);
  }
  const Profile profile = builder.finish({});
  writeMcap({profile, {}, {}, ExportExtras{}}, folder / "a.mcap");
  const Profile read = openRecording(folder / "a.mcap");
  expectSame(profile, read);
  ASSERT_TRUE(read.hand().file);
  EXPECT_EQ(read.hand().file->json, hand.file->json);
  EXPECT_EQ(read.hand().unit, hand.unit);
}

TEST(McapRecording, realRecordingsComeBackBitByBit) {
  testing::expectRealRecordingsComeBack("a.mcap", [](const Profile& profile, const fs::path& path) {
    writeMcap({profile, {}, {}, ExportExtras{}}, path, Overwrite::kReplace);
  });
}

TEST(McapRecording, stampsBeyondThoseOfMcapComeBack) {
  const TemporaryFolder folder;
  ProfileBuilder builder(maskedPads());
  TactileFrame frame(maskedPads());
  for (const std::int64_t us :
       {-(std::int64_t{1} << 60), std::int64_t{-1}, std::int64_t{1} << 60}) {
    frame.hostUs = us;
    builder.addFrame(frame);
    builder.addAngles(us, std::vector<double>{1.0});
  }
  const Profile profile = builder.finish({});
  write(profile, folder / "a.mcap");
  expectSame(profile, openRecording(folder / "a.mcap"));
}

TEST(McapRecording, theFileDoesNotDependOnTheNumberOfThreads) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(3, true, 2600);
  McapWriteOptions options = smallChunks(McapCompression::kZstd);
  options.threads = 1;
  write(profile, folder / "1.mcap", options);
  options.threads = 4;
  write(profile, folder / "4.mcap", options);
  EXPECT_TRUE(testing::readFile(folder / "1.mcap") == testing::readFile(folder / "4.mcap"));
}

TEST(McapRecording, severalThreadsReadAtOnce) {
  testing::expectThreadsReadAtOnce("a.mcap", writeUsual);
}

// mcap_check.py checks checksums, indexes, statistics and the summary by the specification.
TEST(McapRecording, anIndependentReaderFindsTheSame) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(8, false, 2000);
  write(profile, folder / "a.mcap");
  write(randomProfile(8, true, 30), folder / "floats.mcap");
  McapWriteOptions foxglove = smallChunks();
  foxglove.images = McapImages::kFoxglove;
  write(profile, folder / "foxglove.mcap", foxglove);
  write(randomProfile(1, false, 0), folder / "none.mcap");
  std::string truth;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    truth += std::to_string(profile.frameTimeUs(i));
    for (const float value : profile.frame(i).values)
      truth += " " + std::to_string(static_cast<int>(value));
    truth += "\n";
  }
  testing::writeFile(folder / "truth", truth);
  runMcapPython(folder, R"(
truth = [[int(word) for word in line.split()] for line in open(folder + 'truth')]
f = m.read(folder + 'a.mcap')
assert f['profile'] == 'ros2' and f['library'] == 'palpate 9' and f['chunks'] > 50
assert all('offered_qos_profiles' in metadata for metadata in f['channels'].values())
assert all(encoding == 'cdr' and schema == 'ros2msg' for _, schema, encoding in f['types'].values())
assert f['types']['/tactile/m0'][0] == 'sensor_msgs/msg/Image'
assert f['types']['/joint_states'][0] == 'sensor_msgs/msg/JointState'
assert f['types']['/events'][0] == 'rcl_interfaces/msg/Log'
about = f['metadata']['palpate']
assert about['source_file'] == 'a.dsa' and about['filters'] == 'median:size=3' and about['layout_version'] == '1'
assert f['metadata']['palpate_meta']['operator'] == 'A. B.' + chr(0x10FFFF)
pad = f['channels']['/tactile/m0']
assert pad['pitch_mm'] == '1.25' and pad['static_mask'] == '111101111111111' and pad['unit'] == 'counts'
assert len(f['messages']['/tactile/m0']) == 2000
for row, (log, data), (log1, data1) in zip(truth, f['messages']['/tactile/m0'], f['messages']['/tactile/m1']):
  stamp, frame, encoding, values = m.image(data)
  assert stamp == log == log1 == row[0] * 1000 and frame == 'm0' and encoding == 'mono16'
  assert values == [row[1:6], row[6:11], row[11:16]] and m.image(data1)[3] == [row[16:18]]
joints = f['messages']['/joint_states']
cdr = m.Cdr(joints[3][1])
assert cdr.stamp_ns() == joints[3][0] and cdr.text() == '' and len(joints) == 1000
names = [cdr.text() for _ in range(cdr.number('I'))]
positions, velocities, efforts = cdr.doubles(), cdr.doubles(), cdr.doubles()
cdr.end()
assert len(names) == 4 and velocities == efforts == [] and len(positions) == 4
assert abs(positions[1] - math.radians(-3)) < 1e-15 and abs(positions[3] - math.radians(7)) < 1e-15
angles = m.Cdr(f['messages']['/palpate/angles'][3][1])
assert angles.number('q') * 1000 == joints[3][0] and angles.doubles() == [0.1 * 6, -3.0, 1.0 / 3, 7]
temperatures = m.Cdr(f['messages']['/palpate/temperatures'][1][1])
assert temperatures.number('q') == truth[100][0] and temperatures.doubles() == [20.5, 10.0]
assert f['channels']['/palpate/temperatures']['units'] == '["degC","degC"]'
assert f['channels']['/palpate/signals']['columns'] == '["m0/mean","m0/active"]'
last = m.Cdr(f['messages']['/palpate/signals'][1999][1])
assert last.number('q') == 1600000000001999 and last.doubles() == [999.5, -1999.0]
log, data = f['messages']['/events'][0]
cdr = m.Cdr(data)
assert cdr.stamp_ns() == log == 5000 and cdr.number('B') == 20 and cdr.text() == 'note'
assert cdr.text() == 'a\ufffdb\ufffd \u00fc ' + 4 * '\ufffd'
cdr = m.Cdr(f['messages']['/palpate/events'][1][1])
assert [cdr.number('q'), cdr.number('q'), cdr.number('i')] == [7, 7, -2**31] and cdr.text() == 'gap'
f = m.read(folder + 'floats.mcap')
assert {m.image(data)[2] for _, data in f['messages']['/tactile/m0']} == {'32FC1'}
flags = [(m.Cdr(data).data[16], len(data)) for _, data in f['messages']['/palpate/frames']]
assert [flag for flag, _ in flags] == [1, 0, 0] * 10 and {size for _, size in flags} == {4 + 24 + 4, 4 + 28 + 4 + 3}
f = m.read(folder + 'foxglove.mcap')
assert f['profile'] == '' and f['types']['/tactile/m1'] == ('foxglove.RawImage', 'protobuf', 'protobuf')
data = f['messages']['/tactile/m1'][5][1]
assert data.endswith(struct.pack('<BBHH', 6 << 3 | 2, 4, *truth[5][16:18])) and b'mono16' in data and b'm1' in data
assert m.read(folder + 'none.mcap')['messages']['/tactile/m0'] == []
)");
}

// By the names of the attached URDF: a joint that mimics another one follows it.
TEST(McapRecording, jointStatesAreThoseOfTheUrdf) {
  const TemporaryFolder folder;
  const std::string urdf = R"(<robot name="x"><link name="base"/><link name="a"/><link name="b"/>
<joint name="bend" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="follow" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" effort="1" velocity="1"/>
<mimic joint="bend" multiplier="-0.5" offset="0.1"/></joint>
<joint name="screw" type="fixed"><parent link="base"/><child link="c"/></joint><link name="c"/></robot>)";
  const std::string json = R"({"format":"palpate-hand","version":1,"name":"x","full_scale":1,
"urdf":"hand.urdf","axes":[{"name":"the axis","minimum":-90,"maximum":90,"joints":["bend"]}],
"matrices":[{"name":"m","rows":1,"columns":1,"pitch_mm":1}]})";
  const HandDescription hand = parseHand(json, urdf, "hand.json");
  McapWriteOptions options;
  options.compression = McapCompression::kNone;  // as the checker reads it
  McapLiveWriter writer(folder / "a.mcap", hand, {}, options);
  writer.addSample({1'000'000, {90.0}});
  writer.finish();
  runMcapPython(folder, R"(
f = m.read(folder + 'a.mcap')
cdr = m.Cdr(f['messages']['/joint_states'][0][1])
cdr.stamp_ns(), cdr.text()
assert [cdr.text() for _ in range(cdr.number('I'))] == ['bend', 'follow']
bend, follow = cdr.doubles()
assert abs(bend - math.pi / 2) < 1e-12 and abs(follow - (0.1 - math.pi / 4)) < 1e-12
cdr = m.Cdr(f['messages']['/palpate/angles'][0][1])
assert cdr.number('q') == 1000000 and cdr.doubles() == [90.0]
)");
}

// A taxel is active above 0 only, also where a filter gives a touched one a negative value.
TEST(McapRecording, activeIsTheSameInAllForms) {
  const TemporaryFolder folder;
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 4, 1.0)});
  ProfileBuilder builder(layout);
  TactileFrame frame(layout);
  frame.hostUs = 1'000'000;
  frame.setFiltered({-5.5F, 7.5F, -3.5F, 2.5F}, {true, true, false, false});
  builder.addFrame(frame);
  const Profile profile = builder.finish({});
  for (const char* name : {"a.h5", "a.mat", "a.npz"}) saveRecording(profile, {}, folder / name);
  write(profile, folder / "a.mcap");
  runMcapPython(folder, R"(
import h5py, scipy.io, numpy as np
active = [0, 1, 0, 0]
assert h5py.File(folder + 'a.h5')['tactile/m0_active'][0, 0].tolist() == active
assert scipy.io.loadmat(folder + 'a.mat', simplify_cells=True)['tactile']['m0_active'].ravel().tolist() == active
assert np.load(folder + 'a.npz')['m0_active'].ravel().tolist() == active
cdr = m.Cdr(m.read(folder + 'a.mcap')['messages']['/palpate/frames'][0][1])
assert [cdr.number('q'), cdr.number('q'), cdr.number('B')] == [1000000, -2**63, 1]
assert [(cdr.number('I'), cdr.number('B')) for _ in range(2)] == [(1, 0b0010), (1, 0b0011)]  # active, kept
)");
  for (const char* name : {"a.h5", "a.mcap"}) expectSame(profile, openRecording(folder / name));
}

// Earlier programs read values below 0 of filtered frames as 0, and refuse version 2.
TEST(McapRecording, onlyFilteredFramesNeedTheNewestLayout) {
  const TemporaryFolder folder;
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 2, 1.0)});
  for (const bool isFiltered : {false, true}) {
    ProfileBuilder builder(layout);
    builder.addFrame(1'000'000, std::vector<float>{0.5F, 1.0F});
    TactileFrame frame(layout);
    frame.hostUs = 2'000'000;
    if (isFiltered) frame.setFiltered({-5.5F, 7.5F}, {true, false});
    builder.addFrame(frame);
    const Profile profile = builder.finish({});
    saveRecording(profile, {}, folder / "a.h5", Overwrite::kReplace);
    write(profile, folder / "a.mcap");
    for (const char* name : {"a.h5", "a.mcap"}) expectSame(profile, openRecording(folder / name));
    runMcapPython(folder, "version = " + std::string(isFiltered ? "2" : "1") + R"(
import h5py
assert h5py.File(folder + 'a.h5').attrs['format_version'] == version
about = m.read(folder + 'a.mcap')['metadata']['palpate']
assert about['layout_version'] == str(version) and about['value_type'] == 'float'
)");
  }
}

TEST(McapRecording, imagesOfOtherProgramsAreMatricesOfAPlainHand) {
  const TemporaryFolder folder;
  runMcapPython(folder, R"(
for name, chunk in ('loose', 0), ('chunks', 3):
  w = m.Writer(folder + name + '.mcap', chunk)
  for i in range(5):
    at = 10**18 + i * 10**7
    w.message('/right', 'sensor_msgs/msg/Image', m.cdr_image(at, [[i, 2, 3], [4, 5, 255]], 'mono8', padding=1), at)
    w.message('/left', 'sensor_msgs/msg/Image', m.cdr_image(at, [[300 + i, 65535]], 'mono16', big=True), at + 5)
    w.message('/float', 'sensor_msgs/msg/Image', m.cdr_image(at + 1000 * (i == 4), [[0.5 * i]], '32FC1'), at)
    w.message('/other', 'std_msgs/msg/String', b'\0\1\0\0', at)
    w.message('/joints', 'sensor_msgs/msg/JointState', m.cdr_joints(at + 7000, ['a', 'b'], [math.pi, i]), at)
  w.close()
)");
  for (const char* name : {"loose.mcap", "chunks.mcap"}) {
    const Profile profile = openRecording(folder / name);
    ASSERT_EQ(profile.layout().numMatrices(), 3u);  // in the order of names: /float, /left, /right
    EXPECT_EQ(profile.hand().matrixName(1), "/left");
    EXPECT_EQ(profile.layout().matrix(2).rows, 2);
    EXPECT_EQ(profile.layout().matrix(2).columns, 3);
    ASSERT_EQ(profile.numFrames(), 6u);  // the last image of /float came a microsecond later
    EXPECT_EQ(profile.frameTimeUs(3), 1'000'000'000'030'000);
    EXPECT_EQ(profile.frame(3).values, (std::vector<float>{1.5F, 303, 65535, 3, 2, 3, 4, 5, 255}));
    EXPECT_EQ(profile.frame(4).values[0], 1.5F);  // the one before holds
    EXPECT_EQ(profile.frameTimeUs(5), 1'000'000'000'040'001);
    EXPECT_EQ(profile.frame(5).values, (std::vector<float>{2.0F, 304, 65535, 4, 2, 3, 4, 5, 255}));
    ASSERT_EQ(profile.numAngles(), 5u);
    EXPECT_EQ(profile.angleTimeUs(0), 1'000'000'000'000'007);
    EXPECT_DOUBLE_EQ(profile.angles(2).values[0], 180.0);
    EXPECT_EQ(profile.hand().axes.at(1).name, "b");
    EXPECT_EQ(verifyRecording(folder / name).state, VerifyReport::State::kSound);
    EXPECT_TRUE(readEvents(folder / name).events.empty());
  }
}

// Another program put the same records into chunks of three messages, or of one.
TEST(McapRecording, aFileThatWasWrittenAnewWithOtherChunksIsTheSame) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(2, true, 100);
  write(profile, folder / "a.mcap");
  runMcapPython(folder, R"(
data = open(folder + 'a.mcap', 'rb').read()
for size in 1, 3:
  out = open(folder + f'{size}.mcap', 'wb')
  out.write(m.MAGIC)
  waiting = []
  def end_chunk():
    raw = b''.join(waiting)
    waiting.clear()
    out.write(m.record(6, struct.pack('<QQQI', 0, 0, len(raw), 0) + m.text('') + struct.pack('<Q', len(raw)) + raw))
  for opcode, at, content in m.records(data, 8, len(data) - 8):
    if opcode == 6:
      for _, _, message in m.records(content[40:], 0, len(content) - 40):
        waiting.append(m.record(5, message))
        if len(waiting) == size: end_chunk()
    elif opcode == 15:
      if waiting: end_chunk()
      out.write(m.record(15, bytes(4)) + m.record(2, bytes(20)) + m.MAGIC)
      break
    elif opcode != 7:
      out.write(m.record(opcode, content))
  out.close()
)");
  for (const char* name : {"1.mcap", "3.mcap"}) {
    const Recording read = readMcap(folder / name);
    expectSame(profile, read.profile);
    EXPECT_EQ(read.events, kEvents);
    EXPECT_EQ(readMcapEvents(folder / name).events, kEvents);
    EXPECT_EQ(recoverMcap(folder / name).profile.numFrames(), 100u);
  }
}

TEST(McapRecording, whatCantBeReadOfOtherProgramsIsOneLineEach) {
  const TemporaryFolder folder;
  runMcapPython(folder, R"(
def made(name, *images, schema='sensor_msgs/msg/Image', encoding='cdr', **options):
  w = m.Writer(folder + name + '.mcap', **options)
  for i, (at, rows, form) in enumerate(images):
    w.message('/camera', schema, m.cdr_image(at, rows, form), 1000 + i, encoding)
  w.close()
made('none')
made('large', (1000, [[0] * 257], 'mono8'))
made('colors', (1000, [[1, 2, 3]], 'rgb8'))
made('type', (5000, [[1]], 'mono8'), schema='my/msg/Image')
made('ros1', (5000, [[1]], 'mono8'), schema='sensor_msgs/Image', encoding='ros1')
made('compression', (5000, [[1]], 'mono8'), chunk=1, compression='snappy')
w = m.Writer(folder + 'short.mcap')
w.message('/camera', 'sensor_msgs/msg/Image', m.cdr_image(5000, [[1, 2, 3]], 'mono8')[:-2], 1)
w.close()
with open(folder + 'version.mcap', 'wb') as f: f.write(b'\x89MCAP1\r\n' + bytes(100))
with open(folder + 'hello.mcap', 'w') as f: f.write('hello')
)");
  testing::expectOpeningError(folder / "none.mcap", "has no images");
  testing::expectOpeningError(folder / "type.mcap", "has no images");
  testing::expectOpeningError(folder / "large.mcap", "257 x 1 pixels");
  testing::expectOpeningError(folder / "colors.mcap", "encoding \"rgb8\"");
  testing::expectOpeningError(folder / "ros1.mcap", "only cdr");
  testing::expectOpeningError(folder / "compression.mcap", "unknown compression, \"snappy\"");
  testing::expectOpeningError(folder / "short.mcap", "damaged image");
  testing::expectOpeningError(folder / "version.mcap", "MCAP file of version 0");
  testing::expectOpeningError(folder / "hello.mcap", "MCAP file of version 0");
}

// Replaces bytes in a file without compression and makes the checksums unknown.
void changeBytes(const fs::path& from,
                 const fs::path& to,
                 const std::string& before,
                 const std::string& after) {
  std::string bytes = testing::readFile(from);
  std::size_t at = bytes.find(before);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(before.size(), after.size());
  for (; at != std::string::npos; at = bytes.find(before, at + 1))
    bytes.replace(at, after.size(), after);
  testing::writeFile(to, bytes);
}

TEST(McapRecording, damagedAndNewerFilesNameWhatIsWrong) {
  const TemporaryFolder folder;
  write(randomProfile(1, false, 300), folder / "a.mcap");
  changeBytes(folder / "a.mcap", folder / "data.mcap", "00ff", "00fe");
  testing::expectOpeningError(folder / "data.mcap",
                              "the checksum of its data section is wrong; 'palpate recover'");
  changeBytes(folder / "a.mcap", folder / "changed.mcap", "mono16", "mono17");
  testing::expectOpeningError(folder / "changed.mcap", "chunk 0 is damaged: its checksum is wrong");
  const std::string whole = testing::readFile(folder / "a.mcap");
  // Without the checksum of the data section, too.
  std::string bytes = testing::readFile(folder / "changed.mcap");
  std::size_t end = bytes.rfind(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
  ASSERT_NE(end, std::string::npos);
  bytes.replace(end + 9, 4, 4, '\0');
  testing::writeFile(folder / "chunk.mcap", bytes);
  testing::expectOpeningError(folder / "chunk.mcap", "chunk 0 is damaged: its checksum is wrong");
  // Metadata of a newer layout; the data's checksum is switched off, too.
  bytes = whole;
  bytes.replace(end + 9, 4, 4, '\0');
  const std::string version = "layout_version" + std::string("\1\0\0\0", 4);
  bytes[bytes.find(version) + version.size()] = '4';
  testing::writeFile(folder / "newer.mcap", bytes);
  testing::expectOpeningError(folder / "newer.mcap", "newer Palpate");
  bytes = whole;
  bytes.replace(end + 9, 4, 4, '\0');
  bytes.replace(bytes.find("/palpate/frames"), 15, "/palpate/framez");
  bytes.replace(bytes.rfind("/palpate/frames"), 15, "/palpate/framez");
  testing::writeFile(folder / "summary.mcap", bytes);
  testing::expectOpeningError(folder / "summary.mcap", "the checksum of its summary is wrong");
  // Lengths that lie, at any place.
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    bytes = whole;
    bytes.replace(random() % (bytes.size() - 8), 8, 8, '\xFF');
    testing::writeFile(folder / "bad.mcap", bytes);
    EXPECT_NE(openingError(folder / "bad.mcap"), "") << round;
  }
}

TEST(McapRecording, anyChangedByteIsFoundAndTheRestIsSaved) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(1, false, 300);
  write(profile, folder / "a.mcap", smallChunks(McapCompression::kZstd));
  const std::string whole = testing::readFile(folder / "a.mcap");
  std::mt19937 random(7);
  std::size_t saved = 0;
  for (int round = 0; round < 80; ++round) {
    std::string bad = whole;
    bad[8 + random() % (bad.size() - 16)] ^= static_cast<char>(1 + random() % 255);
    testing::writeFile(folder / "bad.mcap", bad);
    EXPECT_NE(openingError(folder / "bad.mcap"), "") << round;
    const VerifyReport report = verifyRecording(folder / "bad.mcap");
    EXPECT_NE(report.state, VerifyReport::State::kSound) << round;
    if (report.state == VerifyReport::State::kUnreadable) continue;
    ++saved;
    const Recording read = readableRecording(folder / "bad.mcap");
    EXPECT_FALSE(read.damage.text.empty());
    // Whatever is read is a frame of the recording.
    for (std::size_t i = 0; i < read.profile.numFrames(); ++i) {
      const auto at = profile.frameAt(read.profile.frameTimeUs(i));
      ASSERT_TRUE(at && profile.frameTimeUs(*at) == read.profile.frameTimeUs(i));
      ASSERT_EQ(read.profile.frame(i).values, profile.frame(*at).values) << round;
    }
  }
  EXPECT_GT(saved, 40u);
}

TEST(McapRecording, aFileThatIsCutOffAnywhereIsReadUpToThere) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(1, false, 1500);
  write(profile, folder / "a.mcap", smallChunks(McapCompression::kLz4));
  const std::string whole = testing::readFile(folder / "a.mcap");
  std::size_t before = 0;
  for (std::size_t length = 8; length < whole.size(); length += whole.size() / 40) {
    testing::writeFile(folder / "cut.mcap", whole.substr(0, length));
    const std::string error = openingError(folder / "cut.mcap");
    EXPECT_NE(error.find("cut off"), std::string::npos) << error;
    EXPECT_NE(error.find("'palpate recover'"), std::string::npos) << error;
    std::size_t frames = 0;
    try {
      frames = recoverMcap(folder / "cut.mcap").profile.numFrames();
    } catch (const FormatError&) {
      EXPECT_EQ(before, 0u);
    }
    EXPECT_GE(frames, before);
    before = frames;
  }
  EXPECT_GT(before, 1400u);
  const RecoverReport report = recoverRecording(folder / "cut.mcap", folder / "saved.palpate");
  EXPECT_EQ(report.state, RecoverReport::State::kPart);
  EXPECT_EQ(openRecording(folder / "saved.palpate").numFrames(), before);
  EXPECT_EQ(readRecordingMeta(folder / "saved.palpate").at("operator"), "A. B.\xFF");
}

TEST(McapRecording, aFullDiskIsAnErrorAndLeavesNothing) {
  testing::expectFullDiskLeavesNothing("a.mcap", writeUsual);
}

TEST(McapRecording, cancellingAndASeriesThatFailsLeaveNothing) {
  const auto fails = [](std::size_t) -> testing::SeriesRow {
    throw FormatError("a.dsa", "damaged");
  };
  const TemporaryFolder folder;
  const Profile profile = randomProfile(1, false, 5000);
  ExportExtras extras;
  extras.series.push_back(testing::seriesOf(5000, fails));
  EXPECT_THROW(writeMcap({profile, {}, {}, extras}, folder / "a.mcap"), FormatError);
  EXPECT_THROW(writeMcap({profile, {}, {}, ExportExtras{}},
                         folder / "a.mcap",
                         Overwrite::kRefuse,
                         [](double) { return false; }),
               Cancelled);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  McapWriteOptions wrong;
  wrong.level = 0;
  EXPECT_THROW(
      writeMcap(
          {profile, {}, {}, ExportExtras{}}, folder / "a.mcap", Overwrite::kRefuse, {}, wrong),
      std::invalid_argument);
}

TEST(McapRecording, notesCantBeAdded) {
  const TemporaryFolder folder;
  write(randomProfile(1, false, 10), folder / "a.mcap");
  EXPECT_THROW(saveEvents(folder / "a.mcap", readEvents(folder / "a.mcap"), kEvents), FileError);
}

// -- Live --

TEST(McapLiveWriter, whatIsFlushedCanBeReadBeforeTheEnd) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(4, true, 400);
  McapLiveWriter writer(folder / "a.mcap", profile.hand(), {{"program", "palpate 9"}});
  writer.addEvent(kOddEvent);
  for (std::size_t i = 0; i < 300; ++i) writer.addFrame(profile.frame(i));
  writer.flush();
  writer.addFrame(profile.frame(300));
  EXPECT_NE(openingError(folder / "a.mcap").find("is being written"), std::string::npos);
  const Recording read = recoverMcap(folder / "a.mcap");
  ASSERT_EQ(read.profile.numFrames(), 300u);
  EXPECT_EQ(read.profile.frame(299).values, profile.frame(299).values);
  EXPECT_EQ(read.profile.frame(297).filtered, profile.frame(297).filtered);
  for (std::size_t i = 0; i < profile.numAngles(); ++i) writer.addSample(profile.angles(i));
  for (std::size_t i = 301; i < 400; ++i) writer.addFrame(profile.frame(i));
  for (std::size_t i = 0; i < profile.numTemperatures(); ++i)
    writer.addSample(profile.temperatures(i));
  writer.finish();
  const Recording whole = readMcap(folder / "a.mcap");
  EXPECT_EQ(testing::dumped(whole.profile), testing::dumped(profile));
  EXPECT_EQ(whole.events, std::vector<Event>{kOddEvent});
}

TEST(McapLiveWriter, seriesComeBackWithTheirDescriptions) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(4, false, 3);
  McapLiveWriter writer(folder / "a.mcap", profile.hand(), {});
  const SeriesDescription cell{"cell", "trigger", {{"f", "N"}}, "tcp:1"};
  const SeriesDescription imu{"imu", "", {{"ax", "m/s^2"}, {"ay", ""}}, ""};
  writer.addSeries(kHandSeries + 4, cell);  // any index
  writer.addFrame(profile.frame(0));
  writer.addSample({10, {0.1}, kHandSeries + 4, 7});
  writer.addSeries(kHandSeries + 1, imu);
  writer.addSample({5, {std::nan(""), -2.0}, kHandSeries + 1});
  writer.addSample({11, {0.2}, kHandSeries + 4});
  EXPECT_THROW(writer.addSample({12, {1.0, 2.0}, kHandSeries + 4}), std::invalid_argument);
  EXPECT_THROW(writer.addSample({11, {1.0}, kHandSeries + 4}), std::invalid_argument);
  EXPECT_THROW(writer.addSample({13, {1.0}, kHandSeries + 2}), std::invalid_argument) << "no such";
  EXPECT_THROW(writer.addSample({13, {1.0}, kMaxSeries}), std::invalid_argument);
  EXPECT_THROW(writer.addSeries(kMaxSeries, imu), std::invalid_argument);
  EXPECT_THROW(writer.addSeries(kAngleSeries, imu), std::invalid_argument);
  writer.finish();
  const Profile read = openRecording(folder / "a.mcap");
  ASSERT_EQ(read.furtherSeries().size(), 2u);
  for (std::size_t s = kHandSeries; s < kHandSeries + 2; ++s) {
    const bool isCell = read.series()[s].name == "cell";
    EXPECT_EQ(read.series()[s], isCell ? cell : imu);
    ASSERT_EQ(read.numSamples(s), isCell ? 2u : 1u);
    const Sample first = read.sample(s, 0);
    EXPECT_EQ(first.hostUs, isCell ? 10 : 5);
    EXPECT_EQ(first.deviceUs, isCell ? std::optional<std::int64_t>(7) : std::nullopt);
    EXPECT_EQ(first.values.back(), isCell ? 0.1 : -2.0);
    EXPECT_EQ(std::isnan(first.values.front()), !isCell);
  }
  EXPECT_EQ(verifyRecording(folder / "a.mcap").state, VerifyReport::State::kSound);
}

TEST(McapLiveWriter, refusesWhatDoesNotFitAndAddsNothing) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(4, false, 3);
  McapLiveWriter writer(folder / "a.mcap", profile.hand(), {});
  writer.addFrame(profile.frame(1));
  EXPECT_THROW(writer.addFrame(profile.frame(0)), std::invalid_argument);
  EXPECT_THROW(writer.addFrame(testing::sampleFrame(99)), std::invalid_argument);
  writer.addSample({1, {1.0, 2.0}});
  EXPECT_THROW(writer.addSample({2, {1.0}}), std::invalid_argument);
  writer.finish();
  EXPECT_EQ(openRecording(folder / "a.mcap").numFrames(), 1u);
  EXPECT_THROW(McapLiveWriter(folder / "a.mcap", profile.hand(), {}), FileError);
  EXPECT_THROW(McapLiveWriter(folder / "no/a.mcap", profile.hand(), {}), FileError);
}

TEST(McapLiveWriter, aFullDiskLeavesTheWholeChunks) {
  const TemporaryFolder folder;
  const Profile profile = randomProfile(1, false, 5000);
  const auto full = [&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    McapLiveWriter writer(folder / "a.mcap", profile.hand(), {}, smallChunks());
    try {
      for (std::size_t i = 0; i < 5000; ++i) writer.addFrame(profile.frame(i));
    } catch (const FileError&) {
      try {
        writer.addFrame(profile.frame(4999));
        writer.finish();
      } catch (const FileError&) {
        ::_exit(7);
      }
    }
    ::_exit(0);
  };
  EXPECT_EXIT(full(), ::testing::ExitedWithCode(7), "");
  const Recording read = recoverMcap(folder / "a.mcap");
  EXPECT_GT(read.profile.numFrames(), 50u);
  EXPECT_EQ(read.profile.frame(49).values, profile.frame(49).values);
}

}  // namespace
}  // namespace palpate::mcap_recording_test
