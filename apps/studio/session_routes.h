// SPDX-License-Identifier: Apache-2.0
// A session: the sound that begins it, its contacts, and what its page has kept.
#pragma once

#include "studio/workshop.h"

namespace ifa::studio {

void postSound(Workshop& workshop, Exchange& exchange);
void getSession(Workshop& workshop, Exchange& exchange);
void getSound(Workshop& workshop, Exchange& exchange);
void putState(Workshop& workshop, Exchange& exchange);
/// Labels of any kind that the program reads, as marks; of no session.
void postLabels(Workshop& workshop, Exchange& exchange);

}  // namespace ifa::studio
