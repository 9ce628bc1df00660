#include "gui/hand/hand_actions.h"

namespace palpate::gui {

HandActions::HandActions(ActionRegistry& book) {
  graspHand = book.make("graspHand", "Hand", "&Grasp", {key("Ctrl+Alt+G")});
  reactiveGrasp = book.make("reactiveGrasp", "Hand", "&Reactive grasp", {key("Ctrl+Alt+R")});
  slipAwareGrasp = book.make("slipAwareGrasp", "Hand", "Slip-&aware grasp", {key("Ctrl+Alt+S")});
  openHand = book.make("openHand", "Hand", "&Open the hand", {key("Ctrl+Alt+O")});
  relaxHand = book.make("relaxHand", "Hand", "Rela&x", {key("Ctrl+Alt+X")});
  stopHand = book.make("stopHand", "Hand", "&Stop the hand (Esc)");
}

}  // namespace palpate::gui
