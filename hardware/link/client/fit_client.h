#pragma once

#include "core/base/run_context.h"
#include "hardware/api/head_fit.h"
#include "hardware/link/client/link_session.h"

namespace foresight {

/// Has the head make a fit, and waits for it through blackouts; the same order is never made twice.
/// Fails as the fit did, with kCancelled, kDevice where the head does not answer for two minutes,
/// and kState where it fits for somebody else.
Result<HeadFit> FitOnHead(LinkSession& session, const HeadFitOrder& order,
                          const RunContext& context);

}  // namespace foresight
