// The output of `palpate ghosts`: one row or JSON object for each recipe and source of frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/emulator/noisy_contacts.h>
#include <palpate/filter/ghosting.h>

namespace palpate::commands {

// A source of frames: a file or the emulated hand.
struct GhostSource {
  std::string file = {};
  double degC = 0.0;  // [deg C], of the emulated hand
  // How far the threshold is below the noise floor [counts]; nothing: the recording is used
  // unchanged.
  std::optional<double> belowCounts = {};
  std::vector<NoisyContact> contacts = {};
};

// A chain for each filter that may help against ghosts, and each preset; without duplicates.
std::vector<Recipe> ghostCandidates();

// The header row; for emulated frames with the columns of contacts.
std::vector<std::string> ghostHeader(bool emulated);
std::vector<std::string> ghostCells(const Recipe& recipe,
                                    const GhostSource& source,
                                    const GhostingReport& report,
                                    bool emulated);
Json ghostJson(const Recipe& recipe,
               const GhostSource& source,
               const GhostingReport& report,
               bool emulated);

}  // namespace palpate::commands
