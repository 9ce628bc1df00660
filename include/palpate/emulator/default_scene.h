// The scene of an emulated hand for which none is given: every matrix is touched by an object.
#pragma once

#include <palpate/emulator/scene.h>

namespace palpate {

// Length of the part of the scene that repeats [s].
constexpr double kGraspCycleS = 13.0;  // of a hand that grasps
constexpr double kPadCycleS = 8.0;     // per matrix of a hand that does not

// Returns a scene made from the description alone; it repeats for an hour.
//
// A hand whose start preshape (startPreshape()) moves matrices closes on a sphere that touches the
// middles of all of them at once, within half a pitch; where there is none, on one sphere per moved
// matrix, which touches its middle when the hand is closed by 0.6. It closes from 1 s on, until the
// deepest taxel gives half of the full scale (or until the motors stall), and holds. From 5 to 7 s
// the spheres are pulled by two pitches along the matrices, towards rising rows, from 7.5 to 9.5 s
// back; from 10 s on the hand opens.
//
// In every other hand, one sphere per matrix presses on its middle as deeply, one matrix after the
// other: it comes down at 0.5 s, slides along the columns by a fifth of the width from 2 to 4 s,
// rolls back from 4.5 to 6.5 s, and is lifted at 7 s.
//
// All objects are held by the scene (SceneObject::fixed). Throws Error when the geometry of the
// description is inconsistent.
Scene defaultScene(const HandDescription& hand);

}  // namespace palpate
