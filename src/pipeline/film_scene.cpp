// SPDX-License-Identifier: Apache-2.0
#include "pipeline/film_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/canvas.h"

namespace ifa {

namespace {

using render::Actor;
using render::BodyGeometry;
using render::FrameRenderer;
using render::RenderSettings;

constexpr double kAfter = 2, kRest = 0.5;  // s of rest that are shown at most and at least

RenderSettings qualityOf(bool final) {
  RenderSettings settings;
  settings.samplesPerPixel = final ? 64 : 16;
  settings.floorLight = {final ? 8 : 4, final ? 16 : 8, final ? 96.0f : 64.0f,
                         final ? 40.0f : 24.0f, 0};
  return settings;
}

RenderSettings settingsOf(const FilmOptions& options, const std::vector<FilmPart>& parts,
                          int width) {
  RenderSettings settings = qualityOf(options.final);
  settings.width = width;
  settings.height = options.height;
  settings.camera = options.camera.value_or(CameraKind::kAuto);
  settings.shutterSeconds = options.shutter / options.framesPerSecond * options.speed;
  settings.surface = options.floor.empty() ? parts.front().motion->object.surface : options.floor;
  if (options.overlay) settings.margins.bottom += static_cast<float>(render::Overlay::kShare);
  return settings;
}

Actor actorOf(const FilmPart& part, double start) {
  Actor actor;
  actor.geometry = std::make_shared<BodyGeometry>(*part.body);
  // The caller keeps the motion alive.
  actor.motion = std::shared_ptr<const Motion>(std::shared_ptr<const Motion>(), part.motion);
  actor.start = start;
  return actor;
}

tl::unexpected<Error> usage(const char* place, std::string remedy) {
  return tl::unexpected<Error>({ErrorCode::kUsage, "is out of range", place, std::move(remedy)});
}

bool between(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

Result<void> checkFilmOptions(const FilmOptions& options) {
  const auto isSide = [](int side) { return between(side, 64, 4096) && side % 2 == 0; };
  if (!isSide(options.width) || !isSide(options.height)) {
    return usage("size", "give even numbers from 64 to 4096, such as 1280x720");
  }
  if (!between(options.framesPerSecond, 1, 240)) {
    return usage("frames per second", "give a number from 1 to 240");
  }
  if (!between(options.shutter, 0, 1)) return usage("shutter", "give a number from 0 to 1");
  if (!between(options.speed, 0.01, 4)) return usage("speed", "give a number from 0.01 to 4");
  const auto& floor = options.floor;
  if (!floor.empty() && floor != "desk" && floor != "wood" && floor != "carpet") {
    return usage("floor", "choose from desk, wood, carpet");
  }
  return {};
}

FilmOptions withSize(FilmOptions options) {
  if (options.width == 0 && options.height == 0) {
    options.width = options.final ? 1280 : 640;
    options.height = options.final ? 720 : 360;
  }
  return options;
}

Motion markedContacts(const std::vector<FilmPart>& parts) {
  const Motion& first = *parts.front().motion;
  Motion marked;
  marked.object = first.object;
  marked.score = first.score;
  marked.sound = first.sound;
  for (const FilmPart& part : parts) {
    if (&part != &parts.front() && !part.start) continue;
    const double later = part.start.value_or(first.sound.firstContact) - first.sound.firstContact;
    for (MotionContact contact : part.motion->contacts) {
      contact.time += later;
      contact.end += later;
      marked.contacts.push_back(contact);
    }
  }
  std::stable_sort(marked.contacts.begin(), marked.contacts.end(),
                   [](const MotionContact& a, const MotionContact& b) { return a.time < b.time; });
  return marked;
}

FilmScene::FilmScene(const std::vector<FilmPart>& parts, const Sound* sound,
                     const FilmOptions& options)
    : options_(options) {
  const Motion& first = *parts.front().motion;
  const double start = first.sound.firstContact;
  std::vector<Actor> actors;
  double end = 0;
  for (const FilmPart& part : parts) {
    actors.push_back(actorOf(part, part.start.value_or(start)));
    end = std::max(end, part.motion->trajectory.back().time + actors.back().start);
  }
  const int count = options.sideBySide ? static_cast<int>(parts.size()) : 1;
  for (int i = 0; i < count; ++i) {
    const int left = options.width * i / count, right = options.width * (i + 1) / count;
    const auto k = static_cast<std::size_t>(i);
    auto shown = options.sideBySide ? std::vector<Actor>{actors[k]} : actors;
    views_.push_back({std::make_unique<FrameRenderer>(std::move(shown),
                                                      settingsOf(options, parts, right - left)),
                      left, count > 1 ? parts[k].name : std::string()});
  }
  const double soundEnd = sound != nullptr ? sound->duration() : 0;
  const double seconds = std::max(end + kRest, std::min(soundEnd, end + kAfter));
  frames_ = static_cast<std::size_t>(
      std::max(1.0, std::ceil(seconds / options.speed * options.framesPerSecond)));
  if (!options.overlay) return;
  overlay_.emplace(markedContacts(parts), sound != nullptr ? *sound : Sound{}, seconds,
                   options.speed, options.speed / options.framesPerSecond, options.width,
                   options.height);
}

double FilmScene::timeOf(std::size_t frame) const {
  return static_cast<double>(frame) / options_.framesPerSecond * options_.speed;
}

Image FilmScene::picture(double time) const {
  if (views_.size() == 1) return views_.front().renderer->render(time);
  Image whole(options_.width, options_.height);
  for (const View& view : views_) paste(view.renderer->render(time), whole, view.left, 0);
  nameViews(whole);
  return whole;
}

void FilmScene::nameViews(Image& whole) const {
  render::Canvas canvas(whole);
  const double size = std::max(10.0, options_.height / 26.0);
  for (const View& view : views_) {
    if (view.left > 0) canvas.rectangle(view.left - 1, 0, 2, options_.height, {0, 0, 0, 0.8});
    canvas.text(view.left + size, 1.7 * size, size, render::Align::kLeft, view.name,
                {1, 1, 1, 0.85});
  }
}

bool FilmScene::sameAt(double time, double other) const {
  return std::all_of(views_.begin(), views_.end(),
                     [&](const View& view) { return view.renderer->sameAt(time, other); });
}

void FilmScene::finish(Image& picture, double time) const {
  if (overlay_) overlay_->draw(picture, time);
}

}  // namespace ifa
