#include "palpate/device/sdh2.h"

#include "palpate/model/hand_file.h"

namespace palpate {

const HandDescription& sdh2() {
  static const HandDescription& hand = builtInHand("sdh2");
  return hand;
}

const std::vector<Preshape>& sdh2Preshapes() { return sdh2().file->preshapes; }

const Preshape& sdh2Preshape(std::string_view name) { return findPreshape(sdh2Preshapes(), name); }

const SensorCharacteristics& sdh2Sensor() { return *sdh2().file->characteristics; }

}  // namespace palpate
