// SPDX-License-Identifier: Apache-2.0
// From contacts and an object to takes, and from a take to a film.
#pragma once

#include "studio/workshop.h"

namespace ifa::studio {

/// Plans; the event "done" has {"plan", "takes", "failure"}.
void postPlan(Workshop& workshop, Exchange& exchange);
void getTakeFile(Workshop& workshop, Exchange& exchange);
/// Draws a take's film, {"final", "overlay"}, which then is among its files.
void postFilm(Workshop& workshop, Exchange& exchange);

}  // namespace ifa::studio
