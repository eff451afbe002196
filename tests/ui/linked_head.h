#pragma once

#include "tests/ui/fake_head.h"
#include "tests/ui/fake_link.h"

namespace foresight {

/// A head that is elsewhere.
class LinkedHead final : public FakeHead {
 public:
  using FakeHead::FakeHead;
  HeadLink* Link() override { return &link; }
  FakeLink link;
};

}  // namespace foresight
