// SPDX-License-Identifier: Apache-2.0
// cpp-httplib, without the macro by which a system header that it includes names what Eigen names a
// variable.
#pragma once

#include <httplib.h>

#undef _res
