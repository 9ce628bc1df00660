// A path as Qt writes it.
#pragma once

#include <QString>
#include <filesystem>

namespace palpate::gui {

inline QString pathText(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace palpate::gui
