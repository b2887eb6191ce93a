// SPDX-License-Identifier: Apache-2.0
// Sounds of known contacts for the tests of the command line.
#pragma once

#include <filesystem>
#include <vector>

namespace ifa::test {

struct Click {
  double time = 0;   ///< s
  double level = 1;  ///< of full scale
};

/// Writes a mono WAV, 44.1 kHz, 16 bit: a short burst that dies away in a few ms at each time.
void writeClicks(const std::filesystem::path& path, const std::vector<Click>& clicks,
                 double seconds);

/// Writes Audacity point labels at these times, the last one terminal.
void writeClickLabels(const std::filesystem::path& path, const std::vector<Click>& clicks);

}  // namespace ifa::test
