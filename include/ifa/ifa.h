// SPDX-License-Identifier: Apache-2.0
// The whole public interface.
#pragma once

#include "ifa/contact_signature.h"  // IWYU pragma: export
#include "ifa/ensemble.h"           // IWYU pragma: export
#include "ifa/event_cut.h"          // IWYU pragma: export
#include "ifa/film.h"               // IWYU pragma: export
#include "ifa/midi_options.h"       // IWYU pragma: export
#include "ifa/motion.h"             // IWYU pragma: export
#include "ifa/progress.h"           // IWYU pragma: export
#include "ifa/result.h"             // IWYU pragma: export
#include "ifa/synchronize.h"        // IWYU pragma: export
