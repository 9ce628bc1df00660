// The interfaces of the window for other programs on this machine: live signals and taxels as
// datagrams, the WebSocket for Foxglove, and remote control. All are off until the operator
// switches them on by actions; the dock Link shows which are on.
#pragma once

#include <QObject>
#include <QSettings>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <palpate/interop/live_stream.h>
#include <palpate/interop/remote_server.h>

#include "gui/link/remote_controller.h"
#include "gui/source/live_controller.h"
#include "gui/widgets/facts_view.h"

namespace palpate::gui {

class ActionRegistry;
struct LinkActions;

// What OtherPrograms needs; the references must outlive it.
struct OtherProgramsOptions {
  const LinkActions& actions;
  LiveController& live;
  QSettings& settings;
  std::function<RecordingSettings()> recordingSettings;
};

// Streams keep the state that they had at the last start; remote control is off in every new
// window. The data() of its action is the path of the socket; empty: the default path. The settings
// streams/signals_port, streams/tactile_port and streams/foxglove_port contain the ports, and
// streams/foxglove_origins the web pages that may connect to the WebSocket.
class OtherPrograms : public QObject {
  Q_OBJECT
 public:
  OtherPrograms(const OtherProgramsOptions& options, QObject* parent);

  // The interfaces that are on, one row each; empty when all are off.
  std::vector<Fact> facts() const;
  // "streaming, remote control"; empty when all are off
  static QString shortText(const ActionRegistry& actions);
  RemoteController& controller() noexcept { return controller_; }

 signals:
  // facts() has changed.
  void changed();
  // An interface could not be opened.
  void failed(const QString& message);
  void logged(const QString& line);

 private:
  QAction* actionOf(StreamKind kind) const;
  std::uint16_t portOf(StreamKind kind) const;
  void useStreams();
  void switchStream(StreamKind kind, bool on);
  // Opens or closes the WebSocket of the source that is connected.
  void switchFoxglove(bool on);
  void reportFoxglove(bool on);
  std::uint16_t foxglovePort() const;
  void switchRemote(bool on);
  void logRequest(const RemoteRequest& request, const RemoteAnswer& answer);

  const LinkActions& actions_;
  LiveController& live_;
  QSettings& settings_;
  RemoteController controller_;
  // null: off
  std::unique_ptr<RemoteServer> server_;
};

}  // namespace palpate::gui
