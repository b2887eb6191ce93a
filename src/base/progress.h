// SPDX-License-Identifier: Apache-2.0
// The public Progress, under the name that the folders of src/ know.
#pragma once

#include "ifa/progress.h"  // IWYU pragma: export
