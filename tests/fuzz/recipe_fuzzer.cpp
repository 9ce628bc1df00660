// Fuzzes recipes, as JSON and as text: what is taken is sound, reads back as it was written, and
// runs over a few frames without a value that isn't finite.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "palpate/core/error.h"
#include "palpate/filter/filter_chain.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

class Finite final : public FrameSink {
 public:
  void take(TactileFrame& frame) override {
    for (const float value : frame.values) require(std::isfinite(value));
    ++count;
  }
  int count = 0;
};

void run(const Recipe& recipe) {
  require(recipe.steps.size() <= Recipe::kMaxSteps);
  recipe.validate();
  require(recipeFromJson(Json::parse(recipeJson(recipe).text())) == recipe);
  const auto layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(3, 4, 1.0)});
  // A long chain of large windows takes its time: one small matrix, few frames.
  constexpr int kFrames = 4;
  Finite sink;
  try {
    FilterChain chain(recipe, sink);
    for (int i = 0; i < kFrames; ++i) {
      TactileFrame frame(layout);
      frame.hostUs = i * 30'000;
      for (std::size_t k = 0; k < frame.values.size(); ++k)
        frame.values[k] = static_cast<float>((i * 97 + static_cast<int>(k) * 31) % 4096);
      chain.push(frame);
    }
    chain.finish();
  } catch (const std::invalid_argument&) {
    return;  // a matrix that isn't there
  }
  require(sink.count == kFrames);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    run(recipeFromJson(Json::parse(text)));
  } catch (const Error&) {
  }
  try {
    const std::string texts[] = {text};
    const Recipe recipe = parseRecipe(texts);
    require(parseRecipe(std::vector<std::string>{recipeText(recipe)}) == recipe);
    run(recipe);
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
