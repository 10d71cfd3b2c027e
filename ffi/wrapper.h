/* What bindgen reads: the C interface of whichever Ipopt pkg-config finds. */
#include "IpoptConfig.h"
#include "IpStdCInterface.h"

/* Ipopt up to 3.13 reaches HSL through this loader; 3.14 has no such header. */
#if __has_include("HSLLoader.h")
#include "HSLLoader.h"
#endif
