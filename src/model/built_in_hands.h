// The texts of data/hands, which the build writes into built_in_hands.cpp.
#pragma once

#include <string>
#include <vector>

namespace palpate {

struct BuiltInHandText {
  std::string key;   // name of the folder
  std::string json;  // text of hand.json
  std::string urdf;  // text of hand.urdf; empty when there is none
};
const std::vector<BuiltInHandText>& builtInHandTexts();

}  // namespace palpate
