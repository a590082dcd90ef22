// Included by public code; it needs nothing here.
#pragma once
