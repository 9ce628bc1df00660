#include "slip/translation_method.h"

namespace palpate {
namespace {

struct Point {
  double x = 0.0;
  double y = 0.0;
};

// The slip methods `centroid` and `alcazar`. In the method of Alcazar the centre of mass of the
// convolution of frames n-1 and n is c_(n-1) + c_n. The difference of two such centres spans two
// frames, and half of it is a step.
class CentroidMethod final : public TranslationMethod {
 public:
  explicit CentroidMethod(bool alcazar) : alcazar_(alcazar) {}

  TranslationReading update(const ConstMatrixMap& /*frame*/,
                            const ContactMoments& moments,
                            bool measurable,
                            bool stepPossible) override {
    TranslationReading reading;
    const Point now{moments.x, moments.y};
    if (!stepPossible) steps_ = 0;
    if (measurable && steps_ > 0) {
      const bool two = alcazar_ && steps_ > 1;
      const Point from = two ? before_ : last_;
      const double scale = two ? 0.5 : 1.0;
      reading.valid = true;
      reading.dx = scale * (now.x - from.x);
      reading.dy = scale * (now.y - from.y);
    }
    if (measurable && hasReference_) {
      reading.refValid = true;
      reading.refDx = now.x - reference_.x;
      reading.refDy = now.y - reference_.y;
    }
    reading.confidence = 1.0;
    reading.isCentroid = true;
    before_ = last_;
    last_ = now;
    steps_ = measurable ? steps_ + 1 : 0;
    return reading;
  }
  void lost() override { steps_ = 0; }
  void takeReference() override {
    reference_ = last_;
    hasReference_ = true;
  }
  void dropReference() override { hasReference_ = false; }

 private:
  const bool alcazar_;
  // Number of measurable frames in a row.
  int steps_ = 0;
  Point last_;
  Point before_;
  Point reference_;
  bool hasReference_ = false;
};

}  // namespace

std::unique_ptr<TranslationMethod> makeCentroidMethod(bool alcazar) {
  return std::make_unique<CentroidMethod>(alcazar);
}

}  // namespace palpate
