#include "gui/recognise/recognise_actions.h"

namespace palpate::gui {

RecogniseActions::RecogniseActions(ActionRegistry& book) {
  whatIsIt = book.make("whatIsIt", "Hand", "&What is it?", {key("Q")});
  whatIsIt->setToolTip("Recognises the selected grasp, or what is held (Q)");
  presentationMode =
      book.make("showMode", "Hand", "The answer on the whole &screen", {key("Shift+Q")});
}

}  // namespace palpate::gui
