// writeMcap() and McapLiveWriter of mcap_recording.h.
#include <cerrno>
#include <map>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/file_id.h"
#include "palpate/core/output_file.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/in_time_order.h"
#include "palpate/recording/mcap_recording.h"

#include "recording/mcap/mcap_recording_writer.h"
#include "recording/profile_meta.h"
#include "recording/running_series.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMcapFramesPerReport = 1024;

[[noreturn]] void throwMcapCantWrite(const fs::path& path, int error) {
  throw FileError(path, "can't be written: " + writeFailureText(error));
}

}  // namespace

void writeMcap(const RecordingContent& content,
               const fs::path& path,
               Overwrite overwrite,
               const Progress& progress,
               const McapWriteOptions& options) {
  options.validate();
  const Profile& profile = content.profile;
  OutputFile out(path, overwrite);
  McapRecordingWriter writer([&out](std::string_view bytes) { out.write(bytes); },
                             profile.hand(),
                             profile.hasCounts(),
                             writtenMeta(profile.info(), profile.hand(), content.meta),
                             content.extras.provenance,
                             options);
  if (profile.numAngles() > 0) writer.beginAngles(profile.angles(0).values.size());
  if (profile.numTemperatures() > 0)
    writer.beginTemperatures(profile.temperatures(0).values.size());
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    writer.beginSamples(i, profile.series()[i]);
  std::vector<std::pair<std::uint16_t, std::unique_ptr<RunningSeries>>> series;
  for (const auto& one : content.extras.series)
    series.emplace_back(writer.beginSeries(one->name(), one->columns()),
                        std::make_unique<RunningSeries>(*one, "writeMcap"));

  const auto writeRows = [&](std::int64_t endUs, bool all) {
    for (auto& [channel, rows] : series)
      for (auto next = rows->nextUs(); next && (all || *next <= endUs); next = rows->nextUs()) {
        writer.addRow(channel, *next, rows->row());
        rows->advance();
      }
  };
  TactileFrame frame;
  InTimeOrder order(profile, content.events);
  while (const auto item = order.take()) {
    switch (const std::size_t i = item->index; item->kind) {
      case InTimeOrder::Kind::kEvent:
        writer.addEvent(content.events[i]);
        break;
      case InTimeOrder::Kind::kSample:
        writer.addSample(profile.sample(item->series, i));
        break;
      case InTimeOrder::Kind::kFrame:
        reportProgress(progress, i, profile.numFrames(), kMcapFramesPerReport);
        profile.readFrame(i, frame);
        writer.addFrame(frame);
        writeRows(frame.hostUs, false);
        break;
    }
  }
  writeRows(0, true);
  writer.file().finish();
  out.commit();
}

struct McapLiveWriter::Impl {
  Impl(const fs::path& givenPath,
       const HandDescription& hand,
       const RecordingMeta& meta,
       McapWriteOptions options)
      : path(givenPath) {
    options.validate();
    options.threads = 1;
    constexpr mode_t kMode = 0666;  // reduced by the umask, as for other files
    file = FileDescriptor(
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kMode));
    if (file.get() < 0 && errno == EEXIST) throw FileError(path, "exists already");
    if (file.get() < 0) throwMcapCantWrite(path, errno);
    Provenance from;
    const auto program = meta.find("program");
    if (program != meta.end()) from.program = program->second;
    writer = std::make_unique<McapRecordingWriter>(
        [this](std::string_view bytes) { write(bytes); }, hand, std::nullopt, meta, from, options);
    layout = hand.layout;
  }

  // Of bytes that can't be written whole none stays, so that the file ends with whole records.
  void write(std::string_view bytes) {
    if (failed) throwMcapCantWrite(path, EIO);
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t now = ::write(file.get(), bytes.data() + done, bytes.size() - done);
      if (now < 0 && errno == EINTR) continue;
      if (now < 0) {
        const int error = errno;
        failed = true;
        if (::ftruncate(file.get(), static_cast<off_t>(size)) != 0) {
          // What remains of the record is cut off; recovery finds that.
        }
        throwMcapCantWrite(path, error);
      }
      done += static_cast<std::size_t>(now);
    }
    size += bytes.size();
  }

  void requireFile() const {
    if (const auto id = fileIdOf(file.get())) requireLeadsTo(path, *id);
  }

  static void requireLater(std::optional<std::int64_t>& last, std::int64_t timeUs) {
    if (last && timeUs <= *last)
      throw std::invalid_argument("McapLiveWriter: a stamp is not later than the one before");
    last = timeUs;
  }

  const fs::path path;
  FileDescriptor file;
  std::uint64_t size = 0;
  bool failed = false;
  std::shared_ptr<const SensorLayout> layout;
  std::unique_ptr<McapRecordingWriter> writer;
  std::optional<std::int64_t> lastFrameUs;
  std::map<std::size_t, std::optional<std::int64_t>> lastSampleUs;  // by series
};

McapLiveWriter::McapLiveWriter(const fs::path& path,
                               const HandDescription& hand,
                               const RecordingMeta& meta,
                               const McapWriteOptions& options)
    : impl_(std::make_unique<Impl>(path, hand, meta, options)) {}

McapLiveWriter::~McapLiveWriter() = default;

void McapLiveWriter::addFrame(const TactileFrame& frame) {
  if (!frame.layout || !(*frame.layout == *impl_->layout))
    throw std::invalid_argument("McapLiveWriter: a frame of another layout");
  Impl::requireLater(impl_->lastFrameUs, frame.hostUs);
  impl_->writer->addFrame(frame);
}

void McapLiveWriter::addSeries(std::size_t series, const SeriesDescription& description) {
  if (series < kHandSeries || series >= kMaxSeries)
    throw std::invalid_argument("McapLiveWriter: there is no series " + std::to_string(series));
  impl_->writer->beginSamples(series, description);
}

void McapLiveWriter::addSample(const Sample& sample) {
  Impl::requireLater(impl_->lastSampleUs[sample.series], sample.hostUs);
  impl_->writer->addSample(sample);
}

void McapLiveWriter::addEvent(const Event& event) { impl_->writer->addEvent(event); }

void McapLiveWriter::flush() {
  impl_->requireFile();
  impl_->writer->file().flush();
}

void McapLiveWriter::finish() {
  impl_->writer->file().finish();
  if (::fsync(impl_->file.get()) != 0) throwMcapCantWrite(impl_->path, errno);
  impl_->requireFile();
}

}  // namespace palpate
