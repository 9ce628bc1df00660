#include "palpate/emulator/emulated_hand.h"

#include <stdexcept>

#include "emulator/emulated_loop.h"

namespace palpate {

EmulatedHand::EmulatedHand(std::unique_ptr<HandModel> model,
                           EmulatedHandOptions options,
                           FrameObserver observer) {
  if (!model) throw std::invalid_argument("an emulated hand needs a model");
  loop_ = std::make_unique<Loop>(std::move(model), std::move(options), std::move(observer));
}

EmulatedHand::~EmulatedHand() = default;

std::string EmulatedHand::dsaPort() const {
  std::string name;
  loop_->call([&] { name = loop_->dsaLane().port().name(); });
  return name;
}

std::string EmulatedHand::sdhPort() const {
  std::string name;
  loop_->call([&] { name = loop_->sdhLane().port().name(); });
  return name;
}

std::string EmulatedHand::dsaSerial() const { return loop_->dsaSerial(); }

std::string EmulatedHand::sdhSerial() const { return loop_->sdhSerial(); }

EmulatedHandCounts EmulatedHand::counts() const { return loop_->counts(); }

std::vector<SentFrame> EmulatedHand::sentFrames() const { return loop_->sentFrames(); }

void EmulatedHand::unplug(bool dsa, bool sdh) {
  loop_->call([&] {
    if (dsa) loop_->dsaLane().unplug();
    if (sdh) loop_->sdhLane().unplug();
  });
}

void EmulatedHand::unplugAfter(std::uint64_t bytes) {
  loop_->call([&] { loop_->dsaLane().cutAfter(bytes); });
}

void EmulatedHand::replug() {
  loop_->call([&] {
    loop_->dsaLane().port().plug();
    loop_->sdhLane().port().plug();
  });
}

void EmulatedHand::powerCycle(double bootS) {
  loop_->call([&] { loop_->powerCycle(bootS); });
}

void EmulatedHand::mute(bool on) {
  loop_->call([&] {
    loop_->dsaLane().setMuted(on);
    loop_->sdhLane().setMuted(on);
  });
}

void EmulatedHand::sendRandomBytes(std::uint64_t bytes, bool dsa, bool sdh) {
  loop_->call([&] {
    if (dsa) loop_->dsaLane().sendRandomBytes(bytes);
    if (sdh) loop_->sdhLane().sendRandomBytes(bytes);
  });
}

void EmulatedHand::setFaults(const Faults& faults) {
  loop_->call([&] { loop_->setFaults(faults); });
}

void EmulatedHand::withModel(const std::function<void(HandModel&)>& visit) {
  loop_->call([&] { visit(loop_->model()); });
}

}  // namespace palpate
