// A file of its own for each grasp of a recording, with the labels that belong to it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/batch/batch_plan.h>
#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording.h>

namespace palpate {

// Frames of a grasp, both inclusive.
struct GraspFrames {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool operator==(const GraspFrames&) const = default;
};

// The grasps as a person has corrected them (events "segment"; one that holds no frame is left
// out); without such events those that findGrasps() finds by its general rule. In order of time.
// Throws Cancelled.
std::vector<GraspFrames> graspFrames(const Profile& profile,
                                     std::span<const Event> events,
                                     const Progress& progress = {});

// Names files by a template of batches (batch_plan.h) with one more field, {n}: the number of the
// grasp from 1, with at least two digits.
class GraspTemplate {
 public:
  // Throws std::invalid_argument as BatchTemplate does, and when the name has no {n}.
  explicit GraspTemplate(std::string text);
  // The template `below`, a relative path, in a folder that is taken as it is, also with braces.
  GraspTemplate(std::filesystem::path folder, std::string below);
  // Names the file of the first grasp: for the plan of a batch.
  BatchTemplate planned() const;
  // `count`: of the grasps of the recording; all its numbers have as many digits. Throws Error when
  // the name is not allowed.
  std::filesystem::path pathFor(const BatchNameFields& fields,
                                std::size_t number,
                                std::size_t count) const;
  // Of the files, with its dot.
  std::string ending() const;

 private:
  BatchTemplate numbered(const std::string& number) const;

  std::optional<std::filesystem::path> folder_;
  std::string text_;
};

struct GraspFilesOptions {
  Overwrite overwrite = Overwrite::kRefuse;
  // Files that may be replaced in any case.
  std::vector<std::filesystem::path> replaceable = {};
  // What is saved beside a grasp; may be empty: nothing.
  std::function<SaveExtras(const Profile& part, const std::filesystem::path& out)> extras = {};
};
// Saves each grasp with the events that touch it. `paths` has one for each
// grasp. Throws std::invalid_argument when it hasn't; FileError: before anything is written when a
// file exists already (kRefuse) or is `source`; Cancelled. Files that were written before a failure
// are whole, and stay.
void saveGrasps(const std::filesystem::path& source,
                const Profile& profile,
                std::span<const Event> events,
                std::span<const GraspFrames> grasps,
                std::span<const std::filesystem::path> paths,
                const GraspFilesOptions& options = {},
                const Progress& progress = {});

}  // namespace palpate
