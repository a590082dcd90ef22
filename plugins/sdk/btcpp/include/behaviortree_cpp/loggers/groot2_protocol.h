// The messages of Groot2's protocol are not for programs here: loggers/groot2_publisher.h speaks
// it. Sources that only include this compile.
#pragma once
