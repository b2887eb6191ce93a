// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "export/json_node.h"
#include "export/motion_json.h"

namespace ifa {
namespace {

using Json = nlohmann::json;

constexpr double kLongest = 1e6;  // s

template <class Enum>
Enum oneOf(const JsonNode& node, std::initializer_list<const char*> names) {
  const std::string text = node.text();
  int index = 0;
  for (const char* name : names) {
    if (text == name) return static_cast<Enum>(index);
    ++index;
  }
  node.reject("is none of the words that are known");
  return static_cast<Enum>(0);
}

void readObjectAndSound(const JsonNode& root, Motion& motion) {
  const JsonNode object = root.member("object"), sound = root.member("sound");
  motion.object.name = object.member("name").text();
  motion.object.mesh = object.member("mesh").text();
  motion.object.surface = object.member("surface").text();
  motion.object.mass = object.member("mass").number(1e-9, 1e6);
  motion.object.restitution = object.member("restitution").number(0, 1);
  motion.object.friction = object.member("friction").number(0, 100);
  if (root.has("fit")) {
    const JsonNode fit = root.member("fit");
    motion.given = GivenSurface{fit.member("given_surface").text(),
                                fit.member("given_restitution").number(0, 1)};
  }
  motion.sound.file = sound.member("file").text();
  motion.sound.rate = sound.member("rate").integer<int>();
  motion.sound.duration = sound.member("duration").number(0, kLongest);
  motion.sound.firstContact = sound.member("first_contact").number(-kLongest, kLongest);
}

void readOutcome(const JsonNode& root, Motion& motion) {
  motion.success = root.member("success").flag();
  if (root.has("failure")) motion.failure = root.member("failure").text();
  motion.timeLimitReached = root.member("time_limit_reached").flag();
  motion.energyGain = root.member("energy_gain").number(0);
  motion.score = root.member("score").number();
  motion.scoreWithoutSound = root.member("score_without_sound").number();
  motion.searchSeconds = root.member("search_seconds").number(0);
  const JsonNode bend = root.member("bend");
  motion.bend = {bend.member("median").number(0), bend.member("max").number(0),
                 bend.member("cap").number(0)};
  motion.meanFv = root.member("mean_f_v").number();
  if (!root.has("database")) return;
  const JsonNode database = root.member("database");
  motion.database = DatabaseReference{database.member("simulations").integer<std::int64_t>(),
                                      database.member("events").integer<std::int64_t>(),
                                      database.member("hash").text()};
}

ContactFactors readFactors(const JsonNode& node) {
  const auto factor = [&](const char* name) { return node.member(name).number(0, 1); };
  return {factor("v"), factor("q"), factor("t"), factor("a"),
          factor("l"), factor("c"), factor("o"), factor("p")};
}

ContactSource readSource(const JsonNode& node) {
  return {oneOf<SourceKind>(node.member("kind"), {"sampled", "shot", "database"}),
          node.member("simulation").integer<std::int64_t>(),
          node.member("event").integer<std::int64_t>(), node.member("symmetry").integer<int>()};
}

MotionContact readContact(const JsonNode& node) {
  MotionContact contact;
  const auto time = [&](const char* name) { return node.member(name).number(-kLongest, kLongest); };
  const auto positive = [&](const char* name) { return node.member(name).number(0); };
  contact.targetTime = time("target_time");
  contact.time = time("time");
  contact.targetDuration = positive("target_duration");
  contact.duration = positive("duration");
  contact.targetAmplitude = positive("target_amplitude");
  contact.amplitude = positive("amplitude");
  contact.targetCentroid = positive("target_centroid");
  contact.centroid = positive("centroid");
  contact.end = time("end");
  contact.terminal = node.member("terminal").flag();
  contact.arrival = oneOf<Arrival>(node.member("arrival"), {"flight", "silent_contact"});
  contact.source = readSource(node.member("source"));
  contact.factors = readFactors(node.member("factors"));
  contact.retiming = node.member("retiming").number(1e-3, 1e3);
  contact.bend = positive("bend");
  contact.restitution = node.member("restitution").number(0, 1);
  contact.position = node.member("position").vector();
  contact.impulseChange = node.member("impulse_change").vector();
  contact.angularChange = node.member("angular_change").vector();
  if (node.has("moved")) contact.moved = time("moved");
  if (!node.has("arrival_bend")) return contact;
  contact.arrivalImpulseChange = node.member("arrival_impulse_change").vector();
  contact.arrivalAngularChange = node.member("arrival_angular_change").vector();
  contact.arrivalBend = positive("arrival_bend");
  return contact;
}

void readContacts(const JsonNode& node, Motion& motion) {
  motion.contacts.resize(node.count());
  for (std::size_t i = 0; i < motion.contacts.size(); ++i) {
    motion.contacts[i] = readContact(node.item(i));
    const MotionContact& contact = motion.contacts[i];
    if (contact.end < contact.time) node.item(i).reject("ends before it starts");
    if (i > 0 && contact.time < motion.contacts[i - 1].end) {
      node.item(i).reject("starts before the contact before it ends");
    }
  }
}

void readDropped(const JsonNode& node, Motion& motion) {
  motion.dropped.resize(node.count());
  for (std::size_t i = 0; i < motion.dropped.size(); ++i) {
    motion.dropped[i] = node.item(i).number(-kLongest, kLongest);
  }
}

constexpr double kLeastDirection = 1e-9;

void readOrientations(const JsonNode& node, Motion& motion) {
  motion.orientations.resize(node.count());
  for (std::size_t i = 0; i < motion.orientations.size(); ++i) {
    const JsonNode wish = node.item(i);
    MotionOrientation& read = motion.orientations[i];
    read = {wish.member("contact").integer<int>(), wish.member("body").vector(),
            wish.member("world").vector()};
    if (read.contact < -1 || read.contact >= static_cast<int>(motion.contacts.size())) {
      wish.reject("is of a contact that is not there");
    }
    if (read.body.norm() < kLeastDirection) wish.member("body").reject("is no direction");
    if (read.world.norm() < kLeastDirection) wish.member("world").reject("is no direction");
  }
}

void readPositions(const JsonNode& node, Motion& motion) {
  motion.positions.resize(node.count());
  for (std::size_t i = 0; i < motion.positions.size(); ++i) {
    const JsonNode wish = node.item(i), place = wish.member("place");
    MotionPosition& read = motion.positions[i];
    read.contact = wish.member("contact").integer<int>();
    if (place.count(2) == 2) read.place = {place.item(0).number(), place.item(1).number()};
    if (read.contact < 0 || read.contact >= static_cast<int>(motion.contacts.size())) {
      wish.reject("is of a contact that is not there");
    }
  }
}

void readSilent(const JsonNode& node, Motion& motion) {
  motion.silent.resize(node.count());
  for (std::size_t i = 0; i < motion.silent.size(); ++i) {
    const JsonNode interval = node.item(i);
    if (interval.count(2) == 0) return;
    motion.silent[i] = {interval.item(0).number(-kLongest, kLongest),
                        interval.item(1).number(-kLongest, kLongest)};
    if (motion.silent[i][1] < motion.silent[i][0]) interval.reject("ends before it starts");
  }
}

void readTrajectory(const JsonNode& node, Motion& motion) {
  const JsonNode times = node.member("time"), positions = node.member("position");
  const JsonNode orientations = node.member("orientation"), velocities = node.member("velocity");
  const JsonNode angular = node.member("angular_velocity");
  const std::size_t count = times.count();
  if (positions.count(count) + orientations.count(count) + velocities.count(count) +
          angular.count(count) !=
      4 * count) {
    return;
  }
  motion.trajectory.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    motion.trajectory[i] = {times.item(i).number(-kLongest, kLongest), positions.item(i).vector(),
                            orientations.item(i).rotation(), velocities.item(i).vector(),
                            angular.item(i).vector()};
    if (i > 0 && motion.trajectory[i].time < motion.trajectory[i - 1].time) {
      times.item(i).reject("goes back in time");
    }
  }
}

void readFormat(const JsonNode& root) {
  const JsonNode format = root.member("format"), version = root.member("version");
  if (format.text() != "inverse-foley-motion") format.reject("is not inverse-foley-motion");
  if (version.integer<int>() != 1) version.reject("is not 1, the only version known here");
}

Result<Json> parseJson(std::string_view text, const std::string& place) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    return badInput("is not JSON: it breaks at byte " + std::to_string(error.byte), place,
                    "give a motion.json as ifa sync writes it");
  } catch (const Json::exception&) {
    return badInput("is not JSON that can be used: a number in it is out of range", place);
  }
}

}  // namespace

Result<Motion> parseMotion(std::string_view json, const std::string& place) {
  const auto parsed = parseJson(json, place);
  if (!parsed) return tl::unexpected<Error>(parsed.error());
  std::string problem;
  Motion motion;
  const JsonNode root(&*parsed, {}, &problem);
  readFormat(root);
  if (problem.empty()) {
    motion.program = root.member("program").text();
    motion.seed = root.member("seed").integer<std::uint64_t>();
    motion.planner = root.member("planner").text();
    if (root.has("settings")) motion.settings = root.member("settings").text();
    if (root.has("cut")) motion.cut = oneOf<EventCut>(root.member("cut"), {"audible", "paper"});
    readObjectAndSound(root, motion);
    readOutcome(root, motion);
    readContacts(root.member("contacts"), motion);
    if (root.has("dropped")) readDropped(root.member("dropped"), motion);
    if (root.has("orientations")) readOrientations(root.member("orientations"), motion);
    if (root.has("positions")) readPositions(root.member("positions"), motion);
    readSilent(root.member("silent"), motion);
    readTrajectory(root.member("trajectory"), motion);
  }
  if (!problem.empty()) {
    return badInput(problem, place, "give a motion.json as ifa sync writes it");
  }
  return motion;
}

Result<Motion> readMotionJson(const std::filesystem::path& path) {
  const auto text = readFile(path, kMaxMotionBytes);
  if (!text) return tl::unexpected<Error>(text.error());
  return parseMotion(*text, path.string());
}

}  // namespace ifa
