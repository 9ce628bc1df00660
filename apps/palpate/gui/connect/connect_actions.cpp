#include "gui/connect/connect_actions.h"

#include "gui/appearance/icons.h"

namespace palpate::gui {

ConnectActions::ConnectActions(ActionRegistry& book) {
  connectHand = book.make("connectHand", "Hand", "&Connect…", {key("Ctrl+K")});
  tryEmulated = book.make("tryEmulated", "Hand", "Try the &emulated hand", {key("Ctrl+Shift+D")});
  disconnectHand = book.make("disconnectHand", "Hand", "&Disconnect", {key("Ctrl+Shift+K")});
  live = book.make("live", "Hand", "Show &live", {key("F6")}, true);
  live->setToolTip("Show the connected hand (F6)");
  hold = book.make("hold", "Hand", "&Hold the live picture", {key("P")}, true);
  live->setIconText(" Live");
  connectHand->setIconText(" " + plainText(*connectHand));
  book.setIcon(connectHand, IconShape::kConnect);
  book.setIcon(live, IconShape::kLive);
}

}  // namespace palpate::gui
