// The scene of an emulated hand for which none is given: every matrix is touched by an object.
#pragma once

#include <palpate/emulator/scene.h>

namespace palpate {

// Length of the part of the scene that repeats [s].
constexpr double kGraspCycleS = 13.0;  // of a hand that grasps
constexpr double kPadCycleS = 8.0;     // per matrix of a hand that does not

// Returns a scene made from the description alone; it repeats for an hour.
//
// A hand with a start preshape (startPreshape()) that moves two matrices or more grasps a sphere:
// its centre is the point that the normals of the moved matrices come nearest to while the hand
// closes, its radius their mean distance from there. The hand closes from 1 s on until a taxel is
// indented by as much as gives half of the full scale (or until the motors stall), holds; from 5
// to 7 s the sphere is pulled by two pitches along the matrices (towards rising rows of the first
// one), from 7.5 to 9.5 s back; from 10 s on the hand opens.
//
// In every other hand, one object per matrix presses on its middle as deeply, one matrix after the
// other: a sphere comes down at 0.5 s, slides along the columns by a fifth of the width from 2 to 4
// s, rolls back from 4.5 to 6.5 s, and is lifted at 7 s.
//
// All objects are held by the scene (SceneObject::fixed). Throws Error when the geometry of the
// description is inconsistent.
Scene defaultScene(const HandDescription& hand);

}  // namespace palpate
