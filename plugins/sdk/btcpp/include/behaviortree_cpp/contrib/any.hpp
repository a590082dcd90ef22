// Not in lockstep: the compiler says so.
#pragma once

#error \
    "lockstep has none of the library's inner parts: use BT::Any, BT::convertFromString or emitWakeUpSignal() of behaviortree_cpp/bt_factory.h"
