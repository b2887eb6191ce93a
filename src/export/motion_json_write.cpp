// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "export/motion_json.h"

namespace ifa {
namespace {

// Appends JSON by hand: the library's own text puts every number on a line or the whole file on
// one.
class Text {
 public:
  Text& raw(std::string_view text) {
    text_ += text;
    return *this;
  }
  Text& key(std::string_view name) {
    key_ = name;
    return raw("\"").raw(name).raw("\": ");
  }
  Text& value(double number) {
    if (!std::isfinite(number) && notFinite_.empty()) notFinite_ = key_;
    return appendNumber(number);
  }
  Text& value(std::int64_t number) { return appendNumber(number); }
  Text& value(std::uint64_t number) { return appendNumber(number); }
  Text& value(bool flag) { return raw(flag ? "true" : "false"); }
  Text& value(const std::string& text) {
    return raw(nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  Text& value(const Eigen::Vector3d& v) {
    return raw("[").value(v.x()).raw(", ").value(v.y()).raw(", ").value(v.z()).raw("]");
  }
  Text& value(const Eigen::Quaterniond& q) {
    raw("[").value(q.w()).raw(", ").value(q.x()).raw(", ");
    return value(q.y()).raw(", ").value(q.z()).raw("]");
  }
  Text& value(const std::array<double, 2>& pair) {
    return raw("[").value(pair[0]).raw(", ").value(pair[1]).raw("]");
  }
  template <class T>
  Text& field(std::string_view name, const T& content, std::string_view after = ", ") {
    return key(name).value(content).raw(after);
  }
  /// @param perLine  rows of `item(i)` a line
  template <class Item>
  Text& array(std::size_t count, std::size_t perLine, std::string_view indent, const Item& item) {
    raw("[");
    for (std::size_t i = 0; i < count; ++i) {
      if (i % perLine == 0) raw("\n").raw(indent);
      item(i);
      if (i + 1 < count) raw(i % perLine + 1 == perLine ? "," : ", ");
    }
    return raw("]");
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Name of the first field that holds an infinity or no number; empty when all are finite.
  [[nodiscard]] const std::string& notFinite() const { return notFinite_; }

 private:
  template <class Number>
  Text& appendNumber(Number number) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number);
    text_.append(digits, end.ptr);
    return *this;
  }

  std::string text_, key_, notFinite_;
};

void appendHeader(Text& out, const Motion& motion) {
  out.raw("{\"format\": \"inverse-foley-motion\", \"version\": 1,\n ");
  out.field("program", motion.program).field("seed", motion.seed);
  out.field("planner", motion.planner, ",\n ");
  if (!motion.settings.empty()) out.field("settings", motion.settings, ",\n ");
  if (motion.cut != EventCut::kAudible) {
    out.field("cut", std::string(cutName(motion.cut)), ",\n ");
  }
  out.key("object").raw("{").field("name", motion.object.name).field("mesh", motion.object.mesh);
  out.field("surface", motion.object.surface).field("mass", motion.object.mass);
  out.field("restitution", motion.object.restitution);
  out.field("friction", motion.object.friction, "},\n ");
  if (motion.given) {
    out.key("fit").raw("{").field("given_surface", motion.given->surface);
    out.field("given_restitution", motion.given->restitution, "},\n ");
  }
  out.key("sound").raw("{").field("file", motion.sound.file);
  out.field("rate", std::int64_t{motion.sound.rate}).field("duration", motion.sound.duration);
  out.field("first_contact", motion.sound.firstContact, "},\n ");
}

void appendOutcome(Text& out, const Motion& motion) {
  out.field("success", motion.success).key("failure");
  motion.failure.empty() ? out.raw("null, ") : out.value(motion.failure).raw(", ");
  out.field("time_limit_reached", motion.timeLimitReached);
  out.field("energy_gain", motion.energyGain, ",\n ").field("score", motion.score);
  out.field("score_without_sound", motion.scoreWithoutSound);
  out.field("search_seconds", motion.searchSeconds, ",\n ");
  out.key("bend").raw("{").field("median", motion.bend.median).field("max", motion.bend.max);
  out.field("cap", motion.bend.cap, "}, ").field("mean_f_v", motion.meanFv, ",\n ");
  if (!motion.database) return;
  out.key("database").raw("{").field("simulations", motion.database->simulations);
  out.field("events", motion.database->events).field("hash", motion.database->hash, "},\n ");
}

void appendSource(Text& out, const ContactSource& source) {
  constexpr std::string_view kKinds[] = {"sampled", "shot", "database"};
  out.key("source").raw("{").key("kind").raw("\"").raw(kKinds[static_cast<int>(source.kind)]);
  out.raw("\", ").field("simulation", source.simulation).field("event", source.event);
  out.field("symmetry", std::int64_t{source.symmetry}, "}, ");
}

void appendFactors(Text& out, const ContactFactors& factors) {
  out.key("factors").raw("{").field("v", factors.v).field("q", factors.q).field("t", factors.t);
  out.field("a", factors.a).field("l", factors.l).field("c", factors.c);
  out.field("o", factors.o).field("p", factors.p, "}, ");
}

void appendContact(Text& out, const MotionContact& contact) {
  out.raw("{").field("target_time", contact.targetTime).field("time", contact.time);
  out.field("target_duration", contact.targetDuration).field("duration", contact.duration);
  out.field("target_amplitude", contact.targetAmplitude).field("amplitude", contact.amplitude);
  out.field("terminal", contact.terminal).key("arrival");
  out.raw(contact.arrival == Arrival::kFlight ? "\"flight\", " : "\"silent_contact\", ");
  appendSource(out, contact.source);
  appendFactors(out, contact.factors);
  out.field("retiming", contact.retiming).field("bend", contact.bend);
  out.field("centroid", contact.centroid).field("target_centroid", contact.targetCentroid);
  out.field("end", contact.end).field("restitution", contact.restitution);
  out.field("position", contact.position).field("impulse_change", contact.impulseChange);
  if (contact.moved != 0) out.field("moved", contact.moved);
  if (contact.arrivalBend > 0) {
    out.field("arrival_impulse_change", contact.arrivalImpulseChange);
    out.field("arrival_angular_change", contact.arrivalAngularChange);
    out.field("arrival_bend", contact.arrivalBend);
  }
  out.field("angular_change", contact.angularChange, "}");
}

void appendTrajectory(Text& out, const std::vector<MotionSample>& samples) {
  const auto column = [&](std::string_view name, std::size_t perLine, auto member,
                          std::string_view after) {
    out.key(name).array(samples.size(), perLine, "   ",
                        [&](std::size_t i) { out.value(samples[i].*member); });
    out.raw(after);
  };
  out.key("trajectory").raw("{\n  ");
  column("time", 16, &MotionSample::time, ",\n  ");
  column("position", 8, &MotionSample::position, ",\n  ");
  column("orientation", 8, &MotionSample::orientation, ",\n  ");
  column("velocity", 8, &MotionSample::velocity, ",\n  ");
  column("angular_velocity", 8, &MotionSample::angularVelocity, "}}\n");
}

}  // namespace

Result<std::string> formatMotion(const Motion& motion) {
  Text out;
  appendHeader(out, motion);
  appendOutcome(out, motion);
  out.key("contacts").array(motion.contacts.size(), 1, "  ", [&](std::size_t i) {
    appendContact(out, motion.contacts[i]);
  });
  if (!motion.dropped.empty()) {
    out.raw(",\n ").key("dropped").array(motion.dropped.size(), 16, "  ",
                                         [&](std::size_t i) { out.value(motion.dropped[i]); });
  }
  if (!motion.orientations.empty()) {
    out.raw(",\n ")
        .key("orientations")
        .array(motion.orientations.size(), 1, "  ", [&](std::size_t i) {
          const MotionOrientation& wish = motion.orientations[i];
          out.raw("{")
              .field("contact", std::int64_t{wish.contact}, ", ")
              .field("body", wish.body, ", ");
          out.field("world", wish.world, "}");
        });
  }
  if (!motion.positions.empty()) {
    out.raw(",\n ").key("positions").array(motion.positions.size(), 4, "  ", [&](std::size_t i) {
      const MotionPosition& wish = motion.positions[i];
      out.raw("{").field("contact", std::int64_t{wish.contact});
      out.field("place", std::array<double, 2>{wish.place.x(), wish.place.y()}, "}");
    });
  }
  out.raw(",\n ").key("silent").array(motion.silent.size(), 8, "  ",
                                      [&](std::size_t i) { out.value(motion.silent[i]); });
  out.raw(",\n ");
  appendTrajectory(out, motion.trajectory);
  if (!out.notFinite().empty()) {
    return tl::unexpected<Error>(Error{ErrorCode::kInternal,
                                       "the motion holds a number that is not finite",
                                       "motion field " + out.notFinite(),
                                       {}});
  }
  return out.text();
}

Result<void> writeMotionJson(const std::filesystem::path& path, const Motion& motion) {
  const auto text = formatMotion(motion);
  if (!text) return tl::unexpected<Error>(text.error());
  return writeFileAtomically(path, *text);
}

}  // namespace ifa
