#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "packaging/cmake/precompiled/common.h"
