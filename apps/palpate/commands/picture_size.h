// Sizes of pictures and windows on the command line.
#pragma once

#include <QSize>
#include <string>

namespace palpate::commands {

// "1280x800": pixels, 320..8192 each. Throws UsageError.
QSize parsedSize(const std::string& text);

}  // namespace palpate::commands
