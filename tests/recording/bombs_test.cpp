// Small MCAP and NumPy files that claim or unpack to too much: little memory and work, and one line
// that says what was not read.
#include "palpate/core/error.h"
#include "palpate/imports/recording_import.h"
#include "palpate/imports/table_source.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/mcap_recording.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_writer.h"
#include "palpate/recording/recording.h"

#include "imports/import_samples.h"
#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::bombs_test {
namespace {
namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr std::uint64_t kMemoryLimit = 256u << 20;  // reliability table, R13

// Makes files with Python. `w` begins a file, chunk(records, filler, compression) adds a chunk:
// records, and one more that nobody knows of so many bytes. Zstandard frames are made by hand
// (RFC 8878): a block of bytes as they are, and blocks of one repeated byte.
void make(const TemporaryFolder& folder, const std::string& script) {
  testing::runPython(folder,
                     "import sys, struct, zlib\nsys.path.insert(0, '" PALPATE_MCAP_CHECK_FOLDER
                     "')\nsys.dont_write_bytecode = True\nimport mcap_check as m\n"
                     "folder = sys.argv[1] + '/'\n"
                     R"(
def block(kind, size, last=False): return struct.pack('<I', last | kind << 1 | size << 3)[:3]
def zstd(start, repeated):
  out = struct.pack('<IBI', 0xFD2FB528, 0xA0, len(start) + repeated)
  out += block(0, len(start)) + start
  while repeated > 0:
    size = min(repeated, 128 << 10)
    repeated -= size
    out += block(1, size, repeated == 0) + b'\0'
  return out
def chunk(records, filler):
  start = records + struct.pack('<BQ', 0x80, filler)
  size = len(start) + filler
  return m.record(6, struct.pack('<QQQI', 0, 0, size, 0) + m.text('zstd') +
                  struct.pack('<Q', len(zstd(start, filler))) + zstd(start, filler))
def image(w, at): w.message('/camera', 'sensor_msgs/msg/Image', m.cdr_image(at, [[1, 2]], 'mono8'), at)
)" + script);
}

template <typename Work>
void expectLittleMemory(Work work) {
  const std::uint64_t memory = testing::memoryOf(work);
  if (testing::kMemoryIsOurs) {
    EXPECT_LT(memory, kMemoryLimit);
  }
}

std::string refusalOf(const fs::path& path) {
  return testing::errorOf([&] { openRecording(path); });
}

void expectRefusal(const fs::path& path, const std::string& words) {
  const std::string error = refusalOf(path);
  EXPECT_NE(error.find(words), std::string::npos) << path << ": " << error;
  expectLittleMemory([&] { return !refusalOf(path).empty(); });
}

Profile someFrames() {
  const auto layout =
      std::make_shared<const SensorLayout>(std::vector<MatrixLayout>{MatrixLayout::full(1, 2, 1)});
  ProfileBuilder builder(layout);
  for (int i = 0; i < 10; ++i)
    builder.addFrame(1'600'000'000'000'000 + i, std::vector<float>{1.0F, 2.0F});
  return builder.finish({});
}

// 250,000 letters each.
std::vector<Event> longEvents(std::size_t count) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < count; ++i) {
    const auto timeUs = static_cast<std::int64_t>(i);
    events.push_back({timeUs, timeUs, "note", {}, std::string(250'000, 'x'), ""});
  }
  return events;
}

// They are no damage: what is read is sound.
TEST(McapBombs, eventsBeyond64MegabytesAreLeftOutAndCounted) {
  const TemporaryFolder folder;
  const fs::path path = folder / "events.mcap";
  // Elsewhere: what was freed would count below.
  testing::memoryOf([&] {
    writeMcap({someFrames(), longEvents(300), {}, {}}, path);
    return true;
  });
  expectLittleMemory([&] { return readableRecording(path).events.size() == 268; });
  EXPECT_LT(fs::file_size(path), 300'000u);
  const EventsReport report = readEvents(path);
  // 268 x 250,000 bytes are less than 64 MB, 269 are more.
  EXPECT_EQ(report.events.size(), 268u);
  EXPECT_EQ(report.damaged, 32u);
  EXPECT_EQ(report.events.back().tUs, 267);
  EXPECT_EQ(openRecording(path).numFrames(), 10u);
  const std::string words = "32 events beyond the 64 MB that are read were left out";
  const VerifyReport verified = verifyRecording(path);
  EXPECT_EQ(verified.state, VerifyReport::State::kSound);
  EXPECT_TRUE(verified.message.ends_with("; " + words)) << verified.message;
  const Recording readable = readableRecording(path);
  EXPECT_EQ(readable.events.size(), 268u);
  EXPECT_EQ(readable.damage.text, "");
  EXPECT_EQ(readable.damage.events, 32u);
  const RecoverReport recovered = recoverRecording(path, folder / "out.palpate");
  EXPECT_EQ(recovered.state, RecoverReport::State::kPart);
  EXPECT_TRUE(recovered.message.ends_with("; " + words)) << recovered.message;
  EXPECT_EQ(readEvents(folder / "out.palpate").events.size(), 269u);  // and where it comes from
}

// They waited in memory until the end, and were refused there.
TEST(NativeBombs, eventsOfAnyNumberAreWritten) {
  const TemporaryFolder folder;
  const fs::path path = folder / "events.palpate";
  const std::vector<Event> events = longEvents(kMaxPendingBytes / 250'000 + 10);
  writePalpate(someFrames(), events, path, Overwrite::kRefuse);
  EXPECT_EQ(readEvents(path).events.size(), events.size());
}

TEST(McapBombs, chunksThatUnpackToMuchAreRefused) {
  const TemporaryFolder folder;
  make(folder, R"(
for name, chunks, filler in ('large', 1, 66 << 20), ('many', 10, 60 << 20):
  w = m.Writer(folder + name + '.mcap', 10)
  image(w, 1000)
  w.file.write(chunk(b''.join(w.waiting), filler) + (chunks - 1) * chunk(b'', filler))
  w.waiting = []
  w.close()
)");
  expectRefusal(folder / "large.mcap", "has a chunk of 66 MB at byte ");
  expectRefusal(folder / "many.mcap", "unpack to more than 1032 times the size of the file");
  // What stands before it is saved.
  EXPECT_EQ(recoverMcap(folder / "many.mcap").profile.numFrames(), 1u);
}

// Another program's chunks of this size, one after the other.
TEST(McapBombs, largeChunksAreReadOneAtATime) {
  const TemporaryFolder folder;
  make(folder, R"(
w = m.Writer(folder + 'camera.mcap', 1000)
for i in range(7):
  image(w, 1000 + 1000 * i)
  w.file.write(chunk(b''.join(w.waiting), 60 << 20))
  w.waiting = []
w.close()
)");
  const fs::path path = folder / "camera.mcap";
  expectLittleMemory([&] {
    const Profile profile = openRecording(path);
    TactileFrame frame(profile.hand().layout);
    for (std::size_t i = 0; i < profile.numFrames(); ++i) profile.readFrame(i, frame);
    return profile.numFrames() == 7 && frame.values == std::vector<float>{1.0F, 2.0F};
  });
}

// The same filler among the chunks of a recording of Palpate's: two threads read them.
TEST(McapBombs, largeChunksOfARecordingAreReadOneAtATime) {
  const TemporaryFolder folder;
  McapWriteOptions options;
  options.compression = McapCompression::kNone;
  writeMcap({someFrames(), {}, {}, {}}, folder / "a.mcap", Overwrite::kRefuse, {}, options);
  make(folder, R"(
data = open(folder + 'a.mcap', 'rb').read()
out = open(folder + 'fill.mcap', 'wb')
out.write(m.MAGIC)
for opcode, at, content in m.records(data, 8, len(data) - 8):
  if opcode == 15:
    out.write(7 * chunk(b'', 60 << 20) + m.record(15, bytes(4)) + m.record(2, bytes(20)) + m.MAGIC)
    break
  out.write(m.record(opcode, content))
out.close()
)");
  expectLittleMemory([&] {
    return openRecording(folder / "fill.mcap").numFrames() == 10 &&
           verifyRecording(folder / "fill.mcap").state == VerifyReport::State::kSound;
  });
}

// Two topics whose messages lie in two chunks that don't both fit into memory, in turns.
TEST(McapBombs, messagesInTurnsOverManyLargeChunksAreRefused) {
  const TemporaryFolder folder;
  make(folder, R"(
w = m.Writer(folder + 'turns.mcap', 1000)
for start in 1000, 2000:
  for i in range(20):
    w.message('/camera%d' % start, 'sensor_msgs/msg/Image',
              m.cdr_image(start + 10000 * i, [[1, 2]], 'mono8'), 1)
  w.file.write(chunk(b''.join(w.waiting), 60 << 20))
  w.waiting = []
w.close()
)");
  expectRefusal(folder / "turns.mcap", "in too many chunks at a time");
}

// Chunks of one message each.
TEST(McapBombs, theOrderOfManyMessagesIsCheckedUntilItIsCancelled) {
  const TemporaryFolder folder;
  make(folder, R"(
w = m.Writer(folder + 'small.mcap', 1)
for i in range(1000): image(w, 1000 + 1000 * i)
w.close()
)");
  EXPECT_EQ(readMcap(folder / "small.mcap").profile.numFrames(), 1000u);
  EXPECT_THROW(readMcap(folder / "small.mcap", [](double fraction) { return fraction < 0.9999; }),
               Cancelled);
}

TEST(McapBombs, manyKeysAreRefused) {
  const TemporaryFolder folder;
  make(folder, R"(
keys = b''.join(m.text('%06d' % i) + m.text('') for i in range(200000))
data = struct.pack('<I', len(keys)) + keys
with open(folder + 'metadata.mcap', 'wb') as f:
  f.write(m.MAGIC + m.record(1, m.text('') + m.text('')) + m.record(12, m.text('palpate_meta') + data))
with open(folder + 'channel.mcap', 'wb') as f:
  f.write(m.MAGIC + m.record(1, m.text('') + m.text('')) +
          m.record(4, struct.pack('<HH', 1, 1) + m.text('/a') + m.text('cdr') + data))
# One channel after the other, each with a large text, in chunks.
w = m.Writer(folder + 'channels.mcap', 1000)
image(w, 1000)
for i in range(20):
  w.put(m.record(4, struct.pack('<HH', 100 + i, 1) + m.text('/a') + m.text('cdr') +
                 struct.pack('<I', 1000008) + m.text('k' * 1000000) + m.text('')))
w.close()
)");
  expectRefusal(folder / "metadata.mcap", "has too much metadata");
  expectRefusal(folder / "channel.mcap", "too many texts in its schemas and channels");
  expectRefusal(folder / "channels.mcap", "too many texts in its schemas and channels");
}

TEST(NpzBombs, wideRowsAreRefusedWhereTheyAreTaken) {
  const TemporaryFolder folder;
  make(folder, R"(
import zipfile
def npy(shape):
  header = "{'descr': '|u1', 'fortran_order': False, 'shape': %s, }" % (shape,)
  count = 1
  for size in shape: count *= size
  return b'\x93NUMPY\1\0' + struct.pack('<H', len(header)) + header.encode() + bytes(count)
def npz(name, arrays):
  with zipfile.ZipFile(folder + name, 'w', zipfile.ZIP_DEFLATED) as z:
    for key, data in arrays: z.writestr(key + '.npy', data)
npz('wide.npz', [('a', npy((2, 1 << 18))), ('b', npy((2, 4)))])
wide = npy((2, 1 << 17))
npz('together.npz', [('a%d' % i, wide) for i in range(64)])
npz('entries.npz', [('a%d' % i, npy((2,))) for i in range(10001)])
header = "{'descr': '|u1', 'fortran_order': False, 'shape': (1,), }" + ' ' * 1000000
long = b'\x93NUMPY\2\0' + struct.pack('<I', len(header)) + header.encode() + b'\0'
npz('headers.npz', [('a%d' % i, long) for i in range(20)])
)");
  const auto refusal = [&](const char* name) {
    return testing::errorOf([&] { openTable(folder / name); });
  };
  const auto wide = openTable(folder / "wide.npz");
  const std::size_t columns[] = {0, 1};
  EXPECT_NE(testing::errorOf([&] {
              wide->start(columns, std::nullopt);
            }).find("\"a\" has too many numbers per row"),
            std::string::npos);
  wide->start(std::span(columns).last(1), std::nullopt);
  TableRow row;
  ASSERT_TRUE(wide->next(row));
  EXPECT_EQ(row.values.size(), 4u);
  ImportMapping rate;
  rate.time.rateHz = 100.0;
  const ImportPreview preview = previewImport(folder / "wide.npz", testing::pad(2, 2), rate);
  EXPECT_EQ(preview.problem, "");
  EXPECT_EQ(preview.sample.frames, 2u);
  EXPECT_NE(refusal("entries.npz").find("zip directory that is too large"), std::string::npos);
  EXPECT_NE(refusal("headers.npz").find("too many arrays"), std::string::npos);
  const auto source = openTable(folder / "together.npz");
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < source->columns().size(); ++i) all.push_back(i);
  ASSERT_EQ(all.size(), 64u);
  EXPECT_NE(testing::errorOf([&] { source->start(all, std::nullopt); }).find("has rows of 8388608"),
            std::string::npos);
  expectLittleMemory([&] {
    previewImport(folder / "together.npz", testing::pad(2, 2), {});
    return true;
  });
}

// A line of a few megabytes held millions of columns.
TEST(TextBombs, tooManyColumnsAreRefused) {
  const TemporaryFolder folder;
  std::string line;
  for (int i = 0; i < 500'000; ++i) line += "1,";
  testing::writeFile(folder / "wide.csv", line + "\n" + line + "\n");
  EXPECT_NE(testing::errorOf([&] {
              openTable(folder / "wide.csv");
            }).find("has more than 131072 columns"),
            std::string::npos);
  // Blanks at the end of a line are no columns.
  testing::writeFile(folder / "blanks.csv",
                     "1,2\n3,4" + std::string(500'000, ' ') + "\n5," + std::string(500'000, ' '));
  EXPECT_EQ(openTable(folder / "blanks.csv")->columns().size(), 2u);
}

}  // namespace
}  // namespace palpate::bombs_test
