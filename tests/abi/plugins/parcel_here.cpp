#include "parcel.h"

LOCKSTEP_PLUGIN("parcel_here", "1.0", "For tests", lockstep::run_context<Office>(),
                lockstep::leaf<Send>("SendHere", "Sends a parcel"),
                lockstep::leaf<Receive>("ReceiveHere", "Receives a parcel"));
