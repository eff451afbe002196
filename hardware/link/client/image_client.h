#pragma once

#include "hardware/api/head_image.h"
#include "hardware/link/client/link_session.h"

namespace foresight {

/// Fails with kDevice where the head does not answer in half a minute, kState where it has no such
/// image or part.
Result<HeadImage> FetchHeadImage(LinkSession& session, const HeadImageOrder& order);

}  // namespace foresight
