// SPDX-License-Identifier: Apache-2.0
#include "render/body_shader.h"

#include <algorithm>

namespace ifa::render {

/// Radiance that arrives along the ray at a body: other bodies, its own other parts, floor, sky.
/// @param except  a body that cannot be met, or kNobody
/// @param sharp   the lamps are seen
Colour BodyShader::around(const Surroundings& surroundings, const Ray& ray, const Sample& sample,
                          std::size_t except, float blur, bool sharp) const {
  const Moment& moment = surroundings.moment;
  if (except == Moment::kNobody || moment.actors().size() > 1) {
    SurfaceHit hit;
    if (moment.intersect(ray, sample.instant, sample.choice, hit, except) != Moment::kNobody) {
      return roughRadiance(hit, -ray.direction, studio_);
    }
  }
  if (ray.direction.z() < 0) return floor_.seenFrom(ray, blur, surroundings.lights);
  return sharp ? studio_.sky(ray.direction) : studio_.softSky(ray.direction);
}

// The light's square is sampled; what the lobe finds by itself is weighed against it
// (mirroredLight).
Colour BodyShader::keyLight(const Surroundings& surroundings, const Place& place,
                            const Sample& sample) const {
  const Vector key = studio_.towardsKey(sample.key0, sample.key1);
  const float cosine = place.hit.normal.dot(key);
  if (cosine <= 0 || place.hit.geometric.dot(key) <= 0) return Colour::Zero();
  const Moment& moment = surroundings.moment;
  const bool alone = place.except != Moment::kNobody && moment.actors().size() == 1;
  if (!alone &&
      moment.occluded({place.position, key}, sample.instant, sample.choice, place.except)) {
    return Colour::Zero();
  }
  const float density = studio_.keyDensity(key);
  const float share = density / (density + place.lobe.density(key));
  return studio_.key(key) * (cosine / density) *
         (place.diffuse + share * place.lobe.reflectance(key));
}

// What sky and floor give to a whole hemisphere is known; a ray tells how this place differs.
Colour BodyShader::diffuseLight(const Surroundings& surroundings, const Place& place,
                                const Sample& sample) const {
  if (place.finish.metallic >= 1) return Colour::Zero();
  const Vector d = cosineDirection(place.lobe.frame(), sample.diffuseX, sample.diffuseY);
  const Colour open = d.z() > 0 ? studio_.softSky(d) : studio_.floorRadiance();
  const Colour found = around(surroundings, {place.position, d}, sample, place.except, 1, false);
  return place.diffuse * (studio_.ambient(place.hit.normal) + kPi * (found - open)).max(0.0f);
}

Colour BodyShader::mirroredLight(const Surroundings& surroundings, const Place& place,
                                 const Sample& sample, float radius) const {
  Colour weight;
  const Vector d = place.lobe.sample(sample.specularX, sample.specularY, weight);
  if (d.dot(place.hit.normal) <= 0) return Colour::Zero();
  Colour seen = around(surroundings, {place.position, d}, sample, place.except,
                       4 * place.finish.alpha * radius, true);
  if (d.dot(place.hit.geometric) > 0 && (studio_.key(d) > 0).any()) {
    const float density = place.lobe.density(d);
    seen += density / (density + studio_.keyDensity(d)) * studio_.key(d);
  }
  return weight * seen;
}

Colour BodyShader::radiance(const Surroundings& surroundings, const Ray& ray, const SurfaceHit& hit,
                            const Sample& sample, std::size_t self) const {
  const Finish& finish = *hit.finish;
  const ActorMoment& actor = surroundings.moment.actors()[self];
  const Vector view = -ray.direction;
  const float facing = std::max(hit.normal.dot(view), 0.02f);
  const Colour through = 1 - (finish.facing() + (1 - finish.facing()) * schlick(facing));
  const Place place{
      ray.origin + hit.distance * ray.direction + 3e-4f * actor.radius() * hit.geometric,
      hit,
      finish,
      FinishLobe(finish, hit.normal, view),
      finish.diffuse() / kPi * through,
      hit.open ? self : Moment::kNobody};
  const float pool = floor_.pool(actor.centre().x(), actor.centre().y());
  return pool * (keyLight(surroundings, place, sample) + diffuseLight(surroundings, place, sample) +
                 mirroredLight(surroundings, place, sample, actor.radius()));
}

Colour BodyShader::mirroredInFloor(const Surroundings& surroundings, const FloorPoint& point,
                                   const Vector& view, const Sample* samples, int count) const {
  const Vector place(point.x, point.y, 0);
  const Frame mirror(Vector(view.x(), view.y(), -view.z()));
  const float spread = 2 * floor_.gloss() * floor_.gloss();
  Colour sum = Colour::Zero();
  SurfaceHit hit;
  for (int i = 0; i < count; ++i) {
    const Sample& s = samples[i];
    // Long tails, as polished wood has them.
    const float wide =
        spread / std::sqrt(1.02f - s.specularX * s.specularX - s.specularY * s.specularY);
    const Vector d = mirror.toWorld(wide * s.specularX, wide * s.specularY, 1).normalized();
    if (d.z() <= 0) continue;
    const auto body = surroundings.moment.intersect({place, d}, s.instant, s.choice, hit);
    if (body != Moment::kNobody) sum += roughRadiance(hit, -d, studio_) - studio_.softSky(d);
  }
  return sum * (point.mirrored * point.pool / static_cast<float>(count));
}

}  // namespace ifa::render
