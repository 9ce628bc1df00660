// A table of features from what Python gives: a profile, recordings and folders, or a table made
// before.
#pragma once

#include <pybind11/pybind11.h>

#include "palpate/recognition/feature_table.h"

namespace palpate::python {

// "study", "best", "session"; raises ValueError.
FeatureSet featureSetOf(const std::string& name);
// source: Profile, Features, a path, or a list of paths. Takes Python's lock to be held. Raises
// Error for a table of another set.
FeatureTable featuresOf(const pybind11::object& source, FeatureSet set);
// Raises Error where the table has no row.
void requireRows(const FeatureTable& table);

}  // namespace palpate::python
