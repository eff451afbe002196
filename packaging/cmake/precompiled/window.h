#pragma once

#include <QtCore>
#include <QtWidgets>

#include "packaging/cmake/precompiled/common.h"
