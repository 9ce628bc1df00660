// Headings, numbers and paths in the form that all docks use.
#pragma once

#include <QString>
#include <filesystem>

class QLabel;
class QWidget;

namespace palpate::gui {

// The small heading of a part of a dock, for example "JOINT ANGLES".
QLabel* sectionHeading(const QString& text, QWidget* parent);
// The value with so many decimals, independent of the locale: "31.7".
QString figure(double value, int decimals);

// Converts a std::filesystem::path into a QString.
inline QString pathText(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace palpate::gui
