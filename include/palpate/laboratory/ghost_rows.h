// How well filters remove ghosts, as a result table: a row for each recipe and source of frames.
// docs/manual/tables.md explains the columns.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/json.h>
#include <palpate/core/result_table.h>
#include <palpate/emulator/noisy_contacts.h>
#include <palpate/filter/ghosting.h>

namespace palpate {

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

// A recipe on a source.
struct GhostRow {
  Recipe recipe;
  GhostSource source;
  GhostingReport report;
};
// The table "ghosts" of rows that are made when they are read; `more` as in RowTable. Of emulated
// frames it has columns of contacts, of others the column `file`.
std::unique_ptr<ResultTable> ghostTable(bool emulated,
                                        std::function<bool(std::vector<GhostRow>& rows)> more);
// All that is known of one, also per matrix and per contact.
Json ghostJson(const GhostRow& row, bool emulated);

}  // namespace palpate
