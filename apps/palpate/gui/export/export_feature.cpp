#include "gui/export/export_feature.h"

#include "gui/widgets/opening_strip.h"

namespace palpate::gui {

ExportFeature::ExportFeature(Bench& bench, QWidget* window)
    : Feature(bench, window),
      actions_(bench.actions),
      takeAway_(bench.settings, window),
      strip_(new OpeningStrip(window, "Exporting", "exporting")) {
  ExportActions& actions = actions_;
  on(actions.exportPicture, [this] { takeAway_.exportNow(); });
  on(actions.exportAgain, [this] { takeAway_.repeatLast(); });
  on(actions.copyPicture, [this] { takeAway_.copyPicture(); });
  on(actions.copyTable, [this] { takeAway_.copyTable(); });
  connect(&takeAway_, &TakeAway::started, strip_, &OpeningStrip::begin);
  connect(&takeAway_, &TakeAway::progressed, strip_, &OpeningStrip::setProgress);
  connect(&takeAway_, &TakeAway::finished, strip_, &OpeningStrip::end);
  connect(strip_, &OpeningStrip::cancelRequested, &takeAway_, &TakeAway::cancel);
  connect(&takeAway_, &TakeAway::said, &bench.messages, &Messages::flash);
  connect(&takeAway_, &TakeAway::failed, &bench.messages, &Messages::fail);
  bench.enabling.add(
      {actions.exportPicture, actions.exportAgain, actions.copyPicture, actions.copyTable},
      [&bench] { return bench.moment.hasFrame(); });
  bench.escape.add(Escape::Order::kExport, [this] {
    if (!takeAway_.busy()) return false;
    takeAway_.cancel();
    return true;
  });
}

std::vector<StripOffer> ExportFeature::strips() { return {{StripOffer::Order::kExport, strip_}}; }

}  // namespace palpate::gui
