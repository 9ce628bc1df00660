#include "palpate/batch/grasp_files.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/recognition/grasp_segments.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/label_table.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kNumberField = "{n}";
constexpr const char* kSegment = "segment";

std::string withNumber(std::string text, const std::string& number) {
  for (std::size_t at = text.find(kNumberField); at != std::string::npos;
       at = text.find(kNumberField, at + number.size()))
    text.replace(at, kNumberField.size(), number);
  return text;
}

std::string numberOf(std::size_t number, std::size_t count) {
  constexpr std::size_t kMinDigits = 2;
  std::string text = std::to_string(number);
  const std::size_t digits = std::max(kMinDigits, std::to_string(count).size());
  return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
}

// Frames within a span of time [us]; nothing: end before begin.
GraspFrames framesWithin(const Profile& profile, std::int64_t fromUs, std::int64_t toUs) {
  const auto last = profile.frameAt(toUs);
  if (!last || profile.frameTimeUs(*last) < fromUs) return {1, 0};
  std::size_t first = profile.frameAt(fromUs).value_or(0);
  if (profile.frameTimeUs(first) < fromUs) ++first;
  if (profile.frameTimeUs(*last) > toUs) return {1, 0};
  return {first, *last};
}

}  // namespace

std::vector<GraspFrames> graspFrames(const Profile& profile,
                                     std::span<const Event> events,
                                     const Progress& progress) {
  std::vector<GraspFrames> grasps;
  if (profile.numFrames() == 0) return grasps;
  const bool corrected = std::any_of(
      events.begin(), events.end(), [](const Event& event) { return event.kind == kSegment; });
  if (!corrected) {
    for (const GraspSegment& found : findGrasps(profile, {}, progress))
      grasps.push_back({found.begin, found.end});
    return grasps;
  }
  for (const Event& event : events) {
    if (event.kind != kSegment || !isTabledLabel(event)) continue;
    const GraspFrames frames = framesWithin(profile, event.tUs, event.t1Us);
    if (frames.begin <= frames.end) grasps.push_back(frames);
  }
  std::stable_sort(grasps.begin(), grasps.end(), [](const GraspFrames& a, const GraspFrames& b) {
    return a.begin < b.begin;
  });
  return grasps;
}

GraspTemplate::GraspTemplate(std::string text) : text_(std::move(text)) {
  if (fs::path(text_).filename().string().find(kNumberField) == std::string::npos)
    throw std::invalid_argument("'" + shortened(text_) +
                                "' has no {n}, the number of the grasp, in its name; use one such "
                                "as out/{name}_{n}.palpate");
  planned();
}

GraspTemplate::GraspTemplate(fs::path folder, std::string below) : GraspTemplate(std::move(below)) {
  folder_ = std::move(folder);
  planned();
}

BatchTemplate GraspTemplate::numbered(const std::string& number) const {
  const std::string text = withNumber(text_, number);
  return folder_ ? BatchTemplate(*folder_, text) : BatchTemplate(text);
}

BatchTemplate GraspTemplate::planned() const { return numbered(numberOf(1, 1)); }

fs::path GraspTemplate::pathFor(const BatchNameFields& fields,
                                std::size_t number,
                                std::size_t count) const {
  return numbered(numberOf(number, count)).pathFor(fields);
}

std::string GraspTemplate::ending() const { return fs::path(text_).extension().string(); }

void saveGrasps(const fs::path& source,
                const Profile& profile,
                std::span<const Event> events,
                std::span<const GraspFrames> grasps,
                std::span<const fs::path> paths,
                const GraspFilesOptions& options,
                const Progress& progress) {
  if (paths.size() != grasps.size())
    throw std::invalid_argument("each grasp needs a separate file");
  const auto overwriteOf = [&options](const fs::path& path) {
    const auto& ours = options.replaceable;
    return std::find(ours.begin(), ours.end(), path) != ours.end() ? Overwrite::kReplace
                                                                   : options.overwrite;
  };
  std::set<fs::path> taken;
  for (const fs::path& path : paths) {
    formatOf(path);
    requireOther(source, path);
    requireWritable(path, overwriteOf(path));
    if (!taken.insert(path.lexically_normal()).second)
      throw FileError(path, "would be the file of two grasps");
  }
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const auto shareOf = [&](double from, double to) {
      const auto done = static_cast<double>(i), all = static_cast<double>(grasps.size());
      return partOf(progress, (done + from) / all, (done + to) / all);
    };
    try {
      const Profile part = cropped(profile, grasps[i].begin, grasps[i].end, shareOf(0.0, 0.5));
      std::error_code ignored;
      fs::create_directories(paths[i].parent_path(), ignored);  // saving says what is wrong
      saveRecording(part,
                    eventsWithin(events, part),
                    paths[i],
                    overwriteOf(paths[i]),
                    shareOf(0.5, 1.0),
                    options.extras ? options.extras(part, paths[i]) : SaveExtras());
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      if (i == 0) throw;
      throw Error(std::string(error.what()) + "; before it " + std::to_string(i) + " of " +
                  counted(grasps.size(), "grasp") + (i == 1 ? " was" : " were") + " written");
    }
  }
}

}  // namespace palpate
