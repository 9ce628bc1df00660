// Which taxels the connected hand scans, from those that are chosen.
#pragma once

#include <QObject>
#include <future>
#include <vector>

#include <palpate/control/tactile_masks.h>
#include <palpate/device/device.h>

#include "gui/bench/bench.h"

namespace palpate::gui {

class ScanChoice : public QObject {
  Q_OBJECT
 public:
  // The bench must outlive it.
  explicit ScanChoice(Bench& bench);

 private:
  void scan(MaskChoice choice);
  void takeAnswers();

  Bench& bench_;
  std::vector<std::shared_future<CommandAnswer>> answers_;  // that the hand hasn't given yet
};

}  // namespace palpate::gui
