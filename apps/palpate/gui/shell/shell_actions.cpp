#include "gui/shell/shell_actions.h"

namespace palpate::gui {

ShellActions::ShellActions(ActionRegistry& book) {
  quit = book.make("quit", "File", "&Quit", {key("Ctrl+Q")});
  nextTheme = book.make("nextTheme", "View", "Dark or light", {key("Ctrl+T")});
  fullScreen = book.make("fullScreen", "View", "&Full screen", {key("F11")}, true);
  resetLayout = book.make("resetLayout", "View", "&Reset layout", {key("Ctrl+Shift+R")});
  dismiss = book.make("dismiss",
                      "Help",
                      "Stop the hand; close the message, stop opening, leave full screen",
                      {key("Esc")});
  hideInMenus(*dismiss);
  themes = book.choices("themes", {"as the desktop", "dark", "light"});
}

}  // namespace palpate::gui
