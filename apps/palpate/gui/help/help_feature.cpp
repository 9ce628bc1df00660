#include "gui/help/help_feature.h"

#include "gui/help/about_dialog.h"
#include "gui/help/keys_dialog.h"

namespace palpate::gui {

HelpFeature::HelpFeature(WindowState& windowState, QWidget* window) : Feature(windowState, window) {
  QAction* keys = windowState.actions.make("keys", "Help", "&Keys", {key("F1")});
  QAction* about = windowState.actions.make("about", "Help", "&About Palpate");
  windowState.actions.setIcon(keys, IconShape::kHelp);
  on(keys, [window] {
    auto* dialog = new KeysDialog(window->actions(), window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
  on(about, [window] {
    auto* dialog = new AboutDialog(window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
}

}  // namespace palpate::gui
