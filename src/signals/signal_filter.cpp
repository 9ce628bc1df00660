#include "palpate/signals/signal_filter.h"

#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/model/timing.h"

namespace palpate {

// Filters a frame that holds one matrix per matrix of the sensor, with one "taxel" per signal.
class SignalFilter::Impl final : public FrameSink {
 public:
  Impl(const Recipe& recipe, std::size_t numMatrices, Emit emit, bool withComponents)
      : kinds_(signalKinds(withComponents)),
        rows_(numMatrices),
        emit_(std::move(emit)),
        chain_(recipe, *this) {
    for (const FilterStep& step : recipe.steps)
      if (step.enabled && step.kind().domain != FilterDomain::kTemporal)
        throw std::invalid_argument(
            step.name +
            ": looks at neighbours, and a signal has none; filters over time "
            "smooth signals");
    const MatrixLayout row = MatrixLayout::full(1, static_cast<int>(kinds_.size()), 1.0);
    layout_ = std::make_shared<const SensorLayout>(std::vector<MatrixLayout>(numMatrices, row));
  }

  void push(std::int64_t hostUs, std::span<const CharacteristicSignals> rows) {
    if (rows.size() != rows_.size())
      throw std::invalid_argument("SignalFilter: " + std::to_string(rows.size()) + " rows of " +
                                  std::to_string(rows_.size()) + " matrices");
    TactileFrame frame(layout_);
    frame.hostUs = hostUs;
    for (std::size_t m = 0; m < rows.size(); ++m)
      for (std::size_t k = 0; k < kinds_.size(); ++k)
        frame.values[m * kinds_.size() + k] = static_cast<float>(valueOf(rows[m], kinds_[k]));
    chain_.push(frame);
  }
  void take(TactileFrame& frame) override {
    for (std::size_t m = 0; m < rows_.size(); ++m)
      for (std::size_t k = 0; k < kinds_.size(); ++k)
        rows_[m][k] = static_cast<double>(frame.allValues()[m * kinds_.size() + k]);
    emit_(frame.hostUs, rows_);
  }
  FilterChain& chain() noexcept { return chain_; }

 private:
  const std::span<const SignalKind> kinds_;
  std::shared_ptr<const SensorLayout> layout_;
  std::vector<SignalValues> rows_;
  const Emit emit_;
  FilterChain chain_;
};

SignalFilter::SignalFilter(const Recipe& recipe,
                           std::size_t numMatrices,
                           Emit emit,
                           bool withComponents)
    : impl_(std::make_unique<Impl>(recipe, numMatrices, std::move(emit), withComponents)) {}
SignalFilter::~SignalFilter() = default;

void SignalFilter::push(std::int64_t hostUs, std::span<const CharacteristicSignals> rows) {
  impl_->push(hostUs, rows);
}
void SignalFilter::finish() { impl_->chain().finish(); }

void requireBelowHalfRate(const Recipe& recipe,
                          const Profile& profile,
                          const std::filesystem::path& file) {
  if (!recipe.dependsOnRate()) return;
  try {
    recipe.validateForRate(timingOf(profile).rateHz);
  } catch (const std::invalid_argument& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace palpate
