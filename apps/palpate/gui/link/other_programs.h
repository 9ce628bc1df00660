// The window's doors to other programs on this machine, all closed until the operator opens them:
// live signals and taxels as datagrams, remote control. It is switched by actions, and says in the
// Link dock what is open.
#pragma once

#include <QObject>
#include <QSettings>
#include <functional>
#include <memory>
#include <vector>

#include <palpate/interop/live_stream.h>
#include <palpate/interop/remote_server.h>

#include "gui/link/link_actions.h"
#include "gui/link/remote_controller.h"
#include "gui/source/live_controller.h"
#include "gui/widgets/facts_view.h"

namespace palpate::gui {

struct OtherProgramsOptions {
  const LinkActions& actions;
  LiveController& live;
  QSettings& settings;
  std::function<RecordingSettings()> recordingSettings;
};

// Streams are as they were left; remote control is off in every window until it is switched on.
// data() of its action is the socket's path; none: the usual one. Ports: streams/signals_port,
// streams/tactile_port of the settings.
class OtherPrograms : public QObject {
  Q_OBJECT
 public:
  OtherPrograms(const OtherProgramsOptions& options, QObject* parent);

  // What is open, row by row; empty: nothing is.
  std::vector<Fact> facts() const;
  // "streaming, remote control"; empty: nothing is open.
  static QString shortText(const ActionRegistry& actions);
  RemoteController& controller() noexcept { return controller_; }

 signals:
  void changed();                       // facts() did
  void failed(const QString& message);  // a door can't be opened
  void logged(const QString& line);

 private:
  QAction* actionOf(StreamKind kind) const;
  std::uint16_t portOf(StreamKind kind) const;
  void useStreams();
  void switchStream(StreamKind kind, bool on);
  void switchRemote(bool on);
  void logRequest(const RemoteRequest& request, const RemoteAnswer& answer);

  const LinkActions& actions_;
  LiveController& live_;
  QSettings& settings_;
  RemoteController controller_;
  std::unique_ptr<RemoteServer> server_;  // null: off
};

}  // namespace palpate::gui
