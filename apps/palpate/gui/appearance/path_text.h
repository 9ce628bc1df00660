// Converts a std::filesystem::path into a QString.
#pragma once

#include <QString>
#include <filesystem>

namespace palpate::gui {

inline QString pathText(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace palpate::gui
