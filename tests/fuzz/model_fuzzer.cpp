// Fuzzes recognition models: what is taken agrees with itself, reads back as it was written, and
// judges a grasp.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "palpate/core/error.h"
#include "palpate/recognition/trained_model.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const TrainedModel model = trainedModelFrom(Json::parse(text));
    const std::string written = jsonOf(model).text(-1);
    require(jsonOf(trainedModelFrom(Json::parse(written))).text(-1) == written);
    const Eigen::MatrixXd grasps =
        Eigen::MatrixXd::Constant(2, static_cast<Eigen::Index>(model.features.size()), 1.5);
    for (const Prediction& prediction : classifyRows(model, grasps, model.offset, false)) {
      require(prediction.ranking.size() == model.classes.size());
      require(prediction.label >= Prediction::kUnknown &&
              prediction.label < static_cast<int>(model.classes.size()));
    }
  } catch (const Error&) {
  }
  return 0;
}
