// What `palpate ghosts` prints: a row or a JSON object for each recipe and source of frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/emulator/noisy_contacts.h>
#include <palpate/filter/ghosting.h>

namespace palpate::commands {

// Where frames come from: a file, or the emulated hand.
struct GhostSource {
  std::string file = {};
  double degC = 0.0;  // emulated
  // Counts under the noise floor's thresholds; nothing: a recording as it is.
  std::optional<double> belowCounts = {};
  std::vector<NoisyContact> contacts = {};
};

// A chain for each filter that might help against ghosts, and each preset, once.
std::vector<Recipe> ghostCandidates();

// Of emulated frames the columns of contacts, too.
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
