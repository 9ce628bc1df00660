// Finds rows of the block table in the raw bytes of an SQLite file, without SQLite: for pages that
// its b-trees no longer reach. Private to this module.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "palpate/recording/palpate_schema.h"

namespace palpate {

// Calls `found` for every record in `page` that looks like a block row and whose checksum is right
// (a wrong find is a matter of 2^-32). Records on overflow pages are not found: blocks are made to
// fit.
void scanPage(std::span<const std::byte> page, const std::function<void(Block)>& found);

}  // namespace palpate
