// SPDX-License-Identifier: Apache-2.0
#include "sound/onset_detector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sound/band_energy.h"

namespace ifa {
namespace {

double decibels(double ratio) { return 10 * std::log10(ratio); }
double ratioOf(double db) { return std::pow(10.0, db / 10); }

/// How much the sound rises, and how loud it then is, at every hop.
struct Novelty {
  std::vector<double> rise;   ///< dB, mean over the bands
  std::vector<double> level;  ///< mean square after the hop, summed over the bands
};

/// What was there before the sound began, as far as can be told: the lowest tenth of a band's
/// energies. So a recording that begins amid noise does not begin with an attack.
double background(const BandEnergy& band, std::ptrdiff_t window) {
  std::vector<double> energies(band.hops());
  for (std::size_t k = 0; k < energies.size(); ++k) {
    const auto start = static_cast<std::ptrdiff_t>(k);
    energies[k] = band.mean(start, start + window);
  }
  const auto tenth = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 10);
  std::nth_element(energies.begin(), tenth, energies.end());
  return *tenth;
}

/// Mean energy over the hops before `now`, with the background where the sound has not begun.
double meanBefore(const BandEnergy& band, std::ptrdiff_t now, std::ptrdiff_t hops,
                  double background) {
  const auto known = static_cast<double>(std::min(now, hops));
  const auto all = static_cast<double>(hops);
  return (band.mean(now - hops, now) * known + background * (all - known)) / all;
}

std::vector<double> levels(const BandEnergies& energies, std::ptrdiff_t window) {
  std::vector<double> level(energies.hops(), 0.0);
  for (const BandEnergy& band : energies.bands) {
    for (std::size_t k = 0; k < level.size(); ++k) {
      const auto start = static_cast<std::ptrdiff_t>(k);
      level[k] += band.mean(start, start + window);
    }
  }
  return level;
}

/// Ratio of the energy just after each hop to that just before, in dB, falls counted as none, mean
/// over the bands. The floor keeps what nobody hears from looking like a rise.
Novelty noveltyOf(const BandEnergies& energies, const DetectorSettings& settings) {
  const auto after = energies.hopsIn(settings.after), before = energies.hopsIn(settings.before);
  Novelty novelty;
  novelty.level = levels(energies, after);
  const double loudest = *std::max_element(novelty.level.begin(), novelty.level.end());
  const auto bands = static_cast<double>(energies.bands.size());
  // Ten decibels under the range, so that a contact at its end still stands out.
  const double floor = loudest / bands * ratioOf(-settings.range - 10);
  novelty.rise.assign(energies.hops(), 0.0);
  for (const BandEnergy& band : energies.bands) {
    const double unheard = background(band, before);
    for (std::size_t k = 0; k < novelty.rise.size(); ++k) {
      const auto now = static_cast<std::ptrdiff_t>(k);
      const double ratio =
          (band.mean(now, now + after) + floor) / (meanBefore(band, now, before, unheard) + floor);
      if (ratio > 1) novelty.rise[k] += decibels(ratio) / bands;
    }
  }
  return novelty;
}

/// Hops whose rise is at least `minRise` and the largest (the first of equals) within `reach`.
std::vector<std::size_t> peaks(const Novelty& novelty, double minRise, double minLevel,
                               std::ptrdiff_t reach) {
  const auto& rise = novelty.rise;
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < rise.size(); ++k) {
    if (rise[k] < minRise || novelty.level[k] < minLevel) continue;
    const std::size_t first = k - std::min(k, static_cast<std::size_t>(reach));
    const std::size_t last = std::min(rise.size(), k + static_cast<std::size_t>(reach) + 1);
    const auto begin = rise.begin();
    const auto highest = std::max_element(begin + static_cast<std::ptrdiff_t>(first),
                                          begin + static_cast<std::ptrdiff_t>(last));
    if (highest - begin == static_cast<std::ptrdiff_t>(k)) found.push_back(k);
  }
  return found;
}

/// Where contacts begin. The last one is the softest, and nothing loud comes after it that echoes:
/// what follows the last attack may rise a little less.
std::vector<std::size_t> attacksIn(const Novelty& novelty, double minLevel, std::ptrdiff_t interval,
                                   const DetectorSettings& settings) {
  auto attacks = peaks(novelty, settings.minRise, minLevel, interval);
  if (attacks.empty()) return attacks;
  const std::size_t last = attacks.back();
  for (const std::size_t k :
       peaks(novelty, settings.minRise - settings.lastEase, minLevel, interval)) {
    if (k > last) attacks.push_back(k);
  }
  return attacks;
}

/// Logistic regression of what was true among rises from 3 dB on in recordings (docs/detection.md):
/// even odds at 4.5 dB, e times better with every decibel.
double confidenceOf(double rise) { return 1 / (1 + std::exp(4.5 - rise)); }

/// One contact a peak; its level is the highest in the next 20 ms, as a signature's amplitude is.
/// Levels look `after` hops ahead, so they are read no nearer to the next attack than that.
std::vector<DetectedContact> contactsAt(const std::vector<std::size_t>& attacks,
                                        const Novelty& novelty, double loudest, double hop,
                                        std::size_t after) {
  const auto reach = static_cast<std::size_t>(std::lround(0.020 / hop));
  std::vector<DetectedContact> contacts;
  for (std::size_t i = 0; i < attacks.size(); ++i) {
    const std::size_t k = attacks[i];
    const std::size_t next = i + 1 < attacks.size()
                                 ? attacks[i + 1] - std::min(after, attacks[i + 1])
                                 : novelty.level.size();
    const std::size_t end = std::max(k + 1, std::min(next, k + reach));
    const auto begin = novelty.level.begin();
    const double highest = *std::max_element(begin + static_cast<std::ptrdiff_t>(k),
                                             begin + static_cast<std::ptrdiff_t>(end));
    const double start = static_cast<double>(k) * hop;
    contacts.push_back({start, start, decibels(highest / loudest), novelty.rise[k],
                        confidenceOf(novelty.rise[k])});
  }
  return contacts;
}

/// Decision: whatever is much softer than the loudest contact and comes before all that are not is
/// the hand, not the object; all amplitudes are relative to the first contact's.
void dropLeadIn(std::vector<DetectedContact>& contacts, double leadIn) {
  const auto first =
      std::find_if(contacts.begin(), contacts.end(),
                   [&](const DetectedContact& contact) { return contact.level >= -leadIn; });
  if (first != contacts.end()) contacts.erase(contacts.begin(), first);
}

/// End of the rattle that follows the last contact: as long as small rises come without a pause.
double rattleEnd(const std::vector<double>& smallRises, double start,
                 const DetectorSettings& settings) {
  double end = start;
  for (const double time : smallRises) {
    if (time > end && time - end <= settings.rattleGap) end = time;
  }
  return end - start >= settings.minDuration ? end : start;
}

/// Whether the object keeps to the surface between two contacts: small rises as dense as the merge
/// filter's gap, or a few of them and never a flight between.
bool rattlesBetween(const std::vector<double>& smallRises, double first, double second,
                    const DetectorSettings& settings) {
  int between = 0;
  double before = first, longest = 0;
  for (const double time : smallRises) {
    if (time <= first || time >= second) continue;
    longest = std::max(longest, time - before);
    before = time;
    ++between;
  }
  longest = std::max(longest, second - before);
  return second - first <= settings.denseGap * (between + 1) ||
         (between >= settings.rattleFill && longest <= settings.rattlePause);
}

/// Makes the last contacts one with what goes on between them, from the end back.
void joinRattle(std::vector<DetectedContact>& contacts, const std::vector<double>& smallRises,
                const DetectorSettings& settings) {
  while (contacts.size() > 1) {
    const DetectedContact last = contacts.back();
    DetectedContact& previous = contacts[contacts.size() - 2];
    if (!rattlesBetween(smallRises, previous.start, last.start, settings)) return;
    previous.end = last.end;
    contacts.pop_back();
  }
}

}  // namespace

Result<std::vector<DetectedContact>> detectContacts(const Sound& sound,
                                                    const DetectorSettings& settings) {
  const auto nothing = badInput("no contact can be heard in the sound", "",
                                "label the contacts by hand and give the labels");
  if (sound.samples.empty() || sound.rate <= 0) return nothing;
  const BandEnergies energies = bandEnergies(sound);
  const Novelty novelty = noveltyOf(energies, settings);
  const double loudest = *std::max_element(novelty.level.begin(), novelty.level.end());
  if (!(loudest > 0)) return nothing;
  const double minLevel = loudest * ratioOf(-settings.range);
  const auto interval = energies.hopsIn(settings.minInterval);
  auto contacts =
      contactsAt(attacksIn(novelty, minLevel, interval, settings), novelty, loudest, energies.hop,
                 static_cast<std::size_t>(energies.hopsIn(settings.after)));
  if (contacts.empty()) return nothing;
  dropLeadIn(contacts, settings.leadIn);
  std::vector<double> smallRises;
  for (const std::size_t k :
       peaks(novelty, settings.rattleRise, minLevel / 10, (interval + 1) / 2)) {
    smallRises.push_back(static_cast<double>(k) * energies.hop);
  }
  DetectedContact& last = contacts.back();
  last.end = std::min(rattleEnd(smallRises, last.start, settings), sound.duration());
  joinRattle(contacts, smallRises, settings);
  return contacts;
}

}  // namespace ifa
