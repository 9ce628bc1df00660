// What the applied calibration makes of the counts that are shown, of a recording or live:
// pressures and forces for the other views.
#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include <palpate/calibration/pressure_reader.h>

#include "gui/calibrate/applied_calibration.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class ForcePage;

class Pressures : public QObject {
  Q_OBJECT
 public:
  // Both must outlive it.
  Pressures(WindowState& windowState, ForcePage& page);

  // What the recording that is looked at says of its sensor.
  void setKept(const KeptWithRecording& kept);
  // Another recording, source or calibration. Nothing is done where it is the same.
  void renew();
  // The same file says something else now.
  void reload();

 private:
  void renewLive(const QString& path);
  void renewRecording(const QString& path);
  void showFrame();
  void showLive(const LiveResults& results);

  WindowState& windowState_;
  ForcePage& page_;
  KeptWithRecording kept_;
  std::unique_ptr<PressureReader> reader_;  // of the recording that is shown; null: no pressures
  // What the pressures that are shown are of.
  struct Of {
    const void* source = nullptr;  // recording or live source
    QString path;                  // of the calibration
    KeptWithRecording kept;
    bool operator==(const Of&) const = default;
  };
  std::optional<Of> of_;
};

}  // namespace palpate::gui
