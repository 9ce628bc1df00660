// Interface of a slip method that measures translation. SlipTracker calls it for every frame.
#pragma once

#include <memory>

#include "palpate/slip/contact_moments.h"
#include "palpate/slip/slip_tracker.h"

namespace palpate {

struct TranslationReading {
  bool valid = false;
  double dx = 0.0;
  double dy = 0.0;
  // Standard deviations of dx and dy [taxels]; 0: not estimated.
  double sdX = 0.0;
  double sdY = 0.0;
  bool refValid = false;
  double refDx = 0.0;
  double refDy = 0.0;
  double residual = 0.0;
  double confidence = 0.0;
  double gain = 1.0;
  DegenerateDirections degenerate;
  bool newKey = false;
  bool isCentroid = false;
  // Whether the method estimates a rotation itself.
  bool turns = false;
  bool angleValid = false;
  double angleDeg = 0.0;
  bool refAngleValid = false;
  double refAngleDeg = 0.0;
};

class TranslationMethod {
 public:
  virtual ~TranslationMethod() = default;
  // Processes a frame with contact. measurable: it has enough active taxels for a motion.
  // stepPossible: so has the previous frame, and no frames are missing in between.
  virtual TranslationReading update(const ConstMatrixMap& frame,
                                    const ContactMoments& moments,
                                    bool measurable,
                                    bool stepPossible) = 0;
  // Reports a frame without contact.
  virtual void lost() {}
  // Makes the frame of the last update() the reference.
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
