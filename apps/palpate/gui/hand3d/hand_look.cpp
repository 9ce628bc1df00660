#include "gui/hand3d/hand_look.h"

#include <algorithm>

namespace palpate::gui {

QString nameOf(TaxelShape shape) {
  switch (shape) {
    case TaxelShape::kCells:
      return "cells";
    case TaxelShape::kBars:
      return "bars";
    case TaxelShape::kPoints:
      return "points";
    case TaxelShape::kFlatCells:
      return "flat cells";
    case TaxelShape::kFlatBars:
      return "flat bars";
  }
  return {};
}

bool isFlat(TaxelShape shape) {
  return shape == TaxelShape::kFlatCells || shape == TaxelShape::kFlatBars;
}

QString nameOf(SphereLook look) {
  switch (look) {
    case SphereLook::kGlass:
      return "glass";
    case SphereLook::kOpaque:
      return "opaque";
    case SphereLook::kWire:
      return "wire";
    case SphereLook::kNone:
      return "no sphere";
  }
  return {};
}

namespace {

constexpr const char* kHandLookGroup = "hand_view/";

template <class All, class Value>
Value named(const QSettings& settings, const char* key, const All& all, Value usual) {
  const QString name = settings.value(kHandLookGroup + QString(key)).toString();
  const auto* found =
      std::find_if(all.begin(), all.end(), [&](Value v) { return nameOf(v) == name; });
  return found == all.end() ? usual : *found;
}

bool handLookFlag(const QSettings& settings, const char* key, bool usual) {
  return settings.value(kHandLookGroup + QString(key), usual).toBool();
}

}  // namespace

HandLook loadHandLook(const QSettings& settings) {
  HandLook look;
  look.taxels = named(settings, "taxels", kAllTaxelShapes, look.taxels);
  look.sphere = named(settings, "sphere", kAllSphereLooks, look.sphere);
  look.sphereOf = handLookFlag(settings, "sphere_of_centroids", false) ? SphereOf::kCentroids
                                                                       : SphereOf::kTaxels;
  look.normals = handLookFlag(settings, "normals", look.normals);
  look.wire = handLookFlag(settings, "wire", look.wire);
  look.contacts = handLookFlag(settings, "contacts", look.contacts);
  look.slip = handLookFlag(settings, "slip", look.slip);
  look.axes = handLookFlag(settings, "axes", look.axes);
  return look;
}

void saveHandLook(const HandLook& look, QSettings& settings) {
  const auto put = [&settings](const char* key, const QVariant& value) {
    settings.setValue(kHandLookGroup + QString(key), value);
  };
  put("taxels", nameOf(look.taxels));
  put("sphere", nameOf(look.sphere));
  put("sphere_of_centroids", look.sphereOf == SphereOf::kCentroids);
  put("normals", look.normals);
  put("wire", look.wire);
  put("contacts", look.contacts);
  put("slip", look.slip);
  put("axes", look.axes);
}

}  // namespace palpate::gui
