#include "gui/bench/actions.h"

#include <QWidget>
#include <algorithm>
#include <iterator>

#include "gui/look/color_map.h"
#include "gui/look/icons.h"
#include "gui/look/plotted_signal.h"
#include "gui/look/window_settings.h"
#include "gui/source/playback_controller.h"

namespace palpate::gui {
namespace {

constexpr const char* kSectionProperty = "section";
constexpr const char* kKindProperty = "kind";
constexpr const char* kKindKeysProperty = "kindKeys";
constexpr int kMatricesWithKeys = 9;
constexpr int kDigits = 10;

QKeySequence key(const char* text) { return QKeySequence(QString(text)); }

template <class Choices, class Choice>
void checkChoice(const QActionGroup* group, const Choices& all, Choice now) {
  const auto index = std::find(std::begin(all), std::end(all), now) - std::begin(all);
  if (index < group->actions().size()) group->actions().at(index)->setChecked(true);
}

}  // namespace

QString sectionOf(const QAction& action) { return action.property(kSectionProperty).toString(); }

void setSection(QAction& action, const QString& section) {
  action.setProperty(kSectionProperty, section);
}

void setKind(const QList<QAction*>& actions, const QString& keys, const QString& what) {
  for (QAction* action : actions) {
    action->setProperty(kKindProperty, what);
    action->setProperty(kKindKeysProperty, keys);
  }
}

std::optional<ActionKind> kindOf(const QAction& action) {
  const QString what = action.property(kKindProperty).toString();
  if (what.isEmpty()) return std::nullopt;
  return ActionKind{action.property(kKindKeysProperty).toString(), what};
}

QString plainText(const QAction& action) {
  QString text = action.text();
  text.remove('&');
  text.remove("…");
  return text;
}

QAction* Actions::make(const char* section,
                       const QString& text,
                       const QList<QKeySequence>& sequences,
                       bool checkable) {
  auto* action = new QAction(text, window_);
  action->setShortcuts(sequences);
  action->setCheckable(checkable);
  setSection(*action, section);
  if (!sequences.isEmpty())
    action->setToolTip(plainText(*action) + " (" +
                       sequences.first().toString(QKeySequence::NativeText) + ")");
  window_->addAction(action);
  return action;
}

QActionGroup* Actions::choices(const QStringList& names) {
  auto* group = new QActionGroup(window_);
  for (const QString& name : names) {
    auto* action = new QAction(name, group);
    action->setCheckable(true);
    action->setData(group->actions().size() - 1);
  }
  return group;
}

Actions::Actions(QWidget* window) : window_(window) {
  open = make("File", "&Open…", {key("Ctrl+O")});
  openDemo = make("File", "Open the &demo recording", {key("Ctrl+D")});
  nextRecording = make("File", "&Next open recording", {key("Ctrl+Tab")});
  previousRecording = make("File", "&Previous open recording", {key("Ctrl+Shift+Tab")});
  closeRecording = make("File", "&Close recording", {key("Ctrl+W")});
  saveEvents = make("File", "&Save labels, notes and grasps", {key("Ctrl+S")});
  exportPicture = make("File", "&Export…", {key("Ctrl+E")});
  exportAgain = make("File", "Export as &last time", {key("Ctrl+Shift+E")});
  copyPicture = make("File", "Cop&y", {key("Ctrl+C")});
  copyPicture->setToolTip("Copy the view that was clicked into last (Ctrl+C)");
  copyTable = make("File", "Copy &table", {key("Ctrl+Alt+C")});
  quit = make("File", "&Quit", {key("Ctrl+Q")});

  undo = make("Edit", "&Undo", {key("Ctrl+Z")});
  redo = make("Edit", "&Redo", {key("Ctrl+Shift+Z"), key("Ctrl+Y")});
  addLabel = make("Edit", "&Label the selection or the moment…", {key("Ctrl+B")});
  addNote = make("Edit", "&Note on the selection or the moment…", {key("Ctrl+Shift+B")});
  addGrasp = make("Edit", "The selection is a &grasp", {key("Ctrl+Shift+P")});
  renameEvent = make("Edit", "Re&name the event", {key("F2")});
  removeEvent = make("Edit", "&Delete the event", {key("Del")});
  nextEvent = make("Edit", "Ne&xt event", {key("N")});
  nextEvent->setToolTip("Chooses and selects the next grasp, label, .. of the row (N)");
  previousEvent = make("Edit", "&Previous event", {key("Shift+N")});
  toEvents = make("Edit", "&Keyboard into the events", {key("F7")});
  selectFrom = make("Edit", "Selection begins &here", {key("[")});
  selectTo = make("Edit", "Selection &ends here", {key("]")});
  selectAll = make("Edit", "Select &all of it", {key("Ctrl+A")});
  crop = make("Edit", "&Crop to a new recording…", {key("Ctrl+Shift+X")});
  zoomSelection = make("Edit", "&Zoom to the selection", {key("Z")});
  dropSelection = make("Edit", "Select n&othing", {key("Ctrl+Shift+Space")});
  nameTaxels = make("Edit", "Name the chosen &taxels…", {key("Ctrl+Shift+G")});

  interpolated = make("View", "&Smooth", {key("I")}, true);
  interpolated->setToolTip("Smooth between taxels (I)");
  values = make("View", "&Values", {key("V")}, true);
  values->setToolTip("Print the value of each active taxel (V)");
  filtered = make("View", "&Filtered, or as recorded", {key("A")}, true);
  filtered->setToolTip("After the filters, or before (A)");
  nextMap = make("View", "Next &colour map", {key("M")});
  nextRange = make("View", "Next colour &range", {key("R")});
  nextSignal = make("View", "Next &signal in the timeline", {key("S")});
  chooseCurves = make("View", "C&urves in the timeline…", {key("C")});
  zoomIn = make("View", "Zoom the timeline &in", {key("Ctrl++"), key("Ctrl+=")});
  zoomOut = make("View", "Zoom the timeline &out", {key("Ctrl+-")});
  fit = make("View", "Show the &whole timeline", {key("F")});
  for (int i = 0; i < kMatricesWithKeys; ++i)
    plots.append(make("View",
                      "Plot matrix " + QString::number(i),
                      {QKeySequence("Ctrl+" + QString::number(i + 1))},
                      true));
  plots.append(make("View", "Plot all matrices together", {key("Ctrl+0")}, true));
  nextTheme = make("View", "Dark or light", {key("Ctrl+T")});
  const char* space = "Hand in space";
  matricesShown = make("View", "Show the &matrices", {key("Shift+H")}, true);
  handShown = make("View", "Show the &hand in space", {key("H")}, true);
  nextTaxelShape = make(space, "Taxels as the next: cells, bars, points, flat", {key("T")});
  nextSphere = make(space, "Next look of the enclosing &sphere", {key("B")});
  sphereOfCentroids = make(space, "Sphere around the &centroids", {key("Shift+B")}, true);
  normals = make(space, "&Normals of the taxels", {key("U")}, true);
  contacts = make(space, "&Contacts: centroids, axes, directions", {key("K")}, true);
  wire = make(space, "&Wire frame", {key("W")}, true);
  axes = make(space, "&Axes of the hand's base", {key("X")}, true);
  slipArrows = make(space, "&Slip: how contacts and object move", {key("Shift+K")}, true);
  fitHand = make(space, "All of it in the &picture", {key("E")});
  resetHand = make(space, "&Back to the first view", {key("Shift+E")});
  nearer = make(space, "&Nearer", {key("PgUp")});
  further = make(space, "&Further", {key("PgDown")});
  for (const char* way : {"Left", "Right", "Up", "Down"})
    orbits.append(
        make(space, "Turn " + QString(way).toLower(), {QKeySequence("Ctrl+" + QString(way))}));
  for (const char* way : {"Left", "Right", "Up", "Down"})
    pans.append(make(
        space, "Move " + QString(way).toLower(), {QKeySequence("Ctrl+Shift+" + QString(way))}));
  onlys.append(make(space, "The whole hand", {key("Alt+0")}, true));
  for (int i = 0; i < kMatricesWithKeys; ++i)
    onlys.append(make(space,
                      "Matrix " + QString::number(i) + " alone",
                      {QKeySequence("Alt+" + QString::number(i + 1))},
                      true));
  setKind(orbits, "Ctrl+arrows", "Turn it");
  setKind(pans, "Ctrl+Shift+arrows", "Move it");
  setKind(onlys.mid(1), "Alt+1 .. Alt+9", "One matrix alone");
  slipReference = make("View", "Slip is measured &from here", {key("O")});
  slipReference->setToolTip("The frame that is shown becomes the reference of slip (O)");
  compare = make("View", "Com&pare two recordings…", {key("Ctrl+Shift+C")}, true);
  fullScreen = make("View", "&Full screen", {key("F11")}, true);
  resetLayout = make("View", "&Reset layout", {key("Ctrl+Shift+R")});

  play = make("Playback", "&Play or pause", {key("Space")});
  stepBack = make("Playback", "Step &back", {key("Left")});
  stepForward = make("Playback", "Step &forward", {key("Right")});
  tenBack = make("Playback", "Ten frames back", {key("Shift+Left")});
  tenForward = make("Playback", "Ten frames forward", {key("Shift+Right")});
  toStart = make("Playback", "To the first frame", {key("Home")});
  toEnd = make("Playback", "To the last frame", {key("End")});
  goToFrame = make("Playback", "&Go to frame…", {key("Ctrl+G")});
  faster = make("Playback", "F&aster", {key("Up"), key("+"), key("=")});
  slower = make("Playback", "&Slower", {key("Down"), key("-")});
  loop = make("Playback", "&Loop", {key("L")}, true);
  skipGaps = make("Playback", "Skip &gaps", {key("G")}, true);
  skipGaps->setToolTip("Jump over the gaps of a recording while playing (G)");

  connectHand = make("Hand", "&Connect…", {key("Ctrl+K")});
  tryEmulated = make("Hand", "Try the &emulated hand", {key("Ctrl+Shift+D")});
  disconnectHand = make("Hand", "&Disconnect", {key("Ctrl+Shift+K")});
  whatIsIt = make("Hand", "&What is it?", {key("Q")});
  whatIsIt->setToolTip("Recognises the selected grasp, or what is held (Q)");
  showMode = make("Hand", "The answer on the whole &screen", {key("Shift+Q")});
  graspHand = make("Hand", "&Grasp", {key("Ctrl+Alt+G")});
  reactiveGrasp = make("Hand", "&Reactive grasp", {key("Ctrl+Alt+R")});
  slipAwareGrasp = make("Hand", "Slip-&aware grasp", {key("Ctrl+Alt+S")});
  openHand = make("Hand", "&Open the hand", {key("Ctrl+Alt+O")});
  relaxHand = make("Hand", "Rela&x", {key("Ctrl+Alt+X")});
  stopHand = make("Hand", "&Stop the hand (Esc)");
  live = make("Hand", "Show &live", {key("F6")}, true);
  live->setToolTip("Back to what is connected (F6)");
  hold = make("Hand", "&Hold the live picture", {key("P")}, true);
  record = make("Hand", "&Record", {key("Ctrl+R")});
  recordingSettings = make("Hand", "Recording &names and marks…", {key("Ctrl+N")});
  openRecorded = make("Hand", "&Open what was recorded last", {key("Ctrl+Shift+O")});
  mark = make("Hand", "&Mark the moment", {key("Space")});
  for (int digit = 0; digit < kDigits; ++digit)
    labels.append(
        make("Hand", "Mark " + QString::number(digit), {QKeySequence(QString::number(digit))}));
  muteAlarms = make("Hand", "Alarms are &silent", {key("Ctrl+Shift+M")}, true);
  streamSignals = make("Hand", "Stream signals to &PlotJuggler", {}, true);
  streamSignals->setToolTip("A datagram of JSON per frame, to this machine only");
  streamTactile = make("Hand", "Stream all &taxels (ROS TactileSensor)", {}, true);
  streamTactile->setToolTip("A datagram of JSON per frame, to this machine only");
  remoteControl = make("Hand", "&Remote control", {}, true);
  remoteControl->setToolTip("Programs of yours may start, stop and label recordings");
  scanOnly = make("Hand", "Scan &only the chosen taxels", {});
  scanWithout = make("Hand", "&Leave the chosen taxels out", {});
  scanAlso = make("Hand", "Scan the chosen taxels, &too", {});
  scanAll = make("Hand", "Scan &all taxels", {});
  chooseNone = make("Hand", "Choose no ta&xel", {key("Ctrl+Shift+A")});

  // On a button the text stands beside an icon: short, and not too close to it.
  for (QAction* action :
       {open, exportPicture, loop, skipGaps, interpolated, values, connectHand, record})
    action->setIconText(" " + plainText(*action));
  exportPicture->setIconText(" Export");
  live->setIconText(" Live");
  crop->setIconText("Crop…");
  addLabel->setIconText("Label…");
  zoomSelection->setIconText("Zoom");
  dropSelection->setIconText("×");

  keys = make("Help", "&Keys", {key("F1")});
  about = make("Help", "&About Palpate");
  dismiss = make(
      "Help", "Stop the hand; close the message, stop opening, leave full screen", {key("Esc")});

  QStringList names;
  for (const ColorMapName map : kAllColorMaps) names.append(nameOf(map));
  maps = choices(names);
  names.clear();
  for (const RangeMode mode : kAllRangeModes) names.append(nameOf(mode));
  ranges = choices(names);
  names.clear();
  for (const PlottedSignal signal : kAllPlottedSignals) names.append(nameOf(signal));
  signalsPlotted = choices(names);
  themes = choices({"as the desktop", "dark", "light"});
  names.clear();
  for (const double speed : PlaybackController::kSpeeds) names.append(QString::number(speed) + "×");
  speeds = choices(names);
}

void Actions::showChoices(const ViewSettings& view) {
  checkChoice(maps, kAllColorMaps, view.map);
  checkChoice(ranges, kAllRangeModes, view.range);
  checkChoice(signalsPlotted, kAllPlottedSignals, view.signal);
  checkChoice(themes, kAllThemeChoices, view.theme);
}

void Actions::setTheme(Theme theme) {
  open->setIcon(makeIcon(IconShape::kOpen, theme));
  exportPicture->setIcon(makeIcon(IconShape::kExport, theme));
  toStart->setIcon(makeIcon(IconShape::kToStart, theme));
  stepBack->setIcon(makeIcon(IconShape::kStepBack, theme));
  stepForward->setIcon(makeIcon(IconShape::kStepForward, theme));
  loop->setIcon(makeIcon(IconShape::kLoop, theme));
  skipGaps->setIcon(makeIcon(IconShape::kSkipGaps, theme));
  connectHand->setIcon(makeIcon(IconShape::kConnect, theme));
  live->setIcon(makeIcon(IconShape::kLive, theme));
  keys->setIcon(makeIcon(IconShape::kHelp, theme));
  interpolated->setIcon(makeIcon(IconShape::kInterpolated, theme));
  values->setIcon(makeIcon(IconShape::kValues, theme));
}

}  // namespace palpate::gui
