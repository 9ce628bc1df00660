// Filters that need a whole stretch of frames before the first can come out.
#include <stdexcept>

#include "filter/temporal_filters.h"

namespace palpate::detail {

std::unique_ptr<FrameFilter> stretchFilter(const FilterStep& step, std::shared_ptr<const SensorLayout>) {
  throw std::logic_error(step.name);
}

}  // namespace palpate::detail
