// SPDX-License-Identifier: Apache-2.0
#include "base/version.h"

namespace ifa {

std::string_view programVersion() { return IFA_VERSION; }

}  // namespace ifa
