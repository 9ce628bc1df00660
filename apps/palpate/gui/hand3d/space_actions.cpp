#include "gui/hand3d/space_actions.h"

namespace palpate::gui {

SpaceActions::SpaceActions(ActionRegistry& book) {
  const char* space = "Hand in space";
  matricesShown = book.make("matricesShown", "View", "Show the &matrices", {key("Shift+H")}, true);
  handShown = book.make("handShown", "View", "Show the &hand in space", {key("H")}, true);
  nextTaxelShape = book.make(
      "nextTaxelShape", space, "Next style of the taxels: cells, bars, points, flat", {key("T")});
  nextSphere = book.make("nextSphere", space, "Next style of the enclosing &sphere", {key("B")});
  sphereOfCentroids =
      book.make("sphereOfCentroids", space, "Sphere around the &centroids", {key("Shift+B")}, true);
  normals = book.make("normals", space, "&Normals of the taxels", {key("U")}, true);
  contacts =
      book.make("contacts", space, "&Contacts: centroids, axes, directions", {key("K")}, true);
  wire = book.make("wire", space, "&Wire frame", {key("W")}, true);
  axes = book.make("axes", space, "&Axes of the hand's base", {key("X")}, true);
  slipArrows =
      book.make("slipArrows", space, "&Slip: how contacts and object move", {key("Shift+K")}, true);
  fitHand = book.make("fitHand", space, "Fit it into the &picture", {key("E")});
  resetHand = book.make("resetHand", space, "&Back to the default view", {key("Shift+E")});
  nearer = book.make("nearer", space, "&Nearer", {key("PgUp")});
  further = book.make("further", space, "&Further", {key("PgDown")});
  for (const char* way : {"Left", "Right", "Up", "Down"})
    orbits.append(book.add(
        "orbits", space, "Turn " + QString(way).toLower(), {QKeySequence("Ctrl+" + QString(way))}));
  for (const char* way : {"Left", "Right", "Up", "Down"})
    pans.append(book.add("pans",
                         space,
                         "Move " + QString(way).toLower(),
                         {QKeySequence("Ctrl+Shift+" + QString(way))}));
  onlys.append(book.add("onlys", space, "The whole hand", {key("Alt+0")}, true));
  for (int i = 0; i < ActionRegistry::kMatricesWithKeys; ++i)
    onlys.append(book.add("onlys",
                          space,
                          "Matrix " + QString::number(i) + " alone",
                          {QKeySequence("Alt+" + QString::number(i + 1))},
                          true));
  setKind(orbits, "Ctrl+arrows", "Turn it");
  setKind(pans, "Ctrl+Shift+arrows", "Move it");
  setKind(onlys.mid(1), "Alt+1 .. Alt+9", "One matrix alone");
}

}  // namespace palpate::gui
