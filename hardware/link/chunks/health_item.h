#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "hardware/api/head_health.h"

namespace foresight {

/// How the devices did during a scan, as ScanSink::OnDeviceHealth has it.
struct HealthReport {
  HeadHealth at_start;
  HeadHealth at_end;
};

/// {"at_start": ..., "at_end": ...}, each as ToJson(HeadHealth) writes it.
std::string ToJson(const HealthReport& report);
/// Fails with kBadData, naming `source`. What a member does not say, or says as null, keeps its
/// default (NaN for numbers).
Result<HealthReport> HealthReportFromJson(std::string_view json, const std::string& source);

}  // namespace foresight
