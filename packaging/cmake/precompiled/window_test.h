#pragma once

#include <gtest/gtest.h>

#include "packaging/cmake/precompiled/window.h"
