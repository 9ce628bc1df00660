// Small profiles and frames of the SDH-2 with known content; no window.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>
#include <palpate/recording/recording_data.h>

namespace palpate::gui {

// A profile of the SDH-2 with one frame per stamp [ms]; frame i has the value 10 * (i + 1) counts
// in row 7, column 2 of finger 0 distal (matrix 1), and nothing else.
Profile profileWithStamps(const std::vector<std::int64_t>& stampsMs);
// As above with 20 frames, 50 ms apart.
Profile twentyFrames();
// Three frames whose times count from 0.
Profile undatedFrames();
// A reader of recordings that makes up their samples. Their events are those of the file, if it is
// there.
std::function<Recording(const std::filesystem::path&, const Progress&)> asRecording(
    std::function<Profile(const std::filesystem::path&, const Progress&)> read);
// One frame of the SDH-2, all zero.
TactileFrame emptyFrame();

}  // namespace palpate::gui
