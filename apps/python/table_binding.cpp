#include "python/table_binding.h"

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <pybind11/numpy.h>

#include "python/bindings.h"
#include "python/flat_table.h"

namespace py = pybind11;

namespace palpate::python {
namespace {

constexpr const char* kUnits = "units";

py::module_ importedPackage(const char* name, const char* function) {
  try {
    return py::module_::import(name);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) throw;
    throw py::import_error(std::string(function) + "() needs " + name +
                           ", which can't be imported: install python3-" + name);
  }
}

// Host times [us since 1970] as numpy.datetime64.
py::object instants(const py::object& timeUs) { return timeUs.attr("astype")("datetime64[us]"); }

py::object millisecondInstants(const py::object& timeMs) {
  return instants(timeMs.attr("astype")("int64") * py::int_(1000));
}

// Whether it has the components of what presses, and not places, as x and y.
bool hasComponents(const py::dict& table) { return table.contains("norm"); }

// The unit of a column, by its name; empty: it has none.
std::string unitOf(const std::string& name, const std::string& taxelUnit, bool components) {
  for (const char* component : {"x", "y", "z", "norm"})
    if (components && name == component) return taxelUnit;
  for (const char* counts : {"mean", "filtered_mean", "min", "max", "sum"})
    if (name == counts) return taxelUnit;
  for (const char* taxels : {"x", "y", "dx", "dy", "ref_dx", "ref_dy", "path_taxels"})
    if (name == taxels) return "taxels";
  constexpr std::array<std::pair<std::string_view, const char*>, 9> kEndings = {
      {{"_mm2", "mm^2"},
       {"_mm", "mm"},
       {"_deg", "deg"},
       {"_ms", "ms"},
       {"_kpa", "kPa"},
       {"_n", "N"},
       {"_s", "s"},
       {"_hz", "Hz"},
       {"_degc", "deg C"}}};
  for (const auto& [ending, unit] : kEndings)
    if (name.ends_with(ending)) return unit;
  return {};
}

// The column that says when a row is; null: none.
const char* timeColumn(const py::dict& table) {
  for (const char* name : {"time_ms", "begin_ms"})
    if (table.contains(name)) return name;
  return nullptr;
}

bool isArray(const py::handle& value) { return py::isinstance<py::array>(value); }

py::object toPandas(const py::dict& table, const std::string& unit) {
  const py::module_ pandas = importedPackage("pandas", "to_pandas");
  py::dict arrays, lists, units;
  for (const auto& [key, value] : table) (isArray(value) ? arrays : lists)[key] = value;
  const py::dict columns = flat(arrays);
  py::object frame = pandas.attr("DataFrame")(columns);
  for (const auto& [key, value] : arrays) {
    const std::string of = unitOf(py::str(key), unit, hasComponents(table));
    if (of.empty()) continue;
    py::dict one;
    one[key] = value;
    for (const auto& column : flat(one)) units[column.first] = of;
  }
  // What has a list per row: the fingers of grasps.
  for (const auto& [key, value] : lists) {
    if (!py::isinstance<py::list>(value) || py::len(value) != py::len(frame))
      throw py::value_error("'" + std::string(py::str(key)) +
                            "' isn't an array: a report isn't a table");
    frame.attr("__setitem__")(key, value);
  }
  if (const char* time = timeColumn(arrays))
    frame.attr("index") =
        pandas.attr("DatetimeIndex")(millisecondInstants(arrays[time]), py::arg("name") = "time");
  frame.attr("attrs")[kUnits] = units;
  return frame;
}

py::object toXarray(const py::dict& table, const std::string& unit) {
  const py::module_ xarray = importedPackage("xarray", "to_xarray");
  const char* time = timeColumn(table);
  const char* const row = time ? "time" : "row";
  py::dict arrays, variables, coordinates;
  for (const auto& [key, value] : table)
    if (isArray(value)) arrays[key] = value;
  flat(arrays);  // throws for what is no table
  for (const auto& [key, value] : arrays) {
    const std::string name = py::str(key);
    const py::array array = py::reinterpret_borrow<py::array>(value);
    py::list dims;
    dims.append(row);
    const bool vector = isVector(name) && array.ndim() > 1 && array.shape(array.ndim() - 1) == 3;
    if (array.ndim() == 3 || (array.ndim() == 2 && !vector)) dims.append("matrix");
    if (vector) {
      dims.append("axis");
      py::list axes;
      for (const char* axis : {"x", "y", "z"}) axes.append(axis);
      coordinates["axis"] = axes;
    }
    if (static_cast<py::ssize_t>(dims.size()) != array.ndim())
      throw py::value_error("'" + name + "' has " + std::to_string(array.ndim()) +
                            " dimensions, a table has up to 3");
    py::dict attributes;
    if (const std::string of = unitOf(name, unit, hasComponents(table)); !of.empty())
      attributes[kUnits] = of;
    variables[key] = py::make_tuple(dims, array, attributes);
  }
  if (time) coordinates["time"] = py::make_tuple(row, millisecondInstants(arrays[time]));
  return xarray.attr("Dataset")(variables, coordinates);
}

py::dict attributesOf(const py::object& profile, const std::string& unit) {
  py::dict attributes;
  attributes[kUnits] = unit;
  attributes["hand"] = profile.attr("hand");
  attributes["serial"] = profile.attr("serial");
  return attributes;
}

// "deg", or "mm" where all axes slide; one for each axis where they differ: "mm, deg".
std::string angleUnitOf(const py::object& profile) {
  std::string each;
  std::set<std::string> units;
  for (const AxisDescription& axis : profile.cast<const Profile&>().hand().axes) {
    units.insert(axis.unit());
    each += (each.empty() ? "" : ", ") + std::string(axis.unit());
  }
  return units.empty() ? "deg" : units.size() == 1 ? *units.begin() : each;
}

std::string taxelUnitOf(const py::object& profile) {
  return profile.cast<const Profile&>().hand().unit;
}

py::object matrixArray(const py::module_& xarray,
                       const py::object& profile,
                       const py::dict& matrix) {
  const py::module_ numpy = py::module_::import("numpy");
  const py::object values = profile.attr("matrix")(matrix["index"]);
  const py::object shown = numpy.attr("where")(matrix["static_mask"], values, numpy.attr("nan"));
  const auto places = [&](const char* count) {
    py::dict attributes;
    attributes[kUnits] = "mm";
    const bool alongY = std::string(count) == "rows";
    py::object pitch = matrix["pitch_mm"];
    if (py::isinstance<py::list>(pitch)) pitch = py::list(pitch)[alongY ? 1 : 0];
    return py::make_tuple(
        alongY ? "y" : "x", numpy.attr("arange")(matrix[count]) * pitch, attributes);
  };
  py::dict coordinates;
  coordinates["time"] = instants(profile.attr("time_us"));
  coordinates["y"] = places("rows");
  coordinates["x"] = places("columns");
  py::list dims;
  for (const char* dim : {"time", "y", "x"}) dims.append(dim);
  return xarray.attr("DataArray")(shown.attr("astype")("float32"),
                                  py::arg("coords") = coordinates,
                                  py::arg("dims") = dims,
                                  py::arg("name") = matrix["name"],
                                  py::arg("attrs") = attributesOf(profile, taxelUnitOf(profile)));
}

// Angles or temperatures: (time, `dim`).
py::object seriesArray(const py::module_& xarray,
                       const py::object& profile,
                       const char* series,
                       const char* timeMs,
                       const char* dim,
                       const py::object& names,
                       const std::string& unit) {
  const py::object values = profile.attr(series);
  py::dict coordinates;
  coordinates["time"] = millisecondInstants(profile.attr(timeMs));
  if (py::len(names) == py::len(values.attr("T"))) coordinates[dim] = names;
  py::list dims;
  dims.append("time");
  dims.append(dim);
  return xarray.attr("DataArray")(values,
                                  py::arg("coords") = coordinates,
                                  py::arg("dims") = dims,
                                  py::arg("name") = series,
                                  py::arg("attrs") = attributesOf(profile, unit));
}

}  // namespace

py::object profileToPandas(const py::object& profile) {
  const py::module_ pandas = importedPackage("pandas", "to_pandas");
  const py::module_ numpy = py::module_::import("numpy");
  py::list names, masks;
  for (const py::handle each : profile.attr("matrices")) {
    const auto matrix = py::reinterpret_borrow<py::dict>(each);
    const py::object mask = matrix["static_mask"];
    masks.append(mask.attr("ravel")());
    for (const py::handle place : numpy.attr("argwhere")(mask))
      names.append(py::make_tuple(matrix["name"], place.attr("item")(0), place.attr("item")(1)));
  }
  py::list levels;
  for (const char* level : {"matrix", "y", "x"}) levels.append(level);
  const py::object exists = numpy.attr("concatenate")(masks);
  const py::object values =
      profile.attr("frames")().attr("T").attr("__getitem__")(exists).attr("T");
  py::object frame = pandas.attr("DataFrame")(
      values,
      py::arg("index") =
          pandas.attr("DatetimeIndex")(instants(profile.attr("time_us")), py::arg("name") = "time"),
      py::arg("columns") =
          pandas.attr("MultiIndex").attr("from_tuples")(names, py::arg("names") = levels));
  frame.attr("attrs").attr("update")(attributesOf(profile, taxelUnitOf(profile)));
  return frame;
}

py::object profileToXarray(const py::object& profile, std::optional<std::int64_t> matrix) {
  const py::module_ xarray = importedPackage("xarray", "to_xarray");
  const py::list matrices = profile.attr("matrices");
  if (matrix) {
    if (*matrix < 0 || static_cast<std::size_t>(*matrix) >= matrices.size())
      throw py::index_error("matrix " + std::to_string(*matrix) + " is not in 0.." +
                            std::to_string(matrices.size() - 1));
    return matrixArray(xarray, profile, matrices[static_cast<std::size_t>(*matrix)]);
  }
  py::dict all;
  for (const py::handle each : matrices) {
    const auto one = py::reinterpret_borrow<py::dict>(each);
    all[one["name"]] = matrixArray(xarray, profile, one);
  }
  if (py::len(profile.attr("angle_time_ms")) > 0)
    all["angles"] = seriesArray(xarray,
                                profile,
                                "angles",
                                "angle_time_ms",
                                "axis",
                                profile.attr("axes"),
                                angleUnitOf(profile));
  if (py::len(profile.attr("temperature_time_ms")) > 0)
    all["temperatures"] = seriesArray(xarray,
                                      profile,
                                      "temperatures",
                                      "temperature_time_ms",
                                      "sensor",
                                      profile.attr("temperature_sensors"),
                                      "deg C");
  return all;
}

void bindTables(py::module_& module) {
  module.def(
      "to_pandas",
      &toPandas,
      py::arg("table"),
      py::kw_only(),
      py::arg("unit") = "counts",
      "pandas.DataFrame of a table (signals(), slip(), contact(), grasps(), ..): the columns "
      "of flat(), indexed by host time (datetime64, UTC) where the table has time_ms or "
      "begin_ms. attrs['units']: column -> unit; `unit` is that of the taxels' values. "
      "ImportError without pandas, ValueError for what is no table.");
  module.def("to_xarray",
             &toXarray,
             py::arg("table"),
             py::kw_only(),
             py::arg("unit") = "counts",
             "xarray.Dataset of a table: dims time (host time as datetime64, UTC; `row` where the "
             "table has no time), matrix, and axis (x, y, z) of places and directions; the "
             "attribute units of each variable; `unit` is that of the taxels' values. Lists of "
             "different lengths, as fingers of grasps(), are left out. ImportError without xarray, "
             "ValueError for what is no table.");
}

}  // namespace palpate::python
