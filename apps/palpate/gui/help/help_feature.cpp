#include "gui/help/help_feature.h"

#include "gui/help/about_dialog.h"
#include "gui/help/keys_dialog.h"

namespace palpate::gui {

HelpFeature::HelpFeature(Bench& bench, QWidget* window) : Feature(bench, window) {
  on(bench.actions.keys, [window] {
    auto* dialog = new KeysDialog(window->actions(), window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
  on(bench.actions.about, [window] {
    auto* dialog = new AboutDialog(window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
}

}  // namespace palpate::gui
