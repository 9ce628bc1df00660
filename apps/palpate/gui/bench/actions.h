// Everything the user can do in the window, with its keys: menus, toolbar and the list of keys (F1)
// are all made from these actions.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>
#include <QString>
#include <optional>

#include "gui/look/theme.h"
#include "gui/look/window_settings.h"

namespace palpate::gui {

// Of the action record: whether it would stop a recording.
inline constexpr const char* kRecordingProperty = "recording";

struct Actions {
  // The actions belong to the window and work wherever the keyboard is in it.
  explicit Actions(QWidget* window);
  void setTheme(Theme theme);  // icons
  // The choices of groups stand where these settings are.
  void showChoices(const ViewSettings& view);

  QAction* open;
  QAction* openDemo;
  QAction* nextRecording;
  QAction* previousRecording;
  QAction* closeRecording;
  QAction* saveEvents;
  QAction* exportPicture;
  QAction* exportAgain;
  QAction* copyPicture;
  QAction* copyTable;
  QAction* quit;

  QAction* undo;
  QAction* redo;
  QAction* addLabel;
  QAction* addNote;
  QAction* addGrasp;
  QAction* renameEvent;
  QAction* removeEvent;
  QAction* nextEvent;
  QAction* previousEvent;
  QAction* toEvents;
  QAction* selectFrom;
  QAction* selectTo;
  QAction* selectAll;
  QAction* crop;
  QAction* zoomSelection;
  QAction* dropSelection;
  QAction* nameTaxels;  // a group of those that are chosen

  QAction* interpolated;
  QAction* values;
  QAction* filtered;  // what is shown, through the filters (after) or as it is (before)
  QAction* nextMap;
  QAction* nextRange;
  QAction* nextSignal;
  QAction* chooseCurves;
  QAction* zoomIn;
  QAction* zoomOut;
  QAction* fit;
  QAction* nextTheme;
  // The hand in space
  QAction* matricesShown;  // checked: the heat maps are seen; one of both always is
  QAction* handShown;
  QAction* nextTaxelShape;
  QAction* nextSphere;
  QAction* sphereOfCentroids;
  QAction* normals;
  QAction* contacts;
  QAction* wire;
  QAction* axes;
  QAction* slipArrows;
  QAction* fitHand;
  QAction* resetHand;
  QAction* nearer;
  QAction* further;
  QList<QAction*> orbits;  // left, right, up, down
  QList<QAction*> pans;    // the same
  QList<QAction*> onlys;   // the whole hand, then one matrix alone
  QAction* slipReference;  // slip is measured from the frame that is shown
  QAction* compare;        // checked: two recordings are compared
  QAction* fullScreen;
  QAction* resetLayout;

  QAction* play;
  QAction* stepBack;
  QAction* stepForward;
  QAction* tenBack;
  QAction* tenForward;
  QAction* toStart;
  QAction* toEnd;
  QAction* goToFrame;
  QAction* faster;
  QAction* slower;
  QAction* loop;
  QAction* skipGaps;

  QAction* connectHand;
  QAction* tryEmulated;
  QAction* disconnectHand;
  QAction* whatIsIt;  // recognition of the selection, or of what is held
  QAction* showMode;  // its answer on the whole screen
  // What moves the hand: as the buttons of the dock Hand.
  QAction* graspHand;
  QAction* reactiveGrasp;
  QAction* slipAwareGrasp;
  QAction* openHand;
  QAction* relaxHand;
  QAction* stopHand;  // Esc does the same, wherever the keyboard is
  QAction* live;      // checked: what is connected is shown, not a recording
  QAction* hold;
  QAction* record;
  QAction* recordingSettings;
  QAction* openRecorded;  // what was recorded last
  QAction* mark;
  QList<QAction*> labels;  // of the digit keys 0..9
  QAction* muteAlarms;
  QAction* streamSignals;  // other programs; off in a new window
  QAction* streamTactile;
  QAction* remoteControl;  // data(): its socket; none: the usual one
  QAction* scanOnly;       // masks, from the taxels that are chosen
  QAction* scanWithout;
  QAction* scanAlso;
  QAction* scanAll;
  QAction* chooseNone;

  QAction* keys;
  QAction* about;
  QAction* dismiss;

  // Choices, one of each group at a time; data() is the index.
  QActionGroup* maps;
  QActionGroup* ranges;
  QActionGroup* signalsPlotted;
  QActionGroup* themes;
  QActionGroup* speeds;
  // Plot a matrix: the first nine, then the whole hand.
  QList<QAction*> plots;

 private:
  QAction* make(const char* section,
                const QString& text,
                const QList<QKeySequence>& sequences = {},
                bool checkable = false);
  QActionGroup* choices(const QStringList& names);

  QWidget* window_;
};

// The section of the list of keys that an action belongs to ("File", ..); empty: not listed.
QString sectionOf(const QAction& action);
void setSection(QAction& action, const QString& section);
// Actions that are alike, listed by one line for all of them.
struct ActionKind {
  QString keys;  // "Ctrl+arrows"
  QString what;
};
void setKind(const QList<QAction*>& actions, const QString& keys, const QString& what);
std::optional<ActionKind> kindOf(const QAction& action);
// Its text without mnemonic and dots.
QString plainText(const QAction& action);

}  // namespace palpate::gui
