// A recording as an MCAP file, the container of ROS 2 and Foxglove (specification: mcap.dev/spec);
// docs/notes/exchange_formats.md has its topics. It holds all of a recording (frames, stamps,
// series, events, hand, what was said of it) bit by bit, so that it can be read back, and beside
// that where it comes from and series that were computed of its frames. MCAP files of other
// programs are read as far as they have images with one value per pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording_data.h>

namespace palpate {

// The newest version of the topics that is read. Only recordings with further series, or with
// taxels that aren't square (`pitch_y_mm`), are written in it; those with filtered frames, which
// have `kept`, have version 2, and all others version 1, so that earlier programs read them.
constexpr int kMcapLayoutVersion = 3;

// How the chunks of a file are compressed.
enum class McapCompression { kNone, kLz4, kZstd };
inline constexpr std::array<OptionWord<McapCompression>, 3> kMcapCompressionWords{
    {{"zstd", McapCompression::kZstd},
     {"lz4", McapCompression::kLz4},
     {"none", McapCompression::kNone}}};
// "none", "lz4", "zstd".
const char* nameOf(McapCompression compression) noexcept;

// The messages that hold the taxels of a matrix.
enum class McapImages {
  kRos,       // sensor_msgs/msg/Image in CDR; the file has the profile "ros2"
  kFoxglove,  // foxglove.RawImage in protobuf; the file has no profile
};
inline constexpr std::array<OptionWord<McapImages>, 2> kMcapImagesWords{
    {{"ros", McapImages::kRos}, {"foxglove", McapImages::kFoxglove}}};

struct McapWriteOptions {
  McapCompression compression = McapCompression::kZstd;
  int level = 1;  // of Zstandard, 1..19
  McapImages images = McapImages::kRos;
  std::size_t chunkBytes = 1u << 20;  // at about this size a chunk ends, 1 KiB..64 MiB
  // Threads that compress; 0: as many as the machine runs at once. The file is the same.
  std::size_t threads = 0;
  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Writes PATH, whole or not at all. Memory is bounded, whatever the length of the recording. Throws
// FileError, Cancelled, std::invalid_argument (options out of range), and what reading throws.
void writeMcap(const RecordingContent& content,
               const std::filesystem::path& path,
               Overwrite overwrite = Overwrite::kRefuse,
               const Progress& progress = {},
               const McapWriteOptions& options = {});

// Writes an MCAP file beside a recording that is being made. The file is there from the beginning;
// when the process is killed, its complete chunks can be read (recoverRecording()). Not
// thread-safe.
class McapLiveWriter {
 public:
  // Creates PATH (never replaces one). `hand`: its layout is that of all frames. `meta`: as for a
  // native recording. Throws FileError, std::invalid_argument (options).
  McapLiveWriter(const std::filesystem::path& path,
                 const HandDescription& hand,
                 const RecordingMeta& meta,
                 const McapWriteOptions& options = {});
  // Without finish() the file stays an unfinished one.
  ~McapLiveWriter();
  McapLiveWriter(const McapLiveWriter&) = delete;
  McapLiveWriter& operator=(const McapLiveWriter&) = delete;

  // Makes a series beside those of the hand known, before its first sample. Its index may be any
  // from kHandSeries on. Throws as addFrame().
  void addSeries(std::size_t series, const SeriesDescription& description);
  // Each appends. Throw FileError (the disk is full, ..): the file ends with its last whole chunk,
  // and nothing more can be added. Throw std::invalid_argument (a frame of another layout, stamps
  // that don't ascend): nothing was added.
  void addFrame(const TactileFrame& frame);
  void addSample(const Sample& sample);
  void addEvent(const Event& event);
  // Writes what waits for its chunk. Throws FileError, also when the file is no longer found under
  // its name.
  void flush();
  // Writes what waits and the summary, and syncs the file. Throws FileError as flush() does.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Of the events of a file, in memory: some 400,000. Those beyond it are left out and counted.
constexpr std::size_t kMaxMcapEventsBytes = 64u << 20;
// "32 events beyond the 64 MB that are read were left out".
std::string mcapEventsLeftOutText(std::size_t count);

// Reads a whole MCAP file through, all its checksums, and opens it. Stamps lie in memory; frames
// and samples are read when they are asked for, and the profile is safe from several
// threads. Of the events the first 64 MB are read. Of another program's file each
// topic of images becomes a matrix of a plain hand, in the order of the topics' names: messages
// sensor_msgs/msg/Image (CDR) and foxglove.RawImage (protobuf) of the encodings mono8, mono16,
// 8UC1, 16UC1, 32FC1, at most 256 x 256. A frame is made at every stamp of any of them and holds
// the last image of each. The angles are those of the first topic of sensor_msgs/msg/JointState, by
// the names of the joints; each sample has the last value of each joint. Where the stamps of a
// topic don't ascend, all times are log times. What is left out as it can't be tactile data, and
// what is guessed, is in info().warnings of the profile; messages and values that are lost are in
// Damage::unused, and in the warnings, too (lostText()). `topics`: reads only these topics of
// another program's file. Throws FileError
// (`topics` for a recording of Palpate's); FormatError where it is cut off, damaged, compressed in
// another way, of a newer layout, where it has no images or one of `topics` can't be read;
// Cancelled.
Recording readMcap(const std::filesystem::path& path,
                   const Progress& progress = {},
                   std::size_t threads = 0,
                   const std::vector<std::string>& topics = {});
// Reads what can be read of a file that is cut off or damaged: without chunks whose checksum is
// wrong, and up to where it was cut; what is lost isn't in the warnings. Throws FileError,
// FormatError (nothing can be read), Cancelled.
Recording recoverMcap(const std::filesystem::path& path,
                      const Progress& progress = {},
                      std::size_t threads = 0,
                      const std::vector<std::string>& topics = {});
// The events, or the meta data, of a file that Palpate has written; of other files none.
// Only what they need is read. Throw as readMcap(). Events beyond kMaxMcapEventsBytes are left out
// and counted.
EventsReport readMcapEvents(const std::filesystem::path& path);
RecordingMeta readMcapMeta(const std::filesystem::path& path);

}  // namespace palpate
