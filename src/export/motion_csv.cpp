// SPDX-License-Identifier: Apache-2.0
#include "export/motion_csv.h"

#include <fmt/format.h>

#include "base/file.h"

namespace ifa {

namespace {

void appendRow(std::string& text, std::initializer_list<double> values) {
  const char* comma = "";
  for (const double value : values) {
    fmt::format_to(std::back_inserter(text), "{}{}", comma, value);
    comma = ",";
  }
}

}  // namespace

std::string formatPoses(const Motion& motion) {
  std::string text = "time,sound_time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";
  for (const MotionSample& s : motion.trajectory) {
    const Eigen::Vector3d &p = s.position, &v = s.velocity, &w = s.angularVelocity;
    const Eigen::Quaterniond& q = s.orientation;
    appendRow(text, {s.time, s.time + motion.sound.firstContact, p.x(), p.y(), p.z(), q.w(), q.x(),
                     q.y(), q.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z()});
    text += '\n';
  }
  return text;
}

std::string formatContacts(const Motion& motion) {
  std::string text =
      "contact,arrival,terminal,time,sound_time,end,duration,amplitude,centroid,target_time,"
      "target_duration,target_amplitude,target_centroid,f_v,f_q,f_t,f_a,f_l,f_c,bend,restitution,"
      "x,y,z\n";
  for (std::size_t i = 0; i < motion.contacts.size(); ++i) {
    const MotionContact& c = motion.contacts[i];
    const ContactFactors& f = c.factors;
    fmt::format_to(std::back_inserter(text), "{},{},{},", i + 1,
                   c.arrival == Arrival::kFlight ? "flight" : "silent_contact", c.terminal ? 1 : 0);
    appendRow(text, {c.time,
                     c.time + motion.sound.firstContact,
                     c.end,
                     c.duration,
                     c.amplitude,
                     c.centroid,
                     c.targetTime,
                     c.targetDuration,
                     c.targetAmplitude,
                     c.targetCentroid,
                     f.v,
                     f.q,
                     f.t,
                     f.a,
                     f.l,
                     f.c,
                     c.bend,
                     c.restitution,
                     c.position.x(),
                     c.position.y(),
                     c.position.z()});
    text += '\n';
  }
  return text;
}

Result<void> writeCsv(const std::filesystem::path& folder, const Motion& motion) {
  if (auto good = writeFileAtomically(folder / "motion.csv", formatPoses(motion)); !good) {
    return good;
  }
  return writeFileAtomically(folder / "contacts.csv", formatContacts(motion));
}

}  // namespace ifa
