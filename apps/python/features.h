// Makes a feature table from a Python argument: a profile, recordings and folders, or an existing
// table.
#pragma once

#include <pybind11/pybind11.h>

#include "palpate/recognition/feature_table.h"

namespace palpate::python {

// The feature set with this name: "study", "best", "session"; raises ValueError.
FeatureSet featureSetOf(const std::string& name);
// `source`: Profile, Features, a path, or a list of paths. The caller holds Python's global lock.
// Raises Error for a table of another feature set.
FeatureTable featuresOf(const pybind11::object& source, FeatureSet set);
// Raises Error when the table has no row.
void requireRows(const FeatureTable& table);

}  // namespace palpate::python
