#include "gui/hand3d/hand_look.h"

#include "gui/appearance/settings_table.h"

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

HandLook withColorsOf(HandLook look, const HandLook& other) {
  look.map = other.map;
  look.range = other.range;
  look.view = other.view;
  look.isSigned = other.isSigned;
  look.arrows = other.arrows;
  look.theme = other.theme;
  return look;
}

namespace {

void handLookFields(SettingsTable& table, HandLook& look) {
  table.choice("hand_view/taxels", look.taxels, kAllTaxelShapes);
  table.choice("hand_view/sphere", look.sphere, kAllSphereLooks);
  bool ofCentroids = look.sphereOf == SphereOf::kCentroids;
  table.flag("hand_view/sphere_of_centroids", ofCentroids);
  look.sphereOf = ofCentroids ? SphereOf::kCentroids : SphereOf::kTaxels;
  table.flag("hand_view/normals", look.normals);
  table.flag("hand_view/wire", look.wire);
  table.flag("hand_view/contacts", look.contacts);
  table.flag("hand_view/slip", look.slip);
  table.flag("hand_view/axes", look.axes);
}

}  // namespace

HandLook loadHandLook(const QSettings& settings) {
  return loadFields<HandLook>(settings, handLookFields);
}

void saveHandLook(const HandLook& look, QSettings& settings) {
  saveFields(settings, look, handLookFields);
}

}  // namespace palpate::gui
