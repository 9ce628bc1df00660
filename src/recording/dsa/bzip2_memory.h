// Memory for libbz2 that a thread's next decoder uses again. A decoder takes 3.6 MB, of which a
// small file needs little: fresh pages for every file cost a tenth of the time to read it. Private
// to this module.
#pragma once

#include <bzlib.h>

namespace palpate {

// Makes a stream, which must not be open yet, take its memory here. Each thread keeps one large
// piece, until it ends.
void useKeptMemory(bz_stream& stream) noexcept;

}  // namespace palpate
