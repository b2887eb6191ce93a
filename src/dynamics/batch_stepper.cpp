// SPDX-License-Identifier: Apache-2.0
#include "dynamics/batch_stepper.h"

#include "base/sanitized.h"
#include "dynamics/batch_data.h"

// Of the instruction sets that Highway knows for x86: the one that every processor has, AVX2 and
// AVX-512. Registers without a fixed size cannot be members.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dynamics/batch_stepper.cpp"
// The first of Highway's headers, this one comes before all others that use them.
// clang-format off
#include <hwy/foreach_target.h>
#include "dynamics/lanes_of_target.h"
// clang-format on

// Each station is compiled as one function, which saves 4 to 8 % of the time; not where every
// access is checked: compilers take too long over it.
#undef IFA_ONE_FUNCTION
#if defined(NDEBUG) && !defined(IFA_SANITIZED)
#define IFA_ONE_FUNCTION HWY_FLATTEN
#else
#define IFA_ONE_FUNCTION
#endif

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
        nowhere_(data.body),
        ground_(data.body),
        contact_(data.body) {}

  void run() {
    while (take()) {
      if (station_ >= kContact) {
        step();
      } else if (station_ >= kImpact) {
        hit();
      } else if (station_ >= kFlight) {
        fly();
      } else {
        arrive();
      }
    }
  }

 private:
  bool take();
  void load(std::size_t blocks);
  void store(std::size_t blocks);
  void coverLists();
  void makeLists(unsigned lanes);
  void look();
  void arrive();
  IFA_ONE_FUNCTION void fly();
  IFA_ONE_FUNCTION void hit();
  IFA_ONE_FUNCTION void step();
  bool tell(std::size_t lane, Advance did, const KernelState<double>& before,
            const KernelState<double>& state);
  void tellStep(std::size_t lane, bool halved, bool rests);
  void tellLift(std::size_t lane);
  void keepImpulses();
  void keepBefore();
  void waitAtGround(std::size_t lane) {
    data_.wait(taken_[lane], static_cast<std::size_t>(next_[lane]));
  }
  /// Bodies that are too high to touch soon wait apart from those that may.
  void waitForFlight(std::size_t lane) {
    const bool high = place(lane).sim.state.position.z > data_.body.radius;
    data_.wait(taken_[lane], high ? kHighFlight : kFlight);
  }
  void chooseNext();
  [[nodiscard]] BatchStepper::Data::Place& place(std::size_t lane) { return *places_[lane]; }
  [[nodiscard]] static double* numbers(BatchStepper::Data::Place& place) {
    return reinterpret_cast<double*>(&place.sim);
  }
  [[nodiscard]] static KernelState<double> stateOf(const ifa::KernelState<Lanes>& all,
                                                   std::size_t lane);

  static constexpr std::size_t kBlocks = LaneSim::kBlocksWithout;

  BatchStepper& batch_;
  BatchStepper::Data& data_;
  Lanes limit_;
  BatchListener& listener_;
  std::size_t station_ = kArrive;
  std::size_t taken_[kLanes] = {}, count_ = 0;  ///< places in the lanes ...
  BatchStepper::Data::Place* places_[kLanes] = {};
  unsigned used_ = 0;                  ///< ... and lanes that have one, as bits
  BatchStepper::Data::Place nowhere_;  ///< for what the other lanes give back
  LaneSim sim_;
  KernelState<double> before_[kLanes];
  alignas(kLanes * sizeof(double)) double impulse_[3][kLanes] = {};  ///< of all points, N s
  unsigned touching_ = 0;
  alignas(kLanes *
          sizeof(double)) double next_[kLanes] = {};  ///< stations of what is at the ground
  ifa::Rotation<Lanes> rotation_{ifa::Quat<Lanes>{}};
  LaneGround ground_;
  ifa::ContactPhase<Lanes, LaneGround> contact_;
};

/// Takes as many as there are lanes from the station at work, whose code is at hand, or where that
/// has not so many, from where most wait. False when nothing waits.
bool BatchRun::take() {
  std::size_t most = 0;
  for (std::size_t s = 1; s < kStations; ++s) {
    if (data_.waiting[s].size > data_.waiting[most].size) most = s;
  }
  if (data_.waiting[station_].size >= kLanes) most = station_;
  auto& waiting = data_.waiting[most];
  station_ = most;
  count_ = std::min(kLanes, waiting.size);
  used_ = (1U << count_) - 1;
  waiting.size -= count_;
  const std::uint32_t* last = waiting.places.data() + waiting.size;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    taken_[lane] = last[count_ - 1 - lane];
    places_[lane] = &data_.places[taken_[lane]];
  }
  // Lanes that are left over do what the first one does, and nobody looks.
  for (std::size_t lane = count_; lane < kLanes && count_ > 0; ++lane) places_[lane] = places_[0];
  return count_ > 0;
}

/// Takes the first `blocks` of the simulations into the lanes.
void BatchRun::load(std::size_t blocks) {
  const double* from[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) from[lane] = numbers(place(lane));
  auto* to = reinterpret_cast<double*>(&sim_);
  for (std::size_t b = 0; b < blocks; ++b) {
    ifa::loadBlock(from, b * ifa::kBlock, to + b * ifa::kBlock * kLanes);
  }
}

/// Gives them back.
void BatchRun::store(std::size_t blocks) {
  double* to[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    to[lane] = lane < count_ ? numbers(place(lane)) : numbers(nowhere_);
  }
  const auto* from = reinterpret_cast<const double*>(&sim_);
  for (std::size_t b = 0; b < blocks; ++b) {
    ifa::storeBlock(from + b * ifa::kBlock * kLanes, to, b * ifa::kBlock);
  }
}

KernelState<double> BatchRun::stateOf(const ifa::KernelState<Lanes>& all, std::size_t lane) {
  KernelState<double> one;
  const auto* from = reinterpret_cast<const double*>(&all);
  auto* to = reinterpret_cast<double*>(&one);
  for (std::size_t f = 0; f < sizeof one / sizeof(double); ++f) to[f] = from[f * kLanes + lane];
  return one;
}

/// Makes sure that the lists are good, and takes them.
void BatchRun::coverLists() {
  const Lanes height = sim_.state.position.z;
  const auto& up = rotation_.rows[2];
  const double* lists[kLanes];
  double* covers[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    lists[lane] = place(lane).listed[0].numbers;
    covers[lane] = reinterpret_cast<double*>(&place(lane).cover);
  }
  ifa::GroundCover<Lanes> cover;
  ifa::loadBlock(covers, 0, reinterpret_cast<double*>(&cover));
  const unsigned old = ifa::laneBits(!cover.holds(data_.body, height, up, sim_.kinetic)) & used_;
  if (old != 0) {
    makeLists(old);
    ifa::loadBlock(covers, 0, reinterpret_cast<double*>(&cover));
  }
  ground_.takeLists(lists, cover.count);
}

/// Makes the lists of `lanes` anew.
void BatchRun::makeLists(unsigned lanes) {
  ifa::GroundCover<Lanes> cover;
  cover.renew(data_.body, sim_.state.position.z, rotation_.rows[2], sim_.kinetic);
  const auto* all = reinterpret_cast<const double*>(&cover);
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    auto& here = place(lane);
    double own[ifa::kBlock];
    for (std::size_t i = 0; i < ifa::kBlock; ++i) own[i] = all[i * kLanes + lane];
    here.cover = {own[0], {own[1], own[2], own[3]}, own[4], own[5], own[6], 0};
    here.cover.count =
        ground_.list(own[0], {own[1], own[2], own[3]}, own[6], here.listed[0].numbers);
  }
}

/// Measures the vertices that a step from here can bring to the ground.
void BatchRun::look() {
  rotation_ = ifa::Rotation<Lanes>(sim_.state.q);
  if (!ground_.shared()) coverLists();
  ground_.measure(sim_.state, rotation_);
}

/// Says at which station what is at the ground waits next, and whether it touches.
void BatchRun::chooseNext() {
  const auto ahead = contact_.outlook(sim_, ground_);
  touching_ = ifa::laneBits(ahead.touches);
  Lanes next =
      Lanes(static_cast<double>(kContact)) + ifa::laneMin(ahead.heldPoints, Lanes(kContacts - 1));
  ifa::setWhere(
      ahead.hits, next,
      Lanes(static_cast<double>(kImpact) - 1) + ifa::laneMin(ahead.hitPoints, Lanes(kImpacts)));
  ifa::storeLanes(next, next_);
}

/// Tells one piece. False when the simulation that it belongs to does not go on.
bool BatchRun::tell(std::size_t lane, Advance did, const KernelState<double>& before,
                    const KernelState<double>& state) {
  auto& here = place(lane);
  here.renewed = false;
  const Vec<double> impulse = {impulse_[0][lane], impulse_[1][lane], impulse_[2][lane]};
  const bool touching = (touching_ >> lane & 1U) != 0;
  const bool goesOn = listener_.hear(batch_, taken_[lane], {did, before, state, impulse, touching});
  return goesOn && !here.renewed;
}

void BatchRun::keepImpulses() {
  const auto& sum = contact_.impulse();
  ifa::storeLanes(sum.x, impulse_[0]);
  ifa::storeLanes(sum.y, impulse_[1]);
  ifa::storeLanes(sum.z, impulse_[2]);
}

void BatchRun::keepBefore() {
  for (std::size_t lane = 0; lane < count_; ++lane) before_[lane] = place(lane).sim.state;
}

void BatchRun::arrive() {
  load(kBlocks);
  sim_.kinetic = ifa::kineticEnergy(data_.body, sim_.state.velocity, sim_.state.w);
  look();
  chooseNext();
  store(kBlocks);
  for (std::size_t lane = 0; lane < count_; ++lane) waitAtGround(lane);
}

void BatchRun::fly() {
  load(kBlocks);
  const unsigned touches = ifa::laneBits(ifa::flyOn(data_.body, limit_, sim_));
  sim_.kinetic = ifa::kineticEnergy(data_.body, sim_.state.velocity, sim_.state.w);
  if (touches != 0) {
    look();
    chooseNext();
  }
  store(kBlocks);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    const bool touched = (touches >> lane & 1U) != 0;
    const auto& state = place(lane).sim.state;
    if (!tell(lane, touched ? Advance::kTouch : Advance::kFlight, state, state)) continue;
    if (touched) {
      waitAtGround(lane);
    } else {
      waitForFlight(lane);
    }
  }
}

void BatchRun::hit() {
  load(kBlocks);
  look();
  contact_.impact(sim_, rotation_, ground_);
  chooseNext();
  keepImpulses();
  keepBefore();
  store(kBlocks);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    if (tell(lane, Advance::kImpact, before_[lane], place(lane).sim.state)) waitAtGround(lane);
  }
}

void BatchRun::step() {
  std::size_t points = 0;
  for (std::size_t lane = 0; lane < count_; ++lane) {
    points = std::max(points, static_cast<std::size_t>(place(lane).sim.lastCount));
  }
  load(LaneSim::blocks(points));
  look();
  contact_.tryStep(limit_, sim_, rotation_, ground_);
  ground_.goOn();
  chooseNext();
  keepImpulses();
  keepBefore();
  const unsigned again = ifa::laneBits(contact_.triesAgain()) & used_;
  const unsigned lifts = ifa::laneBits(contact_.lifts()) & used_;
  const unsigned taken = used_ & ~(again | lifts);
  const unsigned halves = ifa::laneBits(contact_.halves()) & taken;
  const unsigned rests = ifa::laneBits(contact_.rests()) & taken;
  points = std::max(points, static_cast<std::size_t>(contact_.points()));
  store(taken != 0 ? LaneSim::blocks(points) : kBlocks);
  for (std::size_t lane = 0; lane < count_; ++lane) {
    const unsigned bit = 1U << lane;
    if ((taken & bit) != 0) {
      tellStep(lane, (halves & bit) != 0, (rests & bit) != 0);
    } else if ((again & bit) != 0) {
      data_.wait(taken_[lane], station_);
    } else {
      tellLift(lane);
    }
  }
}

void BatchRun::tellStep(std::size_t lane, bool halved, bool rests) {
  const KernelState<double>& end = place(lane).sim.state;
  if (halved) {
    const KernelState<double> middle = stateOf(contact_.middle(), lane);
    if (!tell(lane, Advance::kContact, before_[lane], middle)) return;
    before_[lane] = middle;
  }
  if (!tell(lane, Advance::kContact, before_[lane], end)) return;
  if (rests) {
    tell(lane, Advance::kRest, before_[lane], end);
  } else {
    waitAtGround(lane);
  }
}

void BatchRun::tellLift(std::size_t lane) {
  const auto& sim = place(lane).sim;
  if (!tell(lane, Advance::kLift, sim.state, sim.state)) return;
  if (sim.stuck > ifa::ContactRules::kLiftsToRest) {
    tell(lane, Advance::kRest, sim.state, sim.state);
  } else {
    waitForFlight(lane);
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
  data_->wait(place, kArrive);
}

void BatchStepper::run(double limit, BatchListener& listener) {
  HWY_DYNAMIC_DISPATCH(runBatch)(*this, *data_, limit, listener);
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
