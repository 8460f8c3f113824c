// The one place that knows which versions of Ceres this builds on.
#pragma once

#include <ceres/manifold.h>
#include <ceres/version.h>

static_assert(CERES_VERSION_MAJOR > 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR >= 1),
              "smash needs Ceres 2.1 or later (ceres::Manifold)");
