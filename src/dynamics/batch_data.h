// SPDX-License-Identifier: Apache-2.0
// What a batch keeps of its simulations, whatever the instruction set that runs them.
#pragma once

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
  struct Place {
    explicit Place(const BodyModel& body) : watch(body) {}

    alignas(64) Simulation<double> sim;
    GroundWatch watch;
    bool renewed = false;  ///< another simulation was started while the last piece was told
  };

  Data(const BodyModel& model, std::size_t count) : body(model), places(count, Place(model)) {}

  void wait(std::size_t place, std::size_t station) { waiting[station].push_back(place); }

  const BodyModel& body;
  std::vector<Place> places;
  std::vector<std::size_t> waiting[kStations];
};

}  // namespace ifa
