// The first lasting contact of a recording: the moment by which two recordings of a grasp are laid
// on top of each other. One active taxel in one frame is noise; several of them in several frames
// in a row are a touch. Active taxel: enabled, value > 0.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

struct FirstContactOptions {
  int frames = 3;  // in a row, 1..1,000,000
  int taxels = 3;  // active in each of them, over all matrices, 1..1,000,000

  // Throws std::invalid_argument with the field's name.
  void validate() const;
};

// The first of the first `frames` frames in a row with at least `taxels` active taxels each;
// nothing when there are none. Frames on both sides of a gap are not in a row. Throws
// std::invalid_argument for bad options. `active`: active taxels per frame; `gapFrames`: last frame
// before each gap, ascending.
std::optional<std::size_t> firstContact(std::span<const int> active,
                                        std::span<const std::size_t> gapFrames = {},
                                        const FirstContactOptions& options = {});
// Reads frames until it is found. Throws Cancelled as well.
std::optional<std::size_t> firstContact(const Profile& profile,
                                        std::span<const std::size_t> gapFrames = {},
                                        const FirstContactOptions& options = {},
                                        const Progress& progress = {});

}  // namespace palpate
