// The dock Library: recordings of a folder. It stays as it is, whatever else is shown.
#pragma once

#include "gui/window_state/feature.h"

namespace palpate::gui {

class LibraryPanel;

class LibraryFeature : public Feature {
  Q_OBJECT
 public:
  LibraryFeature(WindowState& windowState, QWidget* window);

  LibraryPanel& panel() noexcept { return *panel_; }
  std::vector<DockSpec> docks() override;

 private:
  void compareWith(const std::filesystem::path& path);

  LibraryPanel* panel_;
  Dock* dock_;
};

}  // namespace palpate::gui
