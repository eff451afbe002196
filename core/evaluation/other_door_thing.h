#pragma once

#include "core/base/random.h"
#include "core/evaluation/door_hardware.h"

namespace foresight {

/// A bar on posts, swept in one piece, of sections and ways that home does not draw: most have one
/// post, most of these near an end, so that they are levers; the others are T's, pull bars, stubs
/// and hooks. `model` and `door_from_handle` are those of a lever that turns about the first post;
/// MeasureDoorThing says whether it is one.
DoorHardware DrawOtherBar(Random& random);
/// Knobs that are no balls, plates with knockers, mail slots, sockets, closers, handwheels of
/// safes, handles sunk into the door.
DoorHardware DrawOtherFitting(Random& random);

}  // namespace foresight
