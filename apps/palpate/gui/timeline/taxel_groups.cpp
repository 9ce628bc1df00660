#include "gui/timeline/taxel_groups.h"

#include <algorithm>

namespace palpate::gui {
namespace {

constexpr const char* kTaxelGroupsKey = "taxel_groups";

QString tidy(const QString& name) { return name.simplified().left(TaxelGroups::kMaxNameLength); }

}  // namespace

TaxelGroups::TaxelGroups(QSettings& settings, QObject* parent)
    : QObject(parent), settings_(settings) {
  const int count = std::min(settings_.beginReadArray(kTaxelGroupsKey), kMaximum);
  for (int i = 0; i < count; ++i) {
    settings_.setArrayIndex(i);
    Kept kept{tidy(settings_.value("name").toString()), settings_.value("taxels").toString()};
    if (!kept.name.isEmpty() && !kept.text.isEmpty() && !has(kept.name))
      kept_.push_back(std::move(kept));
  }
  settings_.endArray();
}

std::vector<TaxelGroups::Group> TaxelGroups::of(const SensorLayout& layout) const {
  std::vector<Group> groups;
  for (const Kept& kept : kept_) {
    const auto taxels = TaxelSelection::fromText(kept.text.toStdString(), layout);
    if (taxels && !taxels->empty()) groups.push_back({kept.name, *taxels});
  }
  return groups;
}

bool TaxelGroups::has(const QString& name) const {
  return std::any_of(
      kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.name == name; });
}

bool TaxelGroups::keep(const QString& asked, const TaxelSelection& taxels) {
  const QString name = tidy(asked);
  if (name.isEmpty() || taxels.empty()) return false;
  std::erase_if(kept_, [&](const Kept& kept) { return kept.name == name; });
  if (kept_.size() >= static_cast<std::size_t>(kMaximum)) return false;
  kept_.push_back({name, QString::fromStdString(taxels.text())});
  std::sort(kept_.begin(), kept_.end(), [](const Kept& a, const Kept& b) {
    return QString::localeAwareCompare(a.name, b.name) < 0;
  });
  store();
  return true;
}

bool TaxelGroups::rename(const QString& from, const QString& asked) {
  const QString to = tidy(asked);
  const auto at =
      std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.name == from; });
  if (at == kept_.end() || to.isEmpty() || has(to)) return false;
  at->name = to;
  store();
  return true;
}

void TaxelGroups::forget(const QString& name) {
  if (std::erase_if(kept_, [&](const Kept& kept) { return kept.name == name; }) > 0) store();
}

void TaxelGroups::store() {
  settings_.remove(kTaxelGroupsKey);
  settings_.beginWriteArray(kTaxelGroupsKey, static_cast<int>(kept_.size()));
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    settings_.setArrayIndex(static_cast<int>(i));
    settings_.setValue("name", kept_[i].name);
    settings_.setValue("taxels", kept_[i].text);
  }
  settings_.endArray();
  emit changed();
}

}  // namespace palpate::gui
