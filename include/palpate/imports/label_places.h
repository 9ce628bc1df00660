// Which taxel of a hand a label names ("p3", "x0y1", "left_2"): by the rules by which an import
// finds the taxels among the columns of a table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <palpate/model/hand_description.h>

namespace palpate {

// For each label which value of a frame it is, matrix after matrix and row by row: of all places,
// or of the taxels that exist if there are as many labels as these. What the labels leave open is
// taken in their order. Adds to `notes` what was guessed. Empty when the labels fit no frame of the
// hand.
std::vector<std::size_t> placesOfLabels(const HandDescription& hand,
                                        const std::vector<std::string>& labels,
                                        std::vector<std::string>& notes);

}  // namespace palpate
