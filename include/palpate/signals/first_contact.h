// Finds the first lasting contact of a recording, by which two recordings of a grasp are aligned.
// One active taxel in one frame may be noise; several of them in several consecutive frames are a
// contact. A taxel is active when it is enabled and its value is above 0.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <palpate/core/progress.h>
#include <palpate/model/profile.h>

namespace palpate {

// How many taxels and frames make a contact.
struct FirstContactOptions {
  int frames = 3;  // consecutive frames, 1..1,000,000
  // Taxels that are active in each of these frames, over all matrices, 1..1,000,000.
  int taxels = 3;

  // Throws std::invalid_argument that names the field.
  void validate() const;
};

// Returns the first of the first `frames` consecutive frames with at least `taxels` active taxels
// each; empty when there are none. Frames on both sides of a gap are not consecutive. `active` is
// the number of active taxels per frame; `gapFrames` are the last frames before each gap,
// ascending. Throws std::invalid_argument for bad options.
std::optional<std::size_t> firstContact(std::span<const int> active,
                                        std::span<const std::size_t> gapFrames = {},
                                        const FirstContactOptions& options = {});
// Does the same for a profile and reads frames until the contact is found. With `unreadable`,
// frames that can't be read are added to it; they interrupt a contact. Also throws Cancelled, and
// without `unreadable` Error.
std::optional<std::size_t> firstContact(const Profile& profile,
                                        std::span<const std::size_t> gapFrames = {},
                                        const FirstContactOptions& options = {},
                                        const Progress& progress = {},
                                        UnreadableSamples* unreadable = nullptr);

}  // namespace palpate
