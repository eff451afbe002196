#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "packaging/cmake/precompiled/common.h"
