// What the tests of the rooms read.
#include <random>

#include <gtest/gtest.h>

#include "core.h"
