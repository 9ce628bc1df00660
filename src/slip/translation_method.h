// One way to measure translation, as a SlipTracker drives it.
#pragma once

#include <memory>

#include "palpate/slip/contact_moments.h"
#include "palpate/slip/slip_tracker.h"

namespace palpate {

struct TranslationReading {
  bool valid = false;
  double dx = 0.0;
  double dy = 0.0;
  bool refValid = false;
  double refDx = 0.0;
  double refDy = 0.0;
  double residual = 0.0;
  double confidence = 0.0;
  double gain = 1.0;
  DegenerateDirections degenerate;
  bool newKey = false;
  bool isCentroid = false;
  bool turns = false;  // the method has an angle of its own
  bool angleValid = false;
  double angleDeg = 0.0;
  bool refAngleValid = false;
  double refAngleDeg = 0.0;
};

class TranslationMethod {
 public:
  virtual ~TranslationMethod() = default;
  // A frame with contact. measurable: it has enough taxels for a motion. stepPossible: so had the
  // frame before, and none is missing between.
  virtual TranslationReading update(const ConstMatrixMap& frame,
                                    const ContactMoments& moments,
                                    bool measurable,
                                    bool stepPossible) = 0;
  // A frame without contact.
  virtual void lost() {}
  // The frame of the last update() is the reference.
  virtual void takeReference() = 0;
  virtual void dropReference() = 0;
};

std::unique_ptr<TranslationMethod> makeCentroidMethod(bool alcazar);
std::unique_ptr<TranslationMethod> makeNccMethod(const MatrixLayout& layout,
                                                 const SlipTrackerOptions& options,
                                                 bool paraboloid);
std::unique_ptr<TranslationMethod> makePhaseMethod(const MatrixLayout& layout,
                                                   const SlipTrackerOptions& options,
                                                   bool normalized);
std::unique_ptr<TranslationMethod> makeRegisterMethod(const MatrixLayout& layout,
                                                      const SlipTrackerOptions& options);

}  // namespace palpate
