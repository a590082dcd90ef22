#include "parcel.h"

LOCKSTEP_PLUGIN("parcel_there", "1.0", "For tests", lockstep::run_context<Office>(),
                lockstep::leaf<Send>("SendThere", "Sends a parcel"),
                lockstep::leaf<Receive>("ReceiveThere", "Receives a parcel"),
                lockstep::leaf<Watch>("WatchThere", "Sees another parcel"));
