#include "gui/timeline/timeline_actions.h"

#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {

TimelineActions::TimelineActions(ActionRegistry& book) {
  saveEvents = book.make("saveEvents", "File", "&Save labels, notes and grasps", {key("Ctrl+S")});
  undo = book.make("undo", "Edit", "&Undo", {key("Ctrl+Z")});
  redo = book.make("redo", "Edit", "&Redo", {key("Ctrl+Shift+Z"), key("Ctrl+Y")});
  addLabel = book.make("addLabel", "Edit", "&Label the selection or the frame…", {key("Ctrl+B")});
  addNote =
      book.make("addNote", "Edit", "&Note on the selection or the moment…", {key("Ctrl+Shift+B")});
  addGrasp = book.make("addGrasp", "Edit", "&Mark the selection as a grasp", {key("Ctrl+Shift+P")});
  renameEvent = book.make("renameEvent", "Edit", "Rename the e&vent", {key("F2")});
  removeEvent = book.make("removeEvent", "Edit", "&Delete the event", {key("Del")});
  nextEvent = book.make("nextEvent", "Edit", "Ne&xt event", {key("N")});
  nextEvent->setToolTip("Choose and select the next grasp, label, .. of the row (N)");
  previousEvent = book.make("previousEvent", "Edit", "&Previous event", {key("Shift+N")});
  toEvents = book.make("toEvents", "Edit", "&Keyboard focus to the events", {key("F7")});
  selectFrom = book.make("selectFrom", "Edit", "Selection begins &here", {key("[")});
  selectTo = book.make("selectTo", "Edit", "Selection &ends here", {key("]")});
  selectAll = book.make("selectAll", "Edit", "Select &all", {key("Ctrl+A")});
  crop = book.make("crop", "Edit", "&Crop to a new recording…");
  saveAs = book.make("saveAs", "File", "Save &as…");
  saveAs->setToolTip(
      "Save the whole recording with its labels, notes and grasps as another recording, or in a "
      "format of other programs");
  zoomSelection = book.make("zoomSelection", "Edit", "&Zoom to the selection", {key("Ctrl+Alt+Z")});
  dropSelection = book.make("dropSelection", "Edit", "Select n&othing");
  statistics = book.make("statistics", "Analysis", "Stat&istics of the selection…");
  statistics->setToolTip("Show mean, deviation, extremes, slope and integral of every curve");
  statistics->setIconText("Statistics…");
  differences = book.make(
      "differences", "Analysis", "&Differences between the ends of the selection", {}, true);
  differences->setToolTip("Show Δt, and the change of every curve, at the ends of the selection");
  nameTaxels = book.make("nameTaxels", "Edit", "Nam&e the chosen taxels…");
  newFormula = book.make("newFormula", "Analysis", "Curve by a &formula or filter…");
  newFormula->setToolTip("Add a slope, a difference, a filtered curve, or any formula of signals");
  chooseCurves = book.make("chooseCurves", "View", "Cu&rves in the timeline…");
  zoomIn = book.make("zoomIn", "View", "Zoom the timeline &in", {key("Ctrl++"), key("Ctrl+=")});
  zoomOut = book.make("zoomOut", "View", "Zoom the timeline &out", {key("Ctrl+-")});
  fit = book.make("fit", "View", "Show the &whole timeline", {key("Ctrl+0")});
  axes = book.make("verticalAxes", "View", "Vertical axes &by hand…");
  axes->setToolTip(
      "Set the ranges of the vertical axes: automatic or by hand, linear or logarithmic");
  freeze = book.make("freezeLive", "Hand", "&Freeze the live chart", {}, true);
  lanes = book.make("liveLanes", "Hand", "A lane f&or each finger", {}, true);
  lanes->setToolTip("Draw the curves of each finger of the live chart above those of the next one");
  newest = book.make("liveNewest", "Hand", "&Newest frame in the live chart", {key("End")});
  oldest = book.make("liveOldest", "Hand", "Ol&dest frame in the live chart", {key("Home")});
  earlier = book.make("liveEarlier", "Hand", "Ea&rlier in the live chart", {key("Alt+Left")});
  later = book.make("liveLater", "Hand", "&Later in the live chart", {key("Alt+Right")});
  cursorBack = book.make("cursorBack", "Hand", "Cursor a frame &back");
  cursorForward = book.make("cursorForward", "Hand", "Cursor a frame for&ward");
  cursorBack->setToolTip("Move the live chart cursor that was set last");
  cursorForward->setToolTip("Move the live chart cursor that was set last");
  takeBaseline =
      book.make("takeBaseline", "Hand", "Baseline of the last second", {key("Ctrl+Alt+L")});
  takeBaseline->setToolTip(
      "Take the baseline, and its noise, from the last second: nothing may touch the sensor "
      "(Ctrl+Alt+L)");
  takeBaseline->setIconText("Baseline");
  undoBaseline = book.make("undoBaseline", "Hand", "Restore the previous baseline");
  baselineOfSelection = book.make("baselineOfSelection", "Edit", "Baseline from the selection");
  baselineOfSelection->setToolTip(
      "Take the baseline of the whole recording, and its noise, from the selection");
  crop->setIconText("Crop…");
  addLabel->setIconText("Label…");
  zoomSelection->setIconText("Zoom");
  dropSelection->setIconText("×");
  QStringList names;
  for (const PlottedSignal signal : kAllPlottedSignals) names.append(nameOf(signal));
  signalsPlotted = book.choices("signalsPlotted", names);
}

}  // namespace palpate::gui
