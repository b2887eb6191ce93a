// SPDX-License-Identifier: Apache-2.0
#include "pipeline/hear.h"

#include "signature/labels.h"
#include "signature/signature.h"
#include "signature/signature_json.h"
#include "sound/onset_detector.h"

namespace ifa {

namespace {

bool isSignatureFile(const std::filesystem::path& path) { return path.extension() == ".json"; }

Result<Heard> hearSignature(const SynchronizeSettings& settings) {
  if (!settings.labels.empty()) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "a signature has its contacts already",
                                  settings.sound.string(), "leave the labels out"});
  }
  auto signature = readSignature(settings.sound);
  if (!signature) return tl::unexpected(signature.error());
  if (settings.terminal) signature->terminal = *settings.terminal;
  return Heard{std::nullopt, std::move(*signature)};
}

Result<std::vector<Label>> findLabels(const SynchronizeSettings& settings, const Sound& sound) {
  if (!settings.labels.empty()) return readLabels(settings.labels);
  auto contacts = detectContacts(sound);
  if (!contacts) {
    Error error = contacts.error();
    if (error.place.empty()) error.place = settings.sound.string();
    return tl::unexpected(error);
  }
  return labelsFromContacts(*contacts, settings.terminal.value_or(true));
}

}  // namespace

Result<Heard> hear(const SynchronizeSettings& settings, double mergeGap) {
  if (isSignatureFile(settings.sound)) return hearSignature(settings);
  auto sound = readSound(settings.sound);
  if (!sound) return tl::unexpected(sound.error());
  const auto labels = findLabels(settings, *sound);
  if (!labels) return tl::unexpected(labels.error());
  const auto place = settings.labels.empty() ? settings.sound : settings.labels;
  auto signature =
      signatureFromLabels(*sound, *labels, {mergeGap, settings.terminal}, place.string());
  if (!signature) return tl::unexpected(signature.error());
  return Heard{std::move(*sound), std::move(*signature)};
}

Sound withLeadingSilence(const Sound& sound, std::size_t count) {
  Sound padded = sound;
  padded.samples.insert(padded.samples.begin(), count, 0.0F);
  if (!padded.interleaved.empty()) {
    const auto channels = static_cast<std::size_t>(sound.channels);
    padded.interleaved.insert(padded.interleaved.begin(), count * channels, 0.0F);
  }
  return padded;
}

}  // namespace ifa
