// Takes what is seen away: pictures, tables and movies of the views that the features offer.
#pragma once

#include "gui/bench/feature.h"
#include "gui/export/export_actions.h"
#include "gui/export/take_away.h"

namespace palpate::gui {

class OpeningStrip;

class ExportFeature : public Feature {
  Q_OBJECT
 public:
  ExportFeature(Bench& bench, QWidget* window);

  TakeAway& takeAway() noexcept { return takeAway_; }
  std::vector<StripOffer> strips() override;

 private:
  ExportActions actions_;
  TakeAway takeAway_;
  OpeningStrip* strip_;
};

}  // namespace palpate::gui
