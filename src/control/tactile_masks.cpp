#include "palpate/control/tactile_masks.h"

#include <algorithm>
#include <stdexcept>

namespace palpate {
namespace {

bool anyOf(const Mask& mask) {
  return std::any_of(mask.begin(), mask.end(), [](std::uint8_t on) { return on != 0; });
}

Mask wanted(const MatrixLayout& matrix, const Mask& chosen, MaskChoice choice) {
  if (choice == MaskChoice::kOnlyInTheirMatrices && !anyOf(chosen)) return matrix.dynamicMask;
  Mask mask(matrix.numCells());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const bool isChosen = chosen[i] != 0;
    const bool isScanned = matrix.dynamicMask[i] != 0;
    bool scan = true;
    if (choice == MaskChoice::kOnly || choice == MaskChoice::kOnlyInTheirMatrices) scan = isChosen;
    if (choice == MaskChoice::kWithout) scan = isScanned && !isChosen;
    if (choice == MaskChoice::kAlso) scan = isScanned || isChosen;
    mask[i] = scan && matrix.staticMask[i] != 0 ? 1 : 0;
  }
  return mask;
}

// Compares masks only where a taxel exists.
bool sameTaxels(const MatrixLayout& matrix, const Mask& mask) {
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (matrix.staticMask[i] != 0 && (matrix.dynamicMask[i] != 0) != (mask[i] != 0)) return false;
  return true;
}

}  // namespace

std::vector<DeviceCommand> maskCommands(const SensorLayout& layout,
                                        const TaxelSelection& selection,
                                        MaskChoice choice) {
  if (selection.numMatrices() != layout.numMatrices())
    throw std::invalid_argument("maskCommands: the selection is one of another sensor");
  std::vector<DeviceCommand> commands;
  bool anythingLeft = false;
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    if (selection.mask(m).size() != matrix.numCells())
      throw std::invalid_argument("maskCommands: the selection is one of another sensor");
    const Mask mask = wanted(matrix, selection.mask(m), choice);
    anythingLeft = anythingLeft || anyOf(mask);
    if (!sameTaxels(matrix, mask))
      commands.emplace_back(SetDynamicMask{.matrix = static_cast<int>(m), .mask = mask});
  }
  if (!anythingLeft)
    throw std::invalid_argument("no taxel would be scanned any more: leave at least one");
  return commands;
}

}  // namespace palpate
