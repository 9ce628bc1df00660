// What the tests of the modules read.
#include <random>

#include <gtest/gtest.h>

#include "core.h"
