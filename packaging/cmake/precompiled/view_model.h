#pragma once

#include <QtCore>

#include "packaging/cmake/precompiled/common.h"
