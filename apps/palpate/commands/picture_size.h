// Parses the sizes of pictures and windows on the command line.
#pragma once

#include <QSize>
#include <string>

namespace palpate::commands {

// Parses "1280x800" [px], from `smallest` to 8192 x 8192. Throws UsageError.
QSize parsedSize(const std::string& text, const QSize& smallest);

}  // namespace palpate::commands
