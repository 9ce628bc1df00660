// MCAP files of other programs: images as the matrices of a plain hand. Private to
// this module.
#pragma once

#include "palpate/recording/mcap_recording.h"

#include "recording/mcap/mcap_structure.h"

namespace palpate {

// As readMcap() says; `topics`: the only ones that are read, or empty: all. In a salvage, damaged
// chunks are left out. Throws FormatError, FileError, Cancelled.
Recording readForeignMcap(McapFile file,
                          McapStructure structure,
                          const std::vector<std::string>& topics,
                          const Progress& progress,
                          bool salvage);

}  // namespace palpate
