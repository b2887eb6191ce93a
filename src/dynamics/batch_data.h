// SPDX-License-Identifier: Apache-2.0
// What a batch keeps of its simulations, whatever the instruction set that runs them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dynamics/batch_stepper.h"
#include "dynamics/ground_watch.h"
#include "dynamics/simulation.h"

namespace ifa {

/// What a simulation waits for. Impacts and steps in contact of different numbers of points take
/// different times, and wait apart: there are kImpacts and kContacts stations of these from the
/// first on.
enum Station : std::size_t {
  kArrive,
  kFlight,
  kHighFlight,
  kImpact,
  kContact = kImpact + 4,
  kStations = kContact + 4
};
inline constexpr std::size_t kImpacts = 4, kContacts = 4;

struct BatchStepper::Data {
  /// Two listed vertices, as they are moved into lanes together.
  struct alignas(64) Pair {
    double numbers[8];
  };
  struct Place {
    explicit Place(const BodyModel& body) : listed(body.rows.size() / 2) {}

    alignas(64) Simulation<double> sim;
    alignas(64) GroundCover<double> cover;
    std::vector<Pair> listed;  ///< as GroundLanes::list() makes it
    bool renewed = false;      ///< another simulation was started while the last piece was told
  };

  /// A pile of places, with room for all of them.
  struct Pile {
    std::size_t size = 0;
    std::vector<std::uint32_t> places;
  };

  Data(const BodyModel& model, std::size_t count) : body(model), places(count, Place(model)) {
    for (Pile& pile : waiting) pile.places.resize(count);
  }

  void wait(std::size_t place, std::size_t station) {
    Pile& pile = waiting[station];
    pile.places[pile.size++] = static_cast<std::uint32_t>(place);
  }

  const BodyModel& body;
  std::vector<Place> places;
  Pile waiting[kStations];
};

}  // namespace ifa
