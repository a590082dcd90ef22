#define PARCEL_WITHOUT_BYTES
#include "parcel.h"

LOCKSTEP_PLUGIN("parcel_closed", "1.0", "For tests", lockstep::run_context<Office>(),
                lockstep::leaf<Send>("SendClosed", "Sends a parcel"),
                lockstep::leaf<Receive>("ReceiveClosed", "Receives a parcel"));
