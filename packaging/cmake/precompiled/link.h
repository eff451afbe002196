#pragma once

#include <grpcpp/grpcpp.h>

#include "packaging/cmake/precompiled/common.h"
#include "sensor_head.grpc.pb.h"
