// MCAP files of other programs: images of one channel as the matrices of a plain hand. Private to
// this module.
#pragma once

#include "palpate/recording/mcap_recording.h"

#include "recording/mcap/mcap_structure.h"

namespace palpate {

// As readMcap() says; in a salvage, damaged chunks are left out. Throws FormatError, FileError,
// Cancelled.
McapRecording readForeignMcap(McapFile file,
                              McapStructure structure,
                              const Progress& progress,
                              bool salvage);

}  // namespace palpate
