#include "palpate/kinematics/object_size.h"

#include <gtest/gtest.h>
