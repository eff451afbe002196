#pragma once

#include "packaging/cmake/precompiled/link.h"
#include "packaging/cmake/precompiled/test.h"
