// SPDX-License-Identifier: Apache-2.0
#include "pipeline/hear.h"

#include <fmt/core.h>

#include "signature/marks.h"
#include "signature/signature.h"
#include "signature/signature_json.h"
#include "signature/wav_cues.h"
#include "sound/onset_detector.h"

namespace ifa {

namespace {

Result<ContactSignature> readAlone(const SynchronizeSettings& settings, MarkFormat format,
                                   double mergeGap) {
  if (format == MarkFormat::kSignature) {
    auto signature = readSignature(settings.sound);
    if (signature && settings.terminal) signature->terminal = *settings.terminal;
    return signature;
  }
  const auto marks = readMarks(settings.sound, settings.midi);
  if (!marks) return tl::unexpected(marks.error());
  return signatureWithoutSound(*marks, {mergeGap, settings.terminal}, settings.sound.string());
}

Result<Heard> hearAlone(const SynchronizeSettings& settings, MarkFormat format, double mergeGap) {
  if (!settings.labels.empty()) {
    const char* what = format == MarkFormat::kSignature ? "a signature"
                       : format == MarkFormat::kMidi    ? "a MIDI file"
                                                        : "a table of contacts";
    return tl::unexpected<Error>({ErrorCode::kUsage,
                                  std::string(what) + " has its contacts already",
                                  settings.sound.string(), "leave the labels out"});
  }
  auto signature = readAlone(settings, format, mergeGap);
  if (!signature) return tl::unexpected(signature.error());
  return Heard{std::nullopt, std::move(*signature), {}};
}

Result<std::vector<Label>> detect(const SynchronizeSettings& settings, const Sound& sound) {
  auto contacts = detectContacts(sound);
  if (!contacts) {
    Error error = contacts.error();
    if (error.place.empty()) error.place = settings.sound.string();
    return tl::unexpected(error);
  }
  return labelsFromContacts(*contacts, settings.terminal.value_or(true));
}

Result<std::vector<Label>> findLabels(const SynchronizeSettings& settings, const Sound& sound,
                                      std::vector<std::string>& remarks) {
  if (!settings.labels.empty()) return readMarks(settings.labels, settings.midi);
  if (settings.ignoreCues) return detect(settings, sound);
  auto cues = readWavCues(settings.sound);
  if (!cues || cues->empty()) return cues ? detect(settings, sound) : cues;
  remarks.push_back(
      fmt::format("{}: its cue points ({}) are taken for the contacts; --ignore-cues detects them",
                  settings.sound.string(), cues->size()));
  return cues;
}

}  // namespace

Result<Heard> hear(const SynchronizeSettings& settings, double mergeGap) {
  const MarkFormat format = markFormatOf(settings.sound);
  if (standsAlone(format)) return hearAlone(settings, format, mergeGap);
  auto sound = readSound(settings.sound);
  if (!sound) return tl::unexpected(sound.error());
  Heard heard;
  const auto labels = findLabels(settings, *sound, heard.remarks);
  if (!labels) return tl::unexpected(labels.error());
  const auto place = settings.labels.empty() ? settings.sound : settings.labels;
  auto signature =
      signatureFromLabels(*sound, *labels, {mergeGap, settings.terminal}, place.string());
  if (!signature) {
    if (!heard.remarks.empty()) {
      signature.error().remedy += "; --ignore-cues detects the contacts instead";
    }
    return tl::unexpected(signature.error());
  }
  heard.sound = std::move(*sound);
  heard.signature = std::move(*signature);
  return heard;
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
