// SPDX-License-Identifier: Apache-2.0
#include "dynamics/batch_stepper.h"

#include "dynamics/batch_data.h"

// Of the instruction sets that Highway knows for x86: the one that every processor has, AVX2 and
// AVX-512. Registers without a fixed size cannot be members.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dynamics/batch_stepper.cpp"
#include "hwy/foreach_target.h"  // first of Highway's
#include "dynamics/lanes_of_target.h"

HWY_BEFORE_NAMESPACE();
namespace ifa {
namespace HWY_NAMESPACE {

using Lanes = ifa::Wide;
using Mask = ifa::WideMask;
using LaneSim = ifa::Simulation<Lanes>;
using LaneGround = ifa::GroundLanes<Lanes>;
constexpr std::size_t kLanes = ifa::LaneTraits<Lanes>::kLanes;

/// Runs a batch to its end. Pieces of motion of the same kind are done together: those that wait at
/// one station are taken into the lanes, moved, told and put where they wait next.
class BatchRun {
 public:
  BatchRun(BatchStepper& batch, BatchStepper::Data& data, double limit, BatchListener& listener)
      : batch_(batch),
        data_(data),
        limit_(limit),
        listener_(listener),
        ground_(data.body),
        contact_(data.body) {}

  void run() {
    while (take()) {
      switch (station_) {
        case Station::kArrive:
          arrive();
          break;
        case Station::kFlight:
          fly();
          break;
        case Station::kImpact:
          hit();
          break;
        case Station::kContact:
          step();
          break;
      }
    }
  }

 private:
  /// Fields of a simulation without the points of the step before, and of one of these.
  static constexpr std::size_t kFields =
      sizeof(ifa::Simulation<double>) / sizeof(double) -
      ifa::Simulation<double>::kMaxPoints * sizeof(ifa::LastPoint<double>) / sizeof(double);
  static constexpr std::size_t kPointFields = sizeof(ifa::LastPoint<double>) / sizeof(double);

  bool take();
  void load(std::size_t fields);
  void store(unsigned lanes, std::size_t fields);
  void look();
  void arrive();
  void fly();
  void hit();
  void step();
  bool tell(std::size_t lane, Advance did, const KernelState<double>& before,
            const KernelState<double>& state, bool touching);
  void waitAtGround(unsigned hits, std::size_t lane) {
    data_.wait(taken_[lane], (hits >> lane & 1U) != 0 ? Station::kImpact : Station::kContact);
  }
  [[nodiscard]] BatchStepper::Data::Place& place(std::size_t lane) {
    return data_.places[taken_[lane]];
  }
  [[nodiscard]] static double* numbers(BatchStepper::Data::Place& place) {
    return reinterpret_cast<double*>(&place.sim);
  }
  [[nodiscard]] static KernelState<double> stateOf(const ifa::KernelState<Lanes>& all,
                                                   std::size_t lane);

  BatchStepper& batch_;
  BatchStepper::Data& data_;
  Lanes limit_;
  BatchListener& listener_;
  Station station_ = Station::kArrive;
  std::size_t taken_[kLanes] = {}, count_ = 0;  ///< places in the lanes
  unsigned used_ = 0;                           ///< lanes that have one, as bits
  LaneSim sim_;
  ifa::Rotation<Lanes> rotation_{ifa::Quat<Lanes>{}};
  LaneGround ground_;
  ifa::ContactPhase<Lanes, LaneGround> contact_;
};

/// Takes as many as there are lanes from where most wait. False when nothing waits.
bool BatchRun::take() {
  std::size_t most = 0;
  for (std::size_t s = 1; s < kStations; ++s) {
    if (data_.waiting[s].size() > data_.waiting[most].size()) most = s;
  }
  auto& waiting = data_.waiting[most];
  station_ = static_cast<Station>(most);
  count_ = std::min(kLanes, waiting.size());
  used_ = (1U << count_) - 1;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    taken_[lane] = waiting.back();
    waiting.pop_back();
  }
  // Lanes that are left over do what the last one does, and nobody looks.
  for (std::size_t lane = count_; lane < kLanes && count_ > 0; ++lane) taken_[lane] = taken_[0];
  return count_ > 0;
}

/// Takes the first `fields` numbers of the simulations into the lanes.
void BatchRun::load(std::size_t fields) {
  alignas(64) std::int64_t from[kLanes];
  const double* base = numbers(data_.places[0]);
  for (std::size_t lane = 0; lane < kLanes; ++lane) from[lane] = numbers(place(lane)) - base;
  const auto index = ifa::loadIndices<Lanes>(from);
  Lanes* to = reinterpret_cast<Lanes*>(&sim_);
  for (std::size_t f = 0; f < fields; ++f) to[f] = ifa::fromTable<Lanes>(base + f, index);
}

/// Gives them back from `lanes`.
void BatchRun::store(unsigned lanes, std::size_t fields) {
  const auto* from = reinterpret_cast<const double*>(&sim_);
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    double* to = numbers(place(lane));
    for (std::size_t f = 0; f < fields; ++f) to[f] = from[f * kLanes + lane];
  }
}

KernelState<double> BatchRun::stateOf(const ifa::KernelState<Lanes>& all, std::size_t lane) {
  KernelState<double> one;
  const auto* from = reinterpret_cast<const double*>(&all);
  auto* to = reinterpret_cast<double*>(&one);
  for (std::size_t f = 0; f < sizeof one / sizeof(double); ++f) to[f] = from[f * kLanes + lane];
  return one;
}

/// Measures the vertices that a step from here can bring to the ground.
void BatchRun::look() {
  const GroundWatch* watches[kLanes];
  rotation_ = ifa::Rotation<Lanes>(sim_.state.q);
  if (!data_.places[0].watch.all()) {
    for (std::size_t lane = 0; lane < count_; ++lane) {
      const auto& up = rotation_.rows[2];
      place(lane).watch.cover(ifa::laneOf(sim_.state.position.z, lane),
                              {ifa::laneOf(up.x, lane), ifa::laneOf(up.y, lane),
                               ifa::laneOf(up.z, lane)},
                              ifa::laneOf(sim_.kinetic, lane));
      watches[lane] = &place(lane).watch;
    }
    ground_.takeLists(watches, count_);
  }
  ground_.measure(sim_.state, rotation_);
}

/// Tells one piece. False when the simulation that it belongs to does not go on.
bool BatchRun::tell(std::size_t lane, Advance did, const KernelState<double>& before,
                    const KernelState<double>& state, bool touching) {
  auto& here = place(lane);
  here.renewed = false;
  const auto& sum = contact_.impulse();
  const Vec<double> impulse = {ifa::laneOf(sum.x, lane), ifa::laneOf(sum.y, lane),
                               ifa::laneOf(sum.z, lane)};
  const bool goesOn =
      listener_.hear(batch_, taken_[lane], {did, before, state, impulse, touching});
  return goesOn && !here.renewed;
}

void BatchRun::arrive() {
  load(kFields);
  sim_.kinetic = ifa::kineticEnergy(data_.body, sim_.state.velocity, sim_.state.w);
  look();
  store(used_, kFields);
  const unsigned hits = ifa::laneBits(contact_.hits(sim_, ground_));
  for (std::size_t lane = 0; lane < count_; ++lane) waitAtGround(hits, lane);
}

void BatchRun::fly() {
  load(kFields);
  const unsigned touches = ifa::laneBits(ifa::flyOn(data_.body, limit_, sim_));
  sim_.kinetic = ifa::kineticEnergy(data_.body, sim_.state.velocity, sim_.state.w);
  unsigned hits = 0;
  if (touches != 0) {
    look();
    hits = ifa::laneBits(contact_.hits(sim_, ground_));
  }
  store(used_, kFields);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    const bool touched = (touches >> lane & 1U) != 0;
    const auto& state = place(lane).sim.state;
    if (!tell(lane, touched ? Advance::kTouch : Advance::kFlight, state, state, false)) continue;
    if (touched) {
      waitAtGround(hits, lane);
    } else {
      data_.wait(taken_[lane], Station::kFlight);
    }
  }
}

void BatchRun::hit() {
  load(kFields);
  look();
  contact_.impact(sim_, rotation_, ground_);
  const unsigned hits = ifa::laneBits(contact_.hits(sim_, ground_));
  const unsigned touching = ifa::laneBits(contact_.touches(ground_));
  for (std::size_t lane = 0; lane < count_; ++lane) {
    const KernelState<double> before = place(lane).sim.state;
    store(1U << lane, kFields);
    if (tell(lane, Advance::kImpact, before, place(lane).sim.state,
             (touching >> lane & 1U) != 0)) {
      waitAtGround(hits, lane);
    }
  }
}

void BatchRun::step() {
  std::size_t points = 0;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    points = std::max(points, static_cast<std::size_t>(place(lane).sim.lastCount));
  }
  load(kFields + points * kPointFields);
  look();
  contact_.tryStep(limit_, sim_, rotation_, ground_);
  ground_.goOn();
  const unsigned again = ifa::laneBits(contact_.triesAgain());
  const unsigned lifts = ifa::laneBits(contact_.lifts());
  const unsigned halves = ifa::laneBits(contact_.halves());
  const unsigned rests = ifa::laneBits(contact_.rests());
  const unsigned hits = ifa::laneBits(contact_.hits(sim_, ground_));
  const unsigned touching = ifa::laneBits(contact_.touches(ground_));
  points = static_cast<std::size_t>(contact_.points());
  for (std::size_t lane = 0; lane < count_; ++lane) {
    const unsigned bit = 1U << lane;
    auto& here = place(lane);
    if ((again & bit) != 0) {
      store(bit, kFields);
      data_.wait(taken_[lane], Station::kContact);
      continue;
    }
    KernelState<double> before = here.sim.state;
    if ((lifts & bit) != 0) {
      store(bit, kFields);
      if (!tell(lane, Advance::kLift, before, here.sim.state, false)) continue;
      if (here.sim.stuck > ifa::ContactRules::kLiftsToRest) {
        tell(lane, Advance::kRest, before, here.sim.state, false);
      } else {
        data_.wait(taken_[lane], Station::kFlight);
      }
      continue;
    }
    store(bit, kFields + points * kPointFields);
    const bool touches = (touching & bit) != 0;
    if ((halves & bit) != 0) {
      const KernelState<double> middle = stateOf(contact_.middle(), lane);
      if (!tell(lane, Advance::kContact, before, middle, touches)) continue;
      before = middle;
    }
    if (!tell(lane, Advance::kContact, before, here.sim.state, touches)) continue;
    if ((rests & bit) != 0) {
      tell(lane, Advance::kRest, before, here.sim.state, touches);
    } else {
      waitAtGround(hits, lane);
    }
  }
}

void runBatch(BatchStepper& batch, BatchStepper::Data& data, double limit,
              BatchListener& listener) {
  BatchRun(batch, data, limit, listener).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace ifa
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifa {

namespace {
HWY_EXPORT(runBatch);
}  // namespace

BatchStepper::BatchStepper(const BodyModel& body, std::size_t places)
    : data_(std::make_unique<Data>(body, places)) {}

BatchStepper::~BatchStepper() = default;

std::size_t BatchStepper::places() const { return data_->places.size(); }

void BatchStepper::start(std::size_t place, const KernelState<double>& state) {
  start(place, state, data_->body.surface.restitution);
}

void BatchStepper::start(std::size_t place, const KernelState<double>& state, double restitution) {
  Data::Place& here = data_->places[place];
  here.sim.begin(state, restitution);
  here.renewed = true;
  data_->wait(place, Station::kArrive);
}

void BatchStepper::run(double limit, BatchListener& listener) {
  HWY_DYNAMIC_DISPATCH(runBatch)(*this, *data_, limit, listener);
}

ContactStep Piece::contactStep() const {
  ContactStep step;
  step.time = before.time;
  step.duration = state.time - before.time;
  step.impulse = {impulse.x, impulse.y, impulse.z};
  step.before = rigidState(before);
  step.after = rigidState(state);
  step.touching = touching;
  return step;
}

std::vector<std::string> instructionSets() {
  const std::int64_t inUse = hwy::SupportedTargets();
  hwy::SetSupportedTargetsForTest(0);
  std::vector<std::string> names;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    names.emplace_back(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(inUse);
  return names;
}

std::string instructionSet() {
  return hwy::TargetName(hwy::SupportedAndGeneratedTargets().front());
}

void useInstructionSet(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace ifa
#endif  // HWY_ONCE
