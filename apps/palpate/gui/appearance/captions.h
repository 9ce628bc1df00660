// Headings, numbers and paths in the form that all docks use.
#pragma once

#include <QString>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include <palpate/core/number_text.h>

class QLabel;
class QWidget;

namespace palpate::gui {

// The small heading of a part of a dock, for example "JOINT ANGLES".
QLabel* sectionHeading(const QString& text, QWidget* parent);
// The value with so many decimals, independent of the locale: "31.7".
QString figure(double value, int decimals);

// A count with its noun, as counted(): "1 frame", "2 frames".
inline QString numberOf(std::uint64_t count, std::string_view noun) {
  return QString::fromStdString(counted(count, noun));
}

// A message of the library in the words of the window: the menu entry instead of the command.
QString inWindowWords(QString message);

// Converts a std::filesystem::path into a QString.
inline QString pathText(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace palpate::gui
