// The messages of a recording, written into an MCAP file sample by sample; writeMcap() and
// McapLiveWriter use it. Private to this module.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "palpate/model/hand_joints.h"
#include "palpate/recording/mcap_recording.h"

#include "recording/mcap/mcap_file_writer.h"

namespace palpate {

class McapRecordingWriter {
 public:
  // `counts`: all frames have whole counts; without it each frame tells. What the profile says by
  // itself stands in `meta` already.
  McapRecordingWriter(McapFileWriter::Write write,
                      const HandDescription& hand,
                      std::optional<bool> counts,
                      const RecordingMeta& meta,
                      const Provenance& provenance,
                      const McapWriteOptions& options);

  // Begin a channel. Call them before the samples.
  void beginAngles(std::size_t width);
  void beginTemperatures(std::size_t width);
  // A series beside those of the hand; from here on the file has a version that earlier programs
  // refuse.
  void beginSamples(std::size_t series, const SeriesDescription& description);
  std::uint16_t beginSeries(const std::string& name, const std::vector<Column>& columns);

  // Throw std::invalid_argument (another number of values, a value that is no count).
  void addFrame(const TactileFrame& frame);
  void addSample(const Sample& sample);
  void addEvent(const Event& event);
  void addRow(std::uint16_t series, std::int64_t timeUs, std::span<const double> values);

  McapFileWriter& file() noexcept { return file_; }

 private:
  // Writes what is said about the file, in this version of the layout, unless it has that already.
  void requireVersion(int version);
  std::uint16_t valuesChannel(const std::string& topic, const std::vector<Column>& columns);
  void addValues(std::uint16_t channel, std::int64_t timeUs, std::span<const double> values);
  void addAngles(const Sample& angles);
  void addTemperatures(const Sample& temperatures);
  void addImage(std::size_t matrix, const TactileFrame& frame, bool counts);

  const HandDescription hand_;
  const std::optional<bool> counts_;
  const McapImages images_;
  McapFileWriter file_;
  McapFileWriter::Texts about_;
  int version_ = 0;  // of the layout, so far
  std::optional<std::uint16_t> valuesSchema_;
  std::optional<std::uint16_t> sampleSchema_;
  std::uint16_t frames_ = 0;
  std::vector<std::uint16_t> imageChannels_;
  std::vector<std::string> frameIds_;
  std::uint16_t events_ = 0;
  std::uint16_t log_ = 0;
  std::optional<std::uint16_t> angles_;
  std::uint16_t jointStates_ = 0;
  std::vector<HandJoint> joints_;
  std::string jointNames_;  // of a JointState: from behind the stamp to before the positions
  std::optional<std::uint16_t> temperatures_;
  struct SampleChannel {
    std::uint16_t id = 0;
    std::size_t width = 0;
  };
  std::map<std::size_t, SampleChannel> samples_;  // of further series
  std::size_t numAngles_ = 0;
  std::size_t numTemperatures_ = 0;
};

}  // namespace palpate
