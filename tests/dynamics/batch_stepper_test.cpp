// SPDX-License-Identifier: Apache-2.0
// Simulations side by side have the bits that each has alone: every piece of motion of whole drops,
// for every instruction set that is here, with one, a few and many at a time.
#include "dynamics/batch_stepper.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "body/object_file.h"
#include "dynamics/stepper.h"
#include "kernel_drops.h"
#include "sampler/initial_state.h"
#include "support/box_body.h"

namespace ifa {
namespace {

constexpr std::size_t kDrops = 20;
constexpr std::uint64_t kBegin = 14695981039346656037ULL;

double restitutionOf(std::size_t drop) { return 0.95 - 0.05 * static_cast<double>(drop % 10); }

std::uint64_t hashNumber(double value, std::uint64_t hash) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return (hash ^ bits) * 1099511628211ULL;
}

/// All that is told of a piece of motion.
std::uint64_t hashPiece(const Piece& piece, std::uint64_t hash) {
  hash = hashState(piece.state, hash * 31 + static_cast<std::uint64_t>(piece.did));
  if (piece.did != Advance::kImpact && piece.did != Advance::kContact) return hash;
  hash = hashState(piece.before, hash * 2 + (piece.touching ? 1 : 0));
  hash = hashNumber(piece.impulse.x, hash);
  hash = hashNumber(piece.impulse.y, hash);
  return hashNumber(piece.impulse.z, hash);
}

std::uint64_t hashAlone(const BodyModel& model, const RigidState& start, double restitution) {
  Stepper stepper(model);
  stepper.start(kernelState(start, 0), restitution);
  std::uint64_t hash = kBegin;
  for (Advance did = Advance::kFlight; did != Advance::kRest;) {
    did = stepper.advance(Stepper::kNoLimit);
    hash = hashPiece(stepper.piece(did), hash);
  }
  return hash;
}

/// Drops every start, each where one before has come to rest.
class Drops : public BatchListener {
 public:
  Drops(const BodyModel& model, const std::vector<RigidState>& starts, std::size_t places)
      : starts_(starts), drops_(places), hashes_(starts.size(), kBegin), batch_(model, places) {
    for (std::size_t place = 0; place < places; ++place) startNext(place);
    batch_.run(Stepper::kNoLimit, *this);
  }
  bool hear(BatchStepper&, std::size_t place, const Piece& piece) override {
    std::uint64_t& hash = hashes_[drops_[place]];
    hash = hashPiece(piece, hash);
    return piece.did != Advance::kRest || startNext(place);
  }
  [[nodiscard]] const std::vector<std::uint64_t>& hashes() const { return hashes_; }

 private:
  bool startNext(std::size_t place) {
    if (next_ == starts_.size()) return false;
    drops_[place] = next_;
    batch_.start(place, kernelState(starts_[next_], 0), restitutionOf(next_));
    ++next_;
    return true;
  }

  const std::vector<RigidState>& starts_;
  std::vector<std::size_t> drops_;  ///< in each place
  std::vector<std::uint64_t> hashes_;
  std::size_t next_ = 0;
  BatchStepper batch_;
};

class Batch : public testing::Test {
 protected:
  ~Batch() override { useInstructionSet(best_); }

  static void expectSameBits(const Body& body, const SurfaceProperties& surface,
                             std::size_t drops = kDrops) {
    const BodyModel model(body, surface);
    std::vector<RigidState> starts;
    std::vector<std::uint64_t> alone;
    for (std::size_t i = 0; i < drops; ++i) {
      starts.push_back(sampleInitialState(body, 21, i));
      alone.push_back(hashAlone(model, starts.back(), restitutionOf(i)));
    }
    for (const std::string& name : instructionSets()) {
      useInstructionSet(name);
      ASSERT_EQ(instructionSet(), name);
      for (const std::size_t places : {std::size_t{1}, std::size_t{5}, BatchStepper::kPlaces}) {
        EXPECT_EQ(Drops(model, starts, places).hashes(), alone) << name << ", " << places;
      }
    }
  }

 private:
  std::string best_ = instructionSet();
};

class BatchOfObjects : public Batch, public testing::WithParamInterface<std::string> {};

TEST_P(BatchOfObjects, HaveTheBitsOfEachAlone) {
  const auto body = loadObject(GetParam());
  ASSERT_TRUE(body) << body.error().text();
  expectSameBits(*body, body->definition.surfaces.at(body->definition.defaultSurface));
}

INSTANTIATE_TEST_SUITE_P(Objects, BatchOfObjects,
                         testing::Values("d6", "d20", "CoffeeCup", "Nut", "Eraser", "Lego2x2"));

/// More vertices than a chunk of a flight, and more at the ground than a contact has points.
TEST_F(Batch, OfARoundBodyHasTheBitsOfEachAlone) {
  SurfaceProperties surface;
  surface.rollingFriction = surface.spinningFriction = 1e-4;
  expectSameBits(makePrismBody(80, 0.03, 0.01, 0.1), surface, 9);
}

TEST_F(Batch, ATimeLimitIsKeptByEach) {
  const Body die = makeDieBody();
  const BodyModel model(die, {});
  constexpr double kLimit = 0.25;
  class Limited : public BatchListener {
   public:
    bool hear(BatchStepper&, std::size_t place, const Piece& piece) override {
      end[place] = piece.state;
      return piece.state.time < kLimit && piece.did != Advance::kRest;
    }
    KernelState<double> end[20];
  };
  Limited listener;
  BatchStepper batch(model, 20);
  for (std::size_t i = 0; i < 20; ++i)
    batch.start(i, kernelState(sampleInitialState(die, 4, i), 0));
  batch.run(kLimit, listener);
  for (std::size_t i = 0; i < 20; ++i) {
    Stepper stepper(model);
    stepper.start(kernelState(sampleInitialState(die, 4, i), 0));
    while (stepper.state().time < kLimit && stepper.advance(kLimit) != Advance::kRest) {
    }
    EXPECT_EQ(hashState(listener.end[i], 1), hashState(stepper.state(), 1)) << i;
    EXPECT_LE(listener.end[i].time, kLimit);
  }
}

}  // namespace
}  // namespace ifa
