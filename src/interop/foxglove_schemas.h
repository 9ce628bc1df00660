// JSON schemas of the channels for Foxglove. Names and types of the keys are those of Foxglove's
// message schemas; descriptions say what Palpate fills in.
#pragma once

#include <string>

#include "palpate/core/json.h"
#include "palpate/model/hand_description.h"

namespace palpate {

std::string foxgloveImageSchema(const std::string& unit);
std::string foxglovePointCloudSchema(const std::string& unit);
std::string foxgloveTransformsSchema();
std::string foxgloveSceneSchema();
std::string foxgloveJointsSchema();
std::string foxgloveLogSchema();
// Schema of the signals of a hand ("palpate.Signals"): every number with its unit.
std::string foxgloveSignalsSchema(const HandDescription& hand);

}  // namespace palpate
