// The feature with the dock Library, which lists the recordings of a folder. The dock does not
// depend on the shown source.
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
