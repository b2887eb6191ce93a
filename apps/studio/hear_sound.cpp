// SPDX-License-Identifier: Apache-2.0
#include "studio/hear_sound.h"

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "sound/onset_detector.h"
#include "sound/sound.h"

namespace ifa::studio {

Result<void> hearSound(const std::filesystem::path& path, const std::filesystem::path& folder) {
  SoundLimits limits;
  limits.maxSeconds = kMaxSoundSeconds;
  limits.maxBytes = 1 << 30;
  auto sound = readSound(path, limits);
  if (!sound) return tl::unexpected(sound.error());
  auto contacts = nlohmann::json::array();
  if (const auto detected = detectContacts(*sound)) {
    for (const DetectedContact& contact : *detected) {
      contacts.push_back(
          {{"start", contact.start}, {"end", contact.end}, {"confidence", contact.confidence}});
    }
  }
  const nlohmann::json heard = {
      {"rate", sound->rate}, {"duration", sound->duration()}, {"contacts", std::move(contacts)}};
  if (auto written = writeWav(folder / "sound.wav", *sound); !written) return written;
  return writeFileAtomically(folder / "heard.json", heard.dump());
}

}  // namespace ifa::studio
