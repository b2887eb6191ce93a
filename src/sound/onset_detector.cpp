// SPDX-License-Identifier: Apache-2.0
#include "sound/onset_detector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sound/band_energy.h"
#include "sound/rattle.h"
#include "sound/steady_noise.h"

namespace ifa {
namespace {

double decibels(double ratio) { return 10 * std::log10(ratio); }
double ratioOf(double db) { return std::pow(10.0, db / 10); }

/// How much the sound rises, and how loud it then is, at every hop.
struct Novelty {
  std::vector<double> rise;   ///< dB, mean over the bands
  std::vector<double> level;  ///< mean square after the hop, summed over the bands
  double loudest = 0;         ///< level
  double quietest = 0;        ///< level of what is listened to
  double floor = 0;           ///< energy of a band that nobody hears
};

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
  novelty.loudest = *std::max_element(novelty.level.begin(), novelty.level.end());
  novelty.quietest = novelty.loudest * ratioOf(-settings.range);
  const auto bands = static_cast<double>(energies.bands.size());
  // Ten decibels under the range, so that a contact at its end still stands out.
  const double floor = novelty.floor = novelty.quietest / 10 / bands;
  novelty.rise.assign(energies.hops(), 0.0);
  for (const BandEnergy& band : energies.bands) {
    // What was there before the sound began, as far as can be told: so a recording that begins amid
    // noise does not begin with an attack.
    const double unheard = lowestOf(band, before, 0.1);
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
std::vector<std::size_t> peaks(const std::vector<double>& rise, double minRise,
                               const std::vector<double>& level, double minLevel,
                               std::ptrdiff_t reach) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < rise.size(); ++k) {
    if (rise[k] < minRise || level[k] < minLevel) continue;
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
std::vector<std::size_t> attacksIn(const Novelty& novelty, std::ptrdiff_t interval,
                                   const DetectorSettings& settings) {
  const auto attacksOver = [&](double rise) {
    return peaks(novelty.rise, rise, novelty.level, novelty.quietest, interval);
  };
  auto attacks = attacksOver(settings.minRise);
  if (attacks.empty()) return attacks;
  const std::size_t last = attacks.back();
  for (const std::size_t k : attacksOver(settings.minRise - settings.lastEase)) {
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
                                        const Novelty& novelty, double hop, std::size_t after) {
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
    contacts.push_back({start, start, decibels(highest / novelty.loudest), novelty.rise[k],
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

/// Hops where the sound rises more than a steady noise would: some of the rises that noise hides.
std::vector<std::size_t> outOfNoise(const BandEnergies& energies, const Novelty& novelty,
                                    const DetectorSettings& settings) {
  const auto unlikely = unlikelyAsNoise(
      energies, {settings.after, settings.before, novelty.floor, settings.ringSlope});
  return peaks(unlikely, -std::log(settings.falseAlarm), novelty.level, novelty.quietest,
               energies.hopsIn(settings.minInterval));
}

/// Times of rises too small for an attack, of attacks, and of what noise hides.
std::vector<double> smallRisesIn(const Novelty& novelty, const std::vector<std::size_t>& hidden,
                                 std::ptrdiff_t interval, double hop,
                                 const DetectorSettings& settings) {
  const auto reach = static_cast<std::size_t>((interval + 1) / 2);
  const auto seen = peaks(novelty.rise, settings.rattleRise, novelty.level, novelty.quietest / 10,
                          static_cast<std::ptrdiff_t>(reach));
  auto hops = seen;
  for (const std::size_t k : hidden) {
    const auto next = std::lower_bound(seen.begin(), seen.end(), k - std::min(k, reach));
    if (next == seen.end() || *next > k + reach) hops.push_back(k);
  }
  std::sort(hops.begin(), hops.end());
  std::vector<double> times;
  for (const std::size_t k : hops) times.push_back(static_cast<double>(k) * hop);
  return times;
}

/// Whether something at `time` belongs to one of the contacts from number `from` on, or comes
/// before all of them.
bool isTaken(double time, const std::vector<DetectedContact>& contacts, std::size_t from,
             const Rattles& rattles, double interval) {
  for (std::size_t i = from; i < contacts.size(); ++i) {
    const DetectedContact& contact = contacts[i];
    const double end =
        i + 1 < contacts.size() ? rattles.endOf(contact.start, contacts[i + 1].start) : contact.end;
    if (time >= contact.start - interval && time <= end + interval) return true;
  }
  return time < contacts[from].start;
}

/// What noise hides and is a contact of its own. Decision: near the end only, from the last contact
/// but one on. There it matters most and nothing loud echoes; earlier, much is found that no person
/// would mark.
std::vector<std::size_t> softAttacks(std::vector<std::size_t> hidden, const Novelty& novelty,
                                     double hop, const std::vector<DetectedContact>& contacts,
                                     const Rattles& rattles, const DetectorSettings& settings) {
  const std::size_t from = contacts.size() - std::min<std::size_t>(2, contacts.size());
  std::erase_if(hidden, [&](std::size_t k) {
    return novelty.rise[k] < settings.minRise - settings.noiseEase ||
           isTaken(static_cast<double>(k) * hop, contacts, from, rattles, settings.minInterval);
  });
  return hidden;
}

/// What share of soft contacts is true: 72 of 81 in recordings with noise added
/// (docs/detection.md). That noise hid a rise says nothing against it.
constexpr double kSoftConfidence = 0.89;

/// Puts soft contacts, which begin at `soft`, between the others.
void add(const std::vector<std::size_t>& soft, const Novelty& novelty, double hop,
         std::size_t after, std::vector<DetectedContact>& contacts) {
  if (soft.empty()) return;
  auto hops = soft;
  for (const DetectedContact& contact : contacts) {
    hops.push_back(static_cast<std::size_t>(std::lround(contact.start / hop)));
  }
  std::sort(hops.begin(), hops.end());
  auto all = contactsAt(hops, novelty, hop, after);
  auto known = contacts.begin();
  for (DetectedContact& contact : all) {
    if (known != contacts.end() && known->start == contact.start) {
      contact.end = (known++)->end;
    } else {
      contact.confidence = std::max(contact.confidence, kSoftConfidence);
    }
  }
  contacts = std::move(all);
}

}  // namespace

Result<std::vector<DetectedContact>> detectContacts(const Sound& sound,
                                                    const DetectorSettings& settings) {
  const auto nothing = badInput("no contact can be heard in the sound", "",
                                "label the contacts by hand and give the labels");
  if (sound.samples.empty() || sound.rate <= 0) return nothing;
  const BandEnergies energies = bandEnergies(sound);
  const Novelty novelty = noveltyOf(energies, settings);
  if (!(novelty.loudest > 0)) return nothing;
  const auto interval = energies.hopsIn(settings.minInterval);
  const auto after = static_cast<std::size_t>(energies.hopsIn(settings.after));
  auto contacts = contactsAt(attacksIn(novelty, interval, settings), novelty, energies.hop, after);
  if (contacts.empty()) return nothing;
  dropLeadIn(contacts, settings.leadIn);
  const auto hidden = outOfNoise(energies, novelty, settings);
  const Rattles rattles(smallRisesIn(novelty, hidden, interval, energies.hop, settings), settings);
  rattles.joinLast(contacts);
  contacts.back().end = std::min(contacts.back().end, sound.duration());
  add(softAttacks(hidden, novelty, energies.hop, contacts, rattles, settings), novelty,
      energies.hop, after, contacts);
  return contacts;
}

}  // namespace ifa
